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

/* Data that belong to the caller. */
typedef struct CpsiConicData {
    const int *dim;      /* (cones) */
    const double *a, *b; /* (rows, unknowns), (rows) */
    const double *c;     /* (unknowns) */
} CpsiConicData;

typedef struct CpsiConicProgram {
    CpsiHomogeneous core; /* must be the first member, since the loop gets a pointer to it */
    CpsiConicData data;
    /* (size, unknowns + 1), size = unknowns + 1 + rows: the block of du above B; (size, size) in
     * the polish */
    double *matrix;
    double *lu, *fix; /* factor of the remaining matrix; scratch of the refinement (3 size) */
    int *pivot;       /* (size) */
    /* (rows) position of a row of B in the factor, -1: eliminated by hand; number of rows in the
     * factor */
    int *at, kept;
    CpsiActive *active; /* (cones) used by the polish */
} CpsiConicProgram;

/* Memory for a program of this size, unknowns >= 1, in the arena. */
CpsiConicProgram *cpsi_conic_layout(CpsiArena *arena, int unknowns, int rows, int cones,
                                    int largest_cone);

/* Minimise; the data have been set. The outcome is FAILED where the residual or the gap is above
 * `accept`. */
CpsiConicResult cpsi_conic_solve(CpsiConicProgram *program, double accept);

/* Improve the solution in base.u and cones by Newton's method on the active constraints
 * (dense_polish.c); the residual then includes |s0 - |s1|| and |s| of active cones. Called by
 * cpsi_conic_solve. */
void cpsi_conic_polish(CpsiConicProgram *program, CpsiConicResult *found);

#endif
