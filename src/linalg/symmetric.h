/* SPDX-License-Identifier: BSD-3-Clause */
/* Small symmetric matrices. */
#ifndef CAPSTAN_SRC_LINALG_SYMMETRIC_H
#define CAPSTAN_SRC_LINALG_SYMMETRIC_H

#include <stdbool.h>

/* Solve K x = b, K (6) as xx, xy, yy, xz, yz, zz, by K = L D L': b becomes x. False, and b as it
 * was, where K is not positive definite. */
static inline bool cpsi_symmetric_solve(const double k[6], double b[3]) {
    if (!(k[0] > 0)) return false;
    const double ix = 1 / k[0], yx = k[1] * ix, zx = k[3] * ix, y = k[2] - yx * k[1];
    if (!(y > 0)) return false;
    const double iy = 1 / y, zy = (k[4] - zx * k[1]) * iy, z = k[5] - zx * k[3] - zy * zy * y;
    if (!(z > 0)) return false;
    b[1] -= yx * b[0];
    b[2] = (b[2] - zx * b[0] - zy * b[1]) / z;
    b[1] = b[1] * iy - zy * b[2];
    b[0] = b[0] * ix - yx * b[1] - zx * b[2];
    return true;
}

/* Diagonalise the symmetric matrix a (n, n), row-major, in place: its eigenvalues are then on its
 * diagonal, in no order, and the columns of vectors (n, n) are their unit eigenvectors. */
void cpsi_symmetric_diagonalise(int n, double *a, double *vectors);

#endif
