/* SPDX-License-Identifier: BSD-3-Clause */
/* The factor L D L' of a large dense symmetric quasi-definite matrix, by blocks. */
#ifndef CAPSTAN_SRC_LINALG_DENSE_LDL_H
#define CAPSTAN_SRC_LINALG_DENSE_LDL_H

#include <stdbool.h>
#include <stddef.h>

/* Rows are taken four at a time, and columns in panels of so many. */
enum { CPSI_DENSE_ROWS = 4, CPSI_DENSE_PANEL = 32 };

/* m (n, n) by columns, n a multiple of CPSI_DENSE_ROWS: the lower triangle is replaced by L without
 * its unit diagonal, what is above the diagonal is overwritten. pivot, terms (n): D, and the sum of
 * the absolute values of the terms of each diagonal entry so far, to which those of the elimination
 * are added. sign (n), least and share: as in cpsi_ldl_factor, a pivot is at least `least` and at
 * least that share of its terms. scratch (2 CPSI_DENSE_PANEL n). Returns false where a pivot is not
 * finite. */
bool cpsi_dense_ldl(int n, double *m, double *pivot, double *terms, const signed char *sign,
                    double least, double share, double *scratch);

#endif
