/* SPDX-License-Identifier: BSD-3-Clause */
/* The forces of the water on a line that moves in time (docs/theory.md 9): Morison's drag in the
 * velocity of the water relative to the nodes, the inertia of the water that is moved along, and
 * the force of the water's own acceleration in waves, all by the directions of the elements. */
#ifndef CAPSTAN_SRC_CABLE_MOVING_FLOW_H
#define CAPSTAN_SRC_CABLE_MOVING_FLOW_H

#include "cable/line.h"

/* Is the line in a flow, and the step one in time? */
static inline bool cpsi_line_swims(const CpsiLine *line) {
    return line->field.flow && line->inertia.is_moving;
}

/* Write the forces of the flow for the first program of the step, linear in the new places, about
 * where inertia alone would take the line; and for the next one, about where the last one has taken
 * it, or to where these converge; `left` is what the last one lacked (cpsi_line_swim_change). */
void cpsi_line_begin_swim(CpsiLine *line);
void cpsi_line_approach_swim(CpsiLine *line, double left);
/* [N] The sum over the nodes of the flow's forces at the position less those of the program; and
 * the largest of them, NULL: not asked for. */
double cpsi_line_swim_change(const CpsiLine *line, double *largest);
/* Let the flow's forces at the place x be given loads from now on, and the field inertia alone. */
void cpsi_line_settle_swim(CpsiLine *line, const double *x);

#endif
