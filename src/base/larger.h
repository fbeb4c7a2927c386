/* SPDX-License-Identifier: BSD-3-Clause */
/* The larger of two numbers, NaN if either is NaN, so that a maximum of residuals never hides a
 * NaN. */
#ifndef CAPSTAN_SRC_BASE_LARGER_H
#define CAPSTAN_SRC_BASE_LARGER_H

static inline double cpsi_max_nan(double a, double b) { return a > b || a != a ? a : b; }

#endif
