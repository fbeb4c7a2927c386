/* SPDX-License-Identifier: BSD-3-Clause */
/* Eigenvalues of small symmetric matrices. */
#ifndef CAPSTAN_SRC_LINALG_SYMMETRIC_H
#define CAPSTAN_SRC_LINALG_SYMMETRIC_H

/* Diagonalise the symmetric matrix a (n, n), row-major, in place: its eigenvalues are then on its
 * diagonal, in no order, and the columns of vectors (n, n) are their unit eigenvectors. */
void cpsi_symmetric_diagonalise(int n, double *a, double *vectors);

#endif
