/* SPDX-License-Identifier: BSD-3-Clause */
/* A step in time of one line (docs/theory.md): the program of a quasi-static step with the inertia
 * of its nodes, from the reference that the scheme gives. */
#ifndef CAPSTAN_SRC_EVOLVE_TIME_STEP_H
#define CAPSTAN_SRC_EVOLVE_TIME_STEP_H

#include "evolve/substeps.h"

typedef struct CpsiTimeStep {
    CpsiFormula formula;
    CpsTimeScheme scheme;
    bool restarts; /* the obstacles have not moved at this rate before: an Euler step */
    bool in_group; /* which takes it again where it is rough, and says where it goes too far */
} CpsiTimeStep;

/* Take the step; the line has mass. Its report is that of a step of one part, and its motion in
 * line->inertia. */
void cpsi_line_time_step(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                         const CpsiMove *move, CpsiSubsteps *scratch, const CpsiTimeStep *step);

/* Has an element been snatched taut in the step of length h, or a node gone into or out of what
 * gives, of which a node was not taken by an Euler step? If so, the nodes are noted, and after the
 * line has been returned to where the step began, are to be taken by one. */
bool cpsi_line_is_rough(CpsiLine *line, double h);
void cpsi_line_restart_rough(CpsiLine *line);

#endif
