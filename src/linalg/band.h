/* SPDX-License-Identifier: BSD-3-Clause */
/* Symmetric positive definite band matrices: Cholesky's factorisation and solution, in place.
 *
 * The lower part is stored row by row, band + 1 numbers each: entry (r, c), r - band <= c <= r, is
 * a[r*(band + 1) + c - r + band]; entries before the first column are not read. Cost:
 * unknowns*band^2 to factor, 4*unknowns*band to solve. */
#ifndef CAPSTAN_SRC_LINALG_BAND_H
#define CAPSTAN_SRC_LINALG_BAND_H

#include <stdbool.h>
#include <stddef.h>

static inline double *cpsi_band_at(double *a, int band, int row, int column) {
    return a + (size_t)row * ((size_t)band + 1) + (size_t)(column - row + band);
}

/* Replace a by its factor L, a = L L^T. Returns false when a pivot is not positive; the content of
 * a is then undefined. */
bool cpsi_band_factor(int unknowns, int band, double *a);

/* Solve L L^T x = b; x holds b on entry. */
void cpsi_band_solve(int unknowns, int band, const double *factor, double *x);

#endif
