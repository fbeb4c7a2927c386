/* SPDX-License-Identifier: BSD-3-Clause */
/* A large sparse conic program made of small dense blocks:
 *
 *     min c.x   s.t.  E x + h = 0,     A_k x_k + b_k in K_k  for each block k of unknowns x_k,
 *
 * K_k products of half-lines (dimension 1) and second-order cones, in its homogeneous self-dual
 * form (homogeneous.h). Each A_k has full column rank. Time and memory follow the fill of one
 * quasi-definite factor (linalg/sparse_ldl.h); data should be of order one. */
#ifndef CAPSTAN_SRC_CONIC_SPARSE_PROGRAM_H
#define CAPSTAN_SRC_CONIC_SPARSE_PROGRAM_H

#include "base/status.h"
#include "conic/homogeneous.h"
#include "linalg/sparse_ldl.h"

/* A block; its arrays belong to the caller, and blocks may share them. Blocks lie one after the
 * other at the front of x, in order; unknowns behind them are free. */
typedef struct CpsiBlock {
    int unknowns, rows, cones;
    const int *dim;      /* (cones) */
    const double *a, *b; /* (rows, unknowns), (rows) */
} CpsiBlock;

/* Data: the caller's. Rows of E hold each column once. */
typedef struct CpsiSparseData {
    int unknowns, equations, blocks;
    const CpsiBlock *block;
    const size_t *start; /* (equations + 1) row i of E: entries start[i] .. start[i + 1] */
    const int *column;
    const double *value;
    const double *c, *h; /* (unknowns), (equations) */
} CpsiSparseData;

/* A vector (x, -y, -w, tau) of the system: one array. */
typedef struct CpsiTriple {
    double *x, *y, *w, *tau;
} CpsiTriple;

typedef struct CpsiSparseProgram {
    CpsiHomogeneous core; /* first: the loop sees it */
    CpsiSparseData data;
    int *dim;                    /* (cones) of all blocks */
    double *b;                   /* (rows) of all blocks */
    double *scaled_a, *scaled_b; /* A~ block by block, b~ (rows) */
    size_t *at;                  /* (blocks) where a block's A~ begins */
    CpsiLdl *ldl;
    double *value;                       /* of the condensed system's entries */
    size_t *place;                       /* (blocks) where a block's triangle begins in value */
    size_t free_place;                   /* where the free unknowns begin there */
    double *regular;                     /* (unknowns + equations) added to the diagonals */
    signed char *sign;                   /* (unknowns + equations) */
    CpsiTriple right, left, fix, answer; /* right-hand side, residual, correction, solution */
    CpsiTriple turned;                   /* K^-1 p; no tau */
    double below;                        /* the coefficient of dtau */
    CpsiArena arena;
} CpsiSparseProgram;

/* Prepare: orders and analyses the system, takes all memory. CPS_ERR_MEMORY, or CPS_ERR_LIMIT where
 * sizes or the factor are beyond what fits. c and h may change between solves, not the rest. */
CpsStatus cpsi_sparse_program_new(const CpsiSparseData *data, CpsiSparseProgram **out,
                                  CpsError *err);
void cpsi_sparse_program_free(CpsiSparseProgram *program);

/* Minimise. `accept`: residual and gap above which the outcome is FAILED; s and z are rows of the
 * blocks in order. */
CpsiConicResult cpsi_sparse_program_solve(CpsiSparseProgram *program, double accept);

/* ---- for the files of the program ---- */

/* Products (sparse_blocks.c): out = E x */
void cpsi_sparse_multiply(const CpsiSparseData *d, const double *x, double *out);
/* out += factor E'y */
void cpsi_sparse_add_transposed(const CpsiSparseData *d, double factor, const double *y,
                                double *out);

/* out = A x for the blocks' own matrices, or A~ x where scaled; out += factor A'z, or A~'z */
void cpsi_sparse_blocks_multiply(const CpsiSparseProgram *program, bool scaled, const double *x,
                                 double *out);
void cpsi_sparse_blocks_add(const CpsiSparseProgram *program, bool scaled, double factor,
                            const double *z, double *out);

/* sparse_system.c */
extern const CpsiConicOperator cpsi_sparse_operator;

/* The last digits of a solution in base.u and cones of the core (sparse_polish.c): replaced where
 * Newton's method on the active constraints ends with residuals no worse than `residual` or
 * rounding; else, and without memory, left as it is. */
void cpsi_sparse_polish(CpsiSparseProgram *program, double residual);

#endif
