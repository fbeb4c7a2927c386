/* SPDX-License-Identifier: BSD-3-Clause */
/* A large sparse conic program made of small dense blocks:
 *
 *     min c.x   s.t.  E x + h = 0,     A_k x_k + b_k in K_k  for each block k of unknowns x_k,
 *
 * K_k products of half-lines (dimension 1) and second-order cones, solved in the homogeneous self-dual form of
 * dense_program.h with multipliers y of the equations: with tau, kappa >= 0,
 *
 *     A'z + E'y = c tau,  s = A x + b tau in K,  z in K,  E x + h tau = 0,  kappa = - c.x - b.z - h.y.
 *
 * tau > 0 in the limit: x/tau, y/tau, z/tau solve. tau = 0: b.z + h.y < 0 proves that nothing is feasible, c.x < 0
 * that the objective falls without end. Each A_k has full column rank. Time and memory follow the fill of one
 * quasi-definite factor (linalg/sparse_ldl.h); data should be of order one. */
#ifndef CAPSTAN_SRC_CONIC_SPARSE_PROGRAM_H
#define CAPSTAN_SRC_CONIC_SPARSE_PROGRAM_H

#include "base/arena.h"
#include "base/status.h"
#include "ipm/cones.h"
#include "conic/dense_program.h"
#include "linalg/sparse_ldl.h"

/* A block; its arrays belong to the caller, and blocks may share them. Blocks lie one after the other at the front
 * of x, in order; unknowns behind them are free. */
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
    CpsiProgram base;
    CpsiSparseData data;
    CpsiCones cones;
    int *dim;                            /* (cones) of all blocks */
    double *a, *b;                       /* A~ block by block, b~ (rows) */
    size_t *at;                          /* (blocks) where a block's A~ begins, also in `value` */
    CpsiLdl *ldl;
    double *value;                       /* of the condensed system's entries */
    size_t *place, free_place;           /* (blocks) where a block's triangle begins in value; the free unknowns */
    double *regular;                     /* (unknowns + equations) added to the diagonals */
    signed char *sign;                   /* (unknowns + equations) */
    CpsiTriple right, left, fix, answer;     /* right-hand side, residual, correction, solution */
    CpsiTriple turned;                       /* K^-1 p; no tau */
    double below;                        /* the coefficient of dtau */
    double *best;                        /* (size + 2 rows) u, s, z of the best iterate so far */
    CpsiConicResult found;               /* its judgement */
    double kappa, d_kappa, q_tau;
    CpsiArena arena;
} CpsiSparseProgram;

/* Prepare: orders and analyses the system, takes all memory. CPS_ERR_MEMORY, or CPS_ERR_LIMIT where sizes or the
 * factor are beyond what fits. c and h may change between solves, not the rest. */
CpsStatus cpsi_sparse_program_new(const CpsiSparseData *data, CpsiSparseProgram **out, CpsError *err);
void cpsi_sparse_program_free(CpsiSparseProgram *program);

/* Minimise. Results as in dense_program.h: INFEASIBLE: y, z a ray with b.z + h.y = -1; UNBOUNDED: x a ray with c.x =
 * -1. */
CpsiConicResult cpsi_sparse_program_solve(CpsiSparseProgram *program, double accept);

const double *cpsi_sparse_program_x(const CpsiSparseProgram *program);
const double *cpsi_sparse_program_y(const CpsiSparseProgram *program);
const double *cpsi_sparse_program_s(const CpsiSparseProgram *program); /* rows of the blocks in order */
const double *cpsi_sparse_program_z(const CpsiSparseProgram *program);

/* ---- for the files of the program ---- */

/* Products (sparse_blocks.c): out = E x */
void cpsi_sparse_multiply(const CpsiSparseData *d, const double *x, double *out);
/* out += factor E'y */
void cpsi_sparse_add_transposed(const CpsiSparseData *d, double factor, const double *y, double *out);

/* out = A x for the blocks' own matrices, or A~ x where scaled; out += factor A'z, or A~'z */
void cpsi_sparse_blocks_multiply(const CpsiSparseProgram *program, bool scaled, const double *x, double *out);
void cpsi_sparse_blocks_add(const CpsiSparseProgram *program, bool scaled, double factor, const double *z, double *out);

/* Factorise at the iterate, and solve for du (sparse_system.c). */
bool cpsi_sparse_factor(CpsiProgram *base);
void cpsi_sparse_solve(CpsiProgram *base);

/* The last digits of a solution in base.u and cones (sparse_polish.c): replaced where Newton's method on the active
 * constraints ends with residuals no worse than `residual` or rounding; else, and without memory, left as it is. */
void cpsi_sparse_polish(CpsiSparseProgram *program, double residual);

#endif
