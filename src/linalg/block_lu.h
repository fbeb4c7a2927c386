/* SPDX-License-Identifier: BSD-3-Clause */
/* Sparse matrices of blocks of 3 x 3 numbers whose pattern is symmetric: A = L D U in an order that
 * keeps L and U sparse, L and U with unit blocks on the diagonal.
 *
 * The matrix is stored by rows, both blocks of each pair. The order is that of minimum degree on
 * the graph of the blocks (sparse_ldl.h), chosen once; there is pivoting inside the blocks of the
 * diagonal only. That is stable where the symmetric part is positive definite and the rest is not
 * much larger than it; each solution is improved once by its own residual.
 *
 * A factor may be of some of the unknowns only, the others held at 0: the order and the memory are
 * those of all. */
#ifndef CAPSTAN_SRC_LINALG_BLOCK_LU_H
#define CAPSTAN_SRC_LINALG_BLOCK_LU_H

#include <stdbool.h>
#include <stddef.h>

typedef struct CpsiBlockLu CpsiBlockLu;

/* The pattern of n blocks on the diagonal and of the pairs (edges, 2), each in any order and any
 * number of times; a pair of equal numbers or with a negative one counts for nothing. NULL where
 * memory does not suffice, or where a factor would have more than `most` pairs of blocks off the
 * diagonal. */
CpsiBlockLu *cpsi_block_lu_new(int n, size_t edges, const int (*edge)[2], size_t most);
void cpsi_block_lu_free(CpsiBlockLu *lu);

/* Use the unknowns `used` (count) in place of all: those of the matrix that is set and factorised
 * next. */
void cpsi_block_lu_use(CpsiBlockLu *lu, int count, const int *used);
/* Set all blocks of the rows in use to 0. */
void cpsi_block_lu_clear(CpsiBlockLu *lu);
/* The block (9) in row i and column j of the pattern, row by row. */
double *cpsi_block_lu_at(CpsiBlockLu *lu, int i, int j);
/* The blocks of row i, one after the other; returns how many. */
int cpsi_block_lu_row(CpsiBlockLu *lu, int i, double **blocks);
/* Pairs of blocks in the factor. */
size_t cpsi_block_lu_size(const CpsiBlockLu *lu);

/* Factorise; false where a pivot is 0 or not finite. */
bool cpsi_block_lu_factor(CpsiBlockLu *lu);
/* x = A^-1 x with the last factor, x (n, 3): what is not in use is neither read nor written. The
 * matrix is the one that was factorised. */
void cpsi_block_lu_solve(CpsiBlockLu *lu, double *x);

#endif
