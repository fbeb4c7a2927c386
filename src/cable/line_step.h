/* SPDX-License-Identifier: BSD-3-Clause */
/* One quasi-static step of one line: problem P4.2 of S90 (= P2.1 and P3.1 by results 4.1 and 4.3) as a conic program. */
#ifndef CAPSTAN_SRC_CABLE_LINE_STEP_H
#define CAPSTAN_SRC_CABLE_LINE_STEP_H

#include "cable/least_motion.h"
#include "cable/line.h"
#include "ipm/chain_program.h"

typedef struct CpsiStepOptions {
    CpsSolverOptions solver;
    CpsFriction friction;
    CpsContact contact;
    bool frictionless; /* a start laid by statics */
    CpsiLeastMotion *least; /* scratch of the rule of least motion; NULL: places are as they are found */
    /* set by the step itself */
    int centrings;
    bool slow;    /* many rounds, that do not look ahead */
    bool turning; /* reactions turn with their normals within a round */
    bool trying;  /* bounds that are tried, not bounds that follow */
    bool dragged; /* rounds that a drag may hold back */
    double drag;  /* what it is in a round (step_program.h) */
} CpsiStepOptions;

/* From the line's position (and its reaction and state there) to the next equilibrium under line->end.
 *
 *   line      reads position, reaction, state; writes every field and the report. Where there is no equilibrium
 *             (infeasible, unbounded) position, reaction and state stay.
 *   program   scratch laid out for at least line->n nodes
 *
 * Allocates nothing. */
void cpsi_line_step(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options);

/* Instead of a step that finds no answer: does the line slide along itself without end, by this margin (slides.h)?  Then the report says so, and position,
 * reaction and state stay. Coulomb's friction alone; frozen friction has bounds that no tension raises. */
bool cpsi_line_step_slides(CpsiLine *line, const CpsiStepOptions *options, double margin);

#endif
