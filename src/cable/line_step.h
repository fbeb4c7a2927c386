/* SPDX-License-Identifier: BSD-3-Clause */
/* One quasi-static step of one line: problem P4.2 of S90 (= P2.1 and P3.1 by results 4.1 and 4.3)
 * as a conic program. */
#ifndef CAPSTAN_SRC_CABLE_LINE_STEP_H
#define CAPSTAN_SRC_CABLE_LINE_STEP_H

#include "cable/line.h"
#include "cable/step_options.h"
#include "chain/chain_program.h"

/* From the line's position (and its reaction and state there) to the next equilibrium under
 * line->end.
 *
 *   line      reads position, reaction, state; writes every field and the report. Where there is no
 * equilibrium (infeasible, unbounded) position, reaction and state are not changed. program scratch
 * memory for at least line->n nodes
 *
 * Allocates nothing. */
void cpsi_line_step(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options);

/* After a step that finds no solution: does the line slide along itself without end, by this margin
 * (endless_slide.h)? If so it is reported, and position, reaction and state are not changed. For
 * consistent friction only, since frozen bounds do not grow with the tension. */
bool cpsi_line_step_slides_endlessly(CpsiLine *line, const CpsiStepOptions *options, double margin);

/* After a step that finds no solution: is there a proof that the frozen bounds of the reference
 * cannot hold a line with two free ends (existence.h)? If so it is reported, and position, reaction
 * and state are not changed. */
bool cpsi_line_step_outruns_bounds(CpsiLine *line, const CpsiStepOptions *options);

/* Before a step is solved: is the line caught between a sphere and a plane, so that it cannot
 * follow its ends (caught.h)? If so it is reported, and position, reaction and state are not
 * changed. */
bool cpsi_line_step_is_caught(CpsiLine *line, const CpsiStepOptions *options);

/* Before a step is solved: is the line too short to reach round an obstacle to the imposed
 * positions of its ends (shortfall.h)? If so it is reported, and position, reaction and state are
 * not changed. */
bool cpsi_line_step_falls_short(CpsiLine *line, const CpsiStepOptions *options);

/* There is no equilibrium, by a proof that is not the line's alone: the line stays where it is,
 * with this outcome and without forces. What the step imposes is set. */
void cpsi_line_refuse_step(CpsiLine *line, const CpsiStepOptions *options, CpsOutcome outcome);

#endif
