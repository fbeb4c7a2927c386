/* SPDX-License-Identifier: BSD-3-Clause */
/* The matrix of the points and bodies at which lines meet, of blocks of 3 x 3 numbers: dense and
 * with partial pivoting for a few hundred unknowns, beyond that sparse (block_lu.h). Its memory is
 * that of all points and bodies of a scene; a step uses the blocks of those that move together. */
#ifndef CAPSTAN_SRC_LINALG_GRAPH_MATRIX_H
#define CAPSTAN_SRC_LINALG_GRAPH_MATRIX_H

#include "base/vec3.h"
#include "linalg/block_lu.h"

typedef struct CpsiGraphMatrix CpsiGraphMatrix;

/* The matrix of n blocks on the diagonal with the pairs of others `edge` (edges, 2), as
 * cpsi_block_lu_new. NULL where memory does not suffice. */
CpsiGraphMatrix *cpsi_graph_matrix_new(int n, size_t edges, const int (*edge)[2]);
void cpsi_graph_matrix_free(CpsiGraphMatrix *matrix);

/* From here on block row k = 0 .. count - 1 is that of `node[k]`, one of the n. */
void cpsi_graph_matrix_use(CpsiGraphMatrix *matrix, int count, const int *node);
void cpsi_graph_matrix_clear(CpsiGraphMatrix *matrix);

/* Where a block lies: its entry in row a and column b is at[a stride + b]. */
typedef struct CpsiGraphBlock {
    double *at;
    size_t stride;
} CpsiGraphBlock;

/* The block in rows i and columns j, in the pattern. */
CpsiGraphBlock cpsi_graph_matrix_block(CpsiGraphMatrix *matrix, int i, int j);

/* How the place of a point follows from the unknowns: x = by u, u the `width` unknowns from `first`
 * on, 3 or those of a body, 6; width 0: it does not move. */
typedef struct CpsiJointMap {
    int first, width;
    double by[3][6];
} CpsiJointMap;

/* Of a point whose place is three unknowns. */
static inline CpsiJointMap cpsi_joint_map_of_point(int first) {
    return (CpsiJointMap){.first = first, .width = 3, .by = {{1}, {0, 1}, {0, 0, 1}}};
}
/* Of one at an arm a from the reference point of a body, which moves by d and turns by theta:
 * d + theta x a. */
static inline CpsiJointMap cpsi_joint_map_on_body(int first, Vec3 a) {
    return (CpsiJointMap){.first = first,
                          .width = 6,
                          .by = {{1, 0, 0, 0, a.z, -a.y},
                                 {0, 1, 0, -a.z, 0, a.x},
                                 {0, 0, 1, a.y, -a.x, 0}}};
}

/* Add A' K B for a block K of the forces at one point (A: `to`) by the displacements of another
 * (B: `from`); its entry in row a and column b is k[a stride + b]. */
void cpsi_graph_matrix_add(CpsiGraphMatrix *matrix, const CpsiJointMap *to,
                           const CpsiJointMap *from, const double *k, int stride);
/* Add the stiffness (6, 6) of a body. */
void cpsi_graph_matrix_add_body(CpsiGraphMatrix *matrix, int first, const double stiffness[36]);

/* Multiply the blocks of row i from the left by p (3, 3). */
void cpsi_graph_matrix_turn(CpsiGraphMatrix *matrix, int i, const double p[3][3]);
/* Set row `a` (0 .. 2) of block row i to that of the identity. */
void cpsi_graph_matrix_fix(CpsiGraphMatrix *matrix, int i, int a);

/* Factorise; false where a pivot is 0 or not finite. The matrix stays as it is. */
bool cpsi_graph_matrix_factor(CpsiGraphMatrix *matrix);
/* x = A^-1 x with the last factor, x (count, 3). */
void cpsi_graph_matrix_solve(CpsiGraphMatrix *matrix, double *x);

#endif
