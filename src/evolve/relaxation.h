/* SPDX-License-Identifier: BSD-3-Clause */
/* A line that jumps: from where it is in no equilibrium to where it comes to rest. */
#ifndef CAPSTAN_SRC_EVOLVE_RELAXATION_H
#define CAPSTAN_SRC_EVOLVE_RELAXATION_H

#include "cable/damped_step.h"

/* What was done on the way. */
typedef struct CpsiRelaxation {
    CpsLedger ledger;
    double dissipated; /* [J] by friction */
    double work[2];    /* [J] of the ends */
    int iterations;
} CpsiRelaxation;

/* Let the line go under line->end and line->turn, held back by a drag that grows and falls with
 * what moves, until it rests: what is left of motion times drag is a small share of its forces.
 * `before` are the ends as they were, `turn` the angles that line->turn points to, which the first
 * time step turns and which are 0 then. Also true once it falls away from all obstacles, which ends
 * the step to come (cable/existence.h). False where it does not come to rest. The line's report
 * holds only the reports of its ends. */
bool cpsi_line_relax(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                     const CpsEnd before[2], double *turn, bool known, CpsiRelaxation *done);

#endif
