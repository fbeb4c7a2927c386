/* SPDX-License-Identifier: BSD-3-Clause */
/* The cones of a program, one after the other: pairs (s, z), their Nesterov-Todd scaling, steps and
 * corrections.
 *
 * A half-line is a cone of dimension 1 with W = 1 and g = z/s; for the others see ipm/soc.h. H = g
 * W^-2. */
#ifndef CAPSTAN_SRC_IPM_CONES_H
#define CAPSTAN_SRC_IPM_CONES_H

#include "base/arena.h"
#include "ipm/program.h"

/* Each cone k of `count`, with the first of its dim[k] rows i. */
#define CPSI_FOR_CONES(k, i, count, dim) for (int k = 0, i = 0; k < (count); i += (dim)[k], k++)

typedef struct CpsiCones {
    int rows, count;
    const int *dim;          /* (count) */
    double *s, *z, *ds, *dz; /* (rows) */
    double *q;               /* (rows) right-hand side: dz = q - H ds */
    double *w, *g;           /* (rows), (count) scaling */
    double *rho;             /* (rows) residual: s less its value from the unknowns */
    double *scratch;         /* (4 largest) */
} CpsiCones;

void cpsi_cones_layout(CpsiArena *arena, CpsiCones *cones, int rows, int count, int largest);

/* s = e, z = mu e */
void cpsi_cones_start(CpsiCones *cones, double mu);
/* Scaling at (s, z), and q of the predictor. */
void cpsi_cones_scale(CpsiCones *cones);
/* out = factor W^sign x for cone k, whose rows begin at i; x and out (dim) of the cone, not
 * overlapping. */
void cpsi_cones_apply(const CpsiCones *cones, int k, int i, double sign, double factor,
                      const double *x, double *out);
/* The largest 1/alpha of the boundaries along (ds, dz). */
double cpsi_cones_step(CpsiCones *cones);
/* q of the corrector: s o z -> target e, less the second-order term of (ds, dz). */
void cpsi_cones_correct(CpsiCones *cones, double target);
void cpsi_cones_advance(CpsiCones *cones, double alpha);

#endif
