/* SPDX-License-Identifier: BSD-3-Clause */
/* The water about a line, and its drag on a line at rest (capstan/loads.h). */
#ifndef CAPSTAN_SRC_CABLE_FLOW_H
#define CAPSTAN_SRC_CABLE_FLOW_H

#include "cable/line.h"

/* [-] The drag has followed the line where the sum of its changes is below this share of the
 * largest force: of a light line, whose places tell less of its forces, rounding leaves a tenth of
 * it. */
#define CPSI_FOLLOWED 1e-9

/* [m/s] The velocity of the current at height z; and the motion of the water in time at x, which is
 * that and what waves or a function add. */
Vec3 cpsi_flow_velocity(const CpsiFlow *flow, double z);
void cpsi_flow_add_motion(const CpsiFlow *flow, Vec3 x, CpsiWaterMotion *out);
static inline CpsiWaterMotion cpsi_flow_motion(const CpsiFlow *flow, Vec3 x) {
    CpsiWaterMotion out = {.velocity = flow->row_count == 1 ? vec3_load(flow->row->velocity)
                                                            : cpsi_flow_velocity(flow, x.z)};
    if (flow->waves || flow->given) cpsi_flow_add_motion(flow, x, &out);
    return out;
}

/* [N/m] The drag per length of a line in the direction of d, of any length. */
Vec3 cpsi_flow_drag(const CpsiFlow *flow, Vec3 velocity, Vec3 d);

/* Let field.drag be the drag at the positions x (n, 3): that of an element, by its direction and
 * the current in its middle, acts in halves on its nodes. */
void cpsi_line_follow_flow(CpsiLine *line, const double *x);
/* Let it follow the position in a sequence of rounds: half of the way as long as it changes much,
 * and then accelerated (anderson.h). */
void cpsi_line_approach_flow(CpsiLine *line, bool first);
/* [N] The sum of the changes of its forces, if it did at the position; 0 without a flow. */
double cpsi_line_flow_change(const CpsiLine *line);
/* [N] The mean of the drag on node j at the reference and at the position. */
Vec3 cpsi_line_mean_drag(const CpsiLine *line, int j);

#endif
