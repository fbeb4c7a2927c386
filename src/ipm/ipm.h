/* SPDX-License-Identifier: BSD-3-Clause */
/* The interior-point loop on a program of elements (program.h). */
#ifndef CAPSTAN_SRC_IPM_IPM_H
#define CAPSTAN_SRC_IPM_IPM_H

#include <stdbool.h>

#include "ipm/program.h"

typedef enum CpsiIpmOutcome {
    CPSI_IPM_SOLVED, /* gap and residuals reached the target */
    /* no further progress, or interrupted: the certificate of the iterate decides */
    CPSI_IPM_STALLED,
    CPSI_IPM_ITERATION_LIMIT,
    CPSI_IPM_INFEASIBLE, /* the duals are a ray that proves there is no feasible u */
    CPSI_IPM_UNBOUNDED   /* u is a ray along which the objective decreases without bound */
} CpsiIpmOutcome;

typedef struct CpsiIpmOptions {
    double target; /* relative complementarity gap to reach */
    double scale;  /* > 0: smallest energy that the gap is compared with */
    int max_iterations;
    /* steps without halving the best gap after which the loop gives up while it is far from the
     * solution; 0: as later, which suits most programs */
    int patience;
    /* Centring steps after the target is reached. They align each dual with its primal, which the
     * gap does not measure. */
    int centering_steps;
    /* Number of further steps where forces are bounded by friction, each towards a smaller product
     * s.z: they separate nodes that stick from nodes that slip. */
    int sharpenings;
    bool goes_on; /* from the iterate that stands, instead of a start of its own */
} CpsiIpmOptions;

typedef struct CpsiIpmReport {
    CpsiIpmOutcome outcome;
    int iterations;
    double gap;      /* sum of weight s.z, relative to the scale + sum of weight s0 z0 */
    double residual; /* largest |rho| */
    /* largest force at a node, relative to the largest dual where that exceeds 1 */
    double imbalance;
} CpsiIpmReport;

/* Minimise. The program holds its data, u at held nodes and a first guess elsewhere, and s1 = e of
 * each segment at that guess. On return u, s, z hold the last iterate, always interior and finite.
 * Allocates nothing. */
CpsiIpmReport cpsi_ipm_solve(CpsiProgram *program, const CpsiIpmOptions *options);

#endif
