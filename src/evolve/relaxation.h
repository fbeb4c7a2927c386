/* SPDX-License-Identifier: BSD-3-Clause */
/* A jump of a line: from a configuration without equilibrium to where it comes to rest. */
#ifndef CAPSTAN_SRC_EVOLVE_RELAXATION_H
#define CAPSTAN_SRC_EVOLVE_RELAXATION_H

#include "cable/damped_step.h"

/* The sums over the motion. */
typedef struct CpsiRelaxation {
    CpsLedger ledger;
    double dissipated; /* [J] by friction */
    double work[2];    /* [J] of the ends */
    int iterations;
} CpsiRelaxation;

/* Move the line under line->end and line->turn against a viscous drag, which is adapted to the
 * motion, until it comes to rest: drag times motion is a small share of its forces. `before` are
 * the former ends. The first time step applies the turns and shifts of the obstacles, which are
 * then set to 0. Also true once the line falls away from all obstacles, which the next step reports
 * (cable/existence.h). False where it does not come to rest. Of the line's report only the reports
 * of its ends are set. */
bool cpsi_line_relax(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                     const CpsEnd before[2], bool known, CpsiRelaxation *done);

#endif
