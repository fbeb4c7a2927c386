/* SPDX-License-Identifier: BSD-3-Clause */
/* The interior-point loop on a program of elements (program.h). */
#ifndef CAPSTAN_SRC_IPM_IPM_H
#define CAPSTAN_SRC_IPM_IPM_H

#include "ipm/program.h"

typedef enum CpsiIpmOutcome {
    CPSI_IPM_SOLVED,  /* gap and residuals reached the target */
    CPSI_IPM_STALLED, /* no further progress, or interrupted: judge the iterate by its certificate
                       */
    CPSI_IPM_ITERATION_LIMIT,
    CPSI_IPM_INFEASIBLE, /* the duals are a ray that proves there is no feasible u */
    CPSI_IPM_UNBOUNDED   /* u is a ray along which the objective falls for ever */
} CpsiIpmOutcome;

typedef struct CpsiIpmOptions {
    double target; /* relative complementarity gap to reach */
    double scale;  /* > 0: what the gap is at least compared with */
    int max_iterations;
    int patience; /* steps without halving the best gap before the loop gives up; 0: as many as
                     serves most programs */
    int centering_steps; /* steps to the centre once the target is reached: they turn each dual to
                      its primal, which a gap does not see */
    int sharpenings; /* so many more where forces are bounded by friction, each towards a smaller
                        product: what rests and what slips part */
} CpsiIpmOptions;

typedef struct CpsiIpmReport {
    CpsiIpmOutcome outcome;
    int iterations;
    double gap;       /* sum of weight s.z, relative to the scale + sum of weight s0 z0 */
    double residual;  /* largest |rho| */
    double imbalance; /* largest of forces at a node, relative to the largest dual where that
                         exceeds 1 */
} CpsiIpmReport;

/* Minimise. The program holds its data, u at held nodes and a first guess elsewhere, and s1 = e of
 * each stretch at that guess. On return u, s, z hold the last iterate, always interior and finite.
 * Allocates nothing. */
CpsiIpmReport cpsi_ipm_solve(CpsiProgram *program, const CpsiIpmOptions *options);

#endif
