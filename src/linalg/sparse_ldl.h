/* SPDX-License-Identifier: BSD-3-Clause */
/* Sparse symmetric quasi-definite systems: A = L D L' in an order that keeps L sparse.
 *
 * A quasi-definite matrix [ H, E'; E, -F ], H and F positive definite, has such a factor for every
 * symmetric order (Vanderbei 1995), so the order is chosen for sparsity alone: minimum degree,
 * which gives linear fill on chains, trees and stars. The caller regularises semi-definite H and F;
 * a pivot whose sign rounding has made wrong is replaced. */
#ifndef CAPSTAN_SRC_LINALG_SPARSE_LDL_H
#define CAPSTAN_SRC_LINALG_SPARSE_LDL_H

#include <stdbool.h>
#include <stddef.h>

/* The upper triangle by columns: entries start[j] .. start[j + 1] of column j have rows index[] <=
 * j, each row once. */
typedef struct CpsiPattern {
    int n;
    const size_t *start; /* (n + 1) */
    const int *index;    /* (start[n]) */
} CpsiPattern;

/* Minimum degree order: order[k] is the unknown eliminated as number k. Returns false when memory
 * does not suffice. */
bool cpsi_sparse_order(const CpsiPattern *pattern, int *order);

/* Analysis and factor. */
typedef struct CpsiLdl CpsiLdl;

/* Order and analyse a pattern once for all its matrices. *width: that of registers, as
 * cpsi_width_once keeps it. Returns NULL with *entries = 0 when memory does not suffice, and NULL
 * with *entries > most where the factor would have more than `most` entries. */
CpsiLdl *cpsi_ldl_new(const CpsiPattern *pattern, size_t most, int *width, size_t *entries);
void cpsi_ldl_free(CpsiLdl *ldl);

/* Factorise the matrix of the pattern with these values. Unknown j's pivot should have the sign of
 * sign[j]; a pivot that in that direction is below `least`, or below the rounding of the terms of
 * which it is the sum, is replaced by the larger of both with that sign. Returns false where a
 * pivot is not finite. */
bool cpsi_ldl_factor(CpsiLdl *ldl, const double *values, const signed char *sign, double least);
/* x = A^-1 x with the last factor. */
void cpsi_ldl_solve(const CpsiLdl *ldl, double *x);

#endif
