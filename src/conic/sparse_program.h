/* SPDX-License-Identifier: BSD-3-Clause */
/* A large sparse conic program made of small dense blocks:
 *
 *     min c.x   s.t.  E x + h = 0,     A_k x_k + b_k in K_k  for each block k of unknowns x_k,
 *
 * K_k products of half-lines (dimension 1) and second-order cones, in its homogeneous self-dual
 * form (homogeneous.h). Each A_k has full column rank. Time and memory are proportional to the fill
 * of one quasi-definite factor (linalg/sparse_ldl.h); data should be of order one. */
#ifndef CAPSTAN_SRC_CONIC_SPARSE_PROGRAM_H
#define CAPSTAN_SRC_CONIC_SPARSE_PROGRAM_H

#include "base/status.h"
#include "conic/homogeneous.h"
#include "linalg/sparse_ldl.h"

/* A block; its arrays belong to the caller, and blocks may share them. Blocks stand in order at the
 * beginning of x; the unknowns after them are free. */
typedef struct CpsiBlock {
    int unknowns, rows, cones;
    const int *dim;      /* (cones) */
    const double *a, *b; /* (rows, unknowns), (rows) */
} CpsiBlock;

/* Data that belong to the caller. A row of E contains each column at most once. */
typedef struct CpsiSparseData {
    int unknowns, equations, blocks;
    const CpsiBlock *block;
    const size_t *start; /* (equations + 1) row i of E: entries start[i] .. start[i + 1] */
    const int *column;
    const double *value;
    const double *c, *h; /* (unknowns), (equations) */
} CpsiSparseData;

/* A vector (x, -y, -w, tau) of the system, in one array. */
typedef struct CpsiTriple {
    double *x, *y, *w, *tau;
} CpsiTriple;

typedef struct CpsiSparseProgram {
    CpsiHomogeneous core; /* must be the first member, since the loop gets a pointer to it */
    CpsiSparseData data;
    int *dim;                    /* (cones) of all blocks */
    double *b;                   /* (rows) of all blocks */
    double *scaled_a, *scaled_b; /* A~ block by block, b~ (rows) */
    size_t *at;                  /* (blocks) first entry of a block's A~ */
    CpsiLdl *ldl;
    double *value;                       /* entries of the condensed matrix */
    size_t *place;                       /* (blocks) first entry of a block's triangle in `value` */
    size_t free_place;                   /* first entry of the free unknowns in `value` */
    double *regular;                     /* (unknowns + equations) added to the diagonals */
    signed char *sign;                   /* (unknowns + equations) */
    CpsiTriple right, left, fix, answer; /* right-hand side, residual, correction, solution */
    CpsiTriple turned;                   /* K^-1 p, without tau */
    double below;                        /* the coefficient of dtau */
    CpsiArena arena;
} CpsiSparseProgram;

/* Prepare: order and analyse the system, allocate all memory. Returns CPS_ERR_MEMORY, or
 * CPS_ERR_LIMIT where sizes or the factor are too large. c and h may change between solves, the
 * other data may not. */
CpsStatus cpsi_sparse_program_new(const CpsiSparseData *data, CpsiSparseProgram **out,
                                  CpsError *err);
void cpsi_sparse_program_free(CpsiSparseProgram *program);

/* Minimise. The outcome is FAILED where the residual or the gap is above `accept`; s and z are
 * ordered as the rows of the blocks. */
CpsiConicResult cpsi_sparse_program_solve(CpsiSparseProgram *program, double accept);

/* ---- shared by the files of the program ---- */

/* Products (sparse_blocks.c): out = E x */
void cpsi_sparse_multiply(const CpsiSparseData *d, const double *x, double *out);
/* out += factor E'y */
void cpsi_sparse_add_transposed(const CpsiSparseData *d, double factor, const double *y,
                                double *out);

/* out = A x for the blocks' unscaled matrices, or A~ x where `scaled`; out += factor A'z, or
 * A~'z */
void cpsi_sparse_blocks_multiply(const CpsiSparseProgram *program, bool scaled, const double *x,
                                 double *out);
void cpsi_sparse_blocks_add(const CpsiSparseProgram *program, bool scaled, double factor,
                            const double *z, double *out);

/* sparse_system.c */
extern const CpsiConicOperator cpsi_sparse_operator;

/* What the polish has found: the residual of what replaces the solution, infinity where nothing
 * does, and whether it has come to the rounding of that residual, so that nothing better is to be
 * had. */
typedef struct CpsiPolished {
    double residual;
    bool rounded;
} CpsiPolished;

/* Improve a solution in base.u and cones of the core (sparse_polish.c). It is replaced where
 * Newton's method on the active constraints ends with residuals no worse than `merit`, gap plus
 * residual of the solution, or rounding; otherwise, and when memory does not suffice, it remains
 * unchanged. `hasty`: of an iterate whose active constraints may not show yet, so that less is
 * tried where steps contradict them. */
CpsiPolished cpsi_sparse_polish(CpsiSparseProgram *program, double merit, bool hasty);

#endif
