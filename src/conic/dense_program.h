/* SPDX-License-Identifier: BSD-3-Clause */
/* A small dense conic program
 *
 *     min c.x   s.t.  A x + b in K
 *
 * with K a product of half-lines (dimension 1) and second-order cones (dimension >= 2), in its
 * homogeneous self-dual form (homogeneous.h). A has full column rank. Sets are written so
 * that A and b are of order one. */
#ifndef CAPSTAN_SRC_CONIC_DENSE_PROGRAM_H
#define CAPSTAN_SRC_CONIC_DENSE_PROGRAM_H

#include "conic/active_cone.h"
#include "conic/homogeneous.h"

/* The caller's. */
typedef struct CpsiConicData {
    const int *dim;      /* (cones) */
    const double *a, *b; /* (rows, unknowns), (rows) */
    const double *c;     /* (unknowns) */
} CpsiConicData;

typedef struct CpsiConicProgram {
    CpsiHomogeneous core; /* first: the loop sees it */
    CpsiConicData data;
    /* (size, unknowns + 1), size = unknowns + 1 + rows: the block of du over B; (size, size) for
     * the polish */
    double *matrix;
    double *lu, *fix; /* factor of what is left of it; scratch of the refinement (3 size) */
    int *pivot;       /* (size) */
    int *at, kept;    /* (rows) row of B in the factor, -1: eliminated by hand; how many are not */
    CpsiActive *active; /* (cones) of the polish */
} CpsiConicProgram;

/* Room for a program of this size, unknowns >= 1, in the arena. */
CpsiConicProgram *cpsi_conic_layout(CpsiArena *arena, int unknowns, int rows, int cones,
                                    int largest_cone);

/* Minimise; the data are set. `accept`: residual and gap above which the outcome is FAILED. */
CpsiConicResult cpsi_conic_solve(CpsiConicProgram *program, double accept);

/* Sharpen the solution in base.u and cones by Newton's method on what is active (dense_polish.c);
 * the residual then bounds |s0 - |s1|| and |s| of active cones too. Part of the above. */
void cpsi_conic_polish(CpsiConicProgram *program, CpsiConicResult *found);

#endif
