/* SPDX-License-Identifier: BSD-3-Clause */
/* Small dense matrices, row-major: general factorisation, Cholesky, orthonormal bases. No
 * allocation. */
#ifndef CAPSTAN_SRC_LINALG_DENSE_H
#define CAPSTAN_SRC_LINALG_DENSE_H

#include <stdbool.h>

/* sum of a_i b_i */
static inline double cpsi_dot(int n, const double *a, const double *b) {
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

/* |a|, without overflow for entries of any size */
double cpsi_norm(int n, const double *a);

/* P A = L U in place with partial pivoting; pivot (n) are the rows chosen. Returns false where a
 * pivot is 0 or not finite. */
bool cpsi_lu_factor(int n, double *a, int *pivot);
/* x = A^-1 x with the factor. */
void cpsi_lu_solve(int n, const double *lu, const int *pivot, double *x);

/* Lower Cholesky factor of the symmetric matrix a (n, n) into l (n, n), with zeros above the
 * diagonal. Returns false where a is not positive definite. */
bool cpsi_cholesky(int n, const double *a, double *l);
/* The inverse of a lower triangle l into out (n, n), zeros above. */
void cpsi_lower_inverse(int n, const double *l, double *out);

/* Orthonormal rows by Gram-Schmidt with the largest remainder first and every projection done
 * twice. On return the first `rank` of the rows (count, n) are orthonormal and span all of them.
 * The right-hand sides rhs (count, or NULL) of the equations <row_i, x> = rhs_i are transformed
 * alike: x = sum rhs_k row_k solves the first `rank` equations, and the remaining right-hand sides
 * are the contradiction in the other equations. A row counts as dependent when no more than the
 * share `tolerance` of it remains. Returns the rank. */
int cpsi_orthonormal_rows(int count, int n, double *rows, double *rhs, double tolerance);
/* The same for rows whose scale the caller has chosen: a row counts as dependent when no more than
 * the length `tolerance` of it remains. */
int cpsi_orthonormal_span(int count, int n, double *rows, double *rhs, double tolerance);

/* Append to `rank` < n orthonormal rows of q (n, n) one more row normal to them; n^2 operations. */
void cpsi_next_row(int rank, int n, double *q);
/* Complete `rank` orthonormal rows of q (n, n) to n. */
void cpsi_complete_rows(int rank, int n, double *q);

#endif
