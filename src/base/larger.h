/* SPDX-License-Identifier: BSD-3-Clause */
/* The larger of two numbers, NaN if either is NaN, so that a maximum of residuals never hides a
 * NaN. */
#ifndef CAPSTAN_SRC_BASE_LARGER_H
#define CAPSTAN_SRC_BASE_LARGER_H

/* One comparison per choice, so that loops over lanes (base/lanes.h) may contain it. */
static inline double cpsi_max_nan(double a, double b) {
    const double other = a != a ? a : b;
    return a > b ? a : other;
}

#endif
