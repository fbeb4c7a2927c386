/* SPDX-License-Identifier: BSD-3-Clause */
/* Cholesky's factorisation of a band matrix, row by row (see band.h). */
#include "linalg/band.h"

#include <math.h>

static inline double at(const double *a, int band, int row, int column) {
    return a[(size_t)row * ((size_t)band + 1) + (size_t)(column - row + band)];
}

static inline int first_column(int row, int band) { return row > band ? row - band : 0; }

bool cpsi_band_factor(int unknowns, int band, double *a) {
    for (int r = 0; r < unknowns; ++r) {
        const int first = first_column(r, band);
        for (int c = first; c <= r; ++c) {
            double sum = at(a, band, r, c);
            for (int k = first; k < c; ++k) sum -= at(a, band, r, k) * at(a, band, c, k);
            if (c < r)
                sum /= at(a, band, c, c);
            else if (!(sum > 0))
                return false;
            else
                sum = sqrt(sum);
            *cpsi_band_at(a, band, r, c) = sum;
        }
    }
    return true;
}

void cpsi_band_solve(int unknowns, int band, const double *factor, double *x) {
    for (int r = 0; r < unknowns; ++r) {
        for (int k = first_column(r, band); k < r; ++k) x[r] -= at(factor, band, r, k) * x[k];
        x[r] /= at(factor, band, r, r);
    }
    for (int r = unknowns - 1; r >= 0; --r) {
        x[r] /= at(factor, band, r, r);
        for (int k = first_column(r, band); k < r; ++k) x[k] -= at(factor, band, r, k) * x[r];
    }
}
