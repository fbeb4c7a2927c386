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
 * where the line is expected; and for the next one, about where the last one has taken it and the
 * flow was seen, or to where these converge; `left` is what the last one lacked. */
void cpsi_line_begin_swim(CpsiLine *line);
/* ... about the places y (n, 3) that are given. */
void cpsi_line_see_swim(CpsiLine *line, const double *y);
void cpsi_line_approach_swim(CpsiLine *line, double left);
/* What of the flow belongs to an element of the line. */
CpsiWaterShare cpsi_water_share(const CpsiFlow *flow);
/* [N] See the flow at the position: the sum over the nodes of its forces there less those of the
 * program, and the largest of them. */
double cpsi_line_swim_change(const CpsiLine *line, double *largest);
/* [N] What of that the rounding of places may be, where the flow was seen. */
double cpsi_line_swim_rounding(const CpsiLine *line);
/* Let the flow's forces at the position, where it was seen, be given loads from now on, and the
 * field inertia alone; and the same where it is yet to be seen. */
void cpsi_line_end_swim(CpsiLine *line, double left);
void cpsi_line_settle_swim(CpsiLine *line);
/* Add to K (6) [N/m] of node j what the flow's forces, where it was seen, lose with its place, by
 * its velocity and acceleration; that they change with the directions of the elements is not in it.
 */
void cpsi_line_add_water_stiffness(const CpsiLine *line, int j, double k[6]);

#endif
