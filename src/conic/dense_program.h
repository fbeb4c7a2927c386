/* SPDX-License-Identifier: BSD-3-Clause */
/* A small dense conic program for the interior-point loop:
 *
 *     min c.v   s.t.  A v + b in K,      K a product of half-lines (dimension 1) and second-order cones (dimension
 * >= 2)
 *
 * solved in its homogeneous self-dual form (Ye, Todd and Mizuno 1994), which has an interior start and ends in a
 * solution or in a proof that there is none. With tau, kappa >= 0:
 *
 *     s = A v + b tau  in K,    A'z = c tau,  z in K,    kappa = - c.v - b.z,
 *
 * that is  G'z + e kappa + S u = 0  for u = (v, tau), G = [A b], e = (0, 1), S u = (-c tau, c.v): cones on linear maps
 * of u and a skew term. tau > 0 in the limit: v/tau solves, z/tau is its dual. tau = 0: b.z < 0 proves that nothing is
 * feasible, c.v < 0 that the objective falls without end. A has full column rank. Sets are written so that A and b are
 * of order one. */
#ifndef CAPSTAN_SRC_CONIC_DENSE_PROGRAM_H
#define CAPSTAN_SRC_CONIC_DENSE_PROGRAM_H

#include <stddef.h>

#include "base/arena.h"
#include "ipm/ipm.h"

typedef enum CpsiConicOutcome {
    CPSI_CONIC_SOLVED,
    CPSI_CONIC_INFEASIBLE, /* z: A'z = 0, z in K, b.z = -1 */
    CPSI_CONIC_UNBOUNDED,  /* v: A v in K, c.v = -1 */
    CPSI_CONIC_FAILED      /* the residuals stayed above what the caller would accept */
} CpsiConicOutcome;

/* How a cone binds the solution (dense_polish.c). */
typedef enum CpsiActive { CPSI_FREE, CPSI_RAY, CPSI_TIP } CpsiActive;

/* What came out; v, s, z are divided by what normalises the outcome and lie in the program's arrays (base.u, s, z). */
typedef struct CpsiConicResult {
    CpsiConicOutcome outcome;
    int iterations;
    double gap;      /* s.z of the solution */
    double residual; /* largest |A v + b - s| and |A'z - c| */
} CpsiConicResult;

/* Data (the caller's) and iterate (the program's). */
typedef struct CpsiConicProgram {
    CpsiProgram base;
    int unknowns, rows, cones;
    const int *dim;        /* (cones) */
    const double *a, *b;   /* (rows, unknowns), (rows) */
    const double *c;       /* (unknowns) */
    double *s, *z, *ds, *dz, *q, *w, *rho; /* (rows) */
    double *g;             /* (cones) */
    double *scratch;       /* (4 largest cone) */
    double *matrix;        /* (size, unknowns + 1), size = unknowns + 1 + rows: the block of du over B; (size, size)
                              for the polish */
    double *lu, *fix;      /* factor of what is left of it; scratch of the refinement (3 size) */
    int *pivot;            /* (size) */
    int *at, kept;         /* (rows) row of B in the factor, -1: eliminated by hand; how many are not */
    CpsiActive *active;    /* (cones) of the polish */
    double kappa, d_kappa, q_tau;
    double *best;          /* (unknowns + 1 + 2 rows) u, s, z of the best iterate: late steps may only add rounding */
    CpsiConicResult found; /* its judgement */
} CpsiConicProgram;

/* Room for a program of this size, unknowns >= 1, in the arena. */
CpsiConicProgram *cpsi_conic_layout(CpsiArena *arena, int unknowns, int rows, int cones, int largest_cone);

/* Minimise; a, b, c, dim are set. `accept`: residual and gap above which the outcome is FAILED. */
CpsiConicResult cpsi_conic_solve(CpsiConicProgram *program, double accept);

/* Sharpen the solution in base.u, s, z by Newton's method on what is active (dense_polish.c); the residual then bounds
 * |s0 - |s1|| and |s| of active cones too. Part of the above. */
void cpsi_conic_polish(CpsiConicProgram *program, CpsiConicResult *found);

#endif
