/* SPDX-License-Identifier: BSD-3-Clause */
/* The geometry of the contacts of a line: obstacles, normals, gaps, axes, and the slip so far. */
#ifndef CAPSTAN_SRC_CABLE_CONTACT_H
#define CAPSTAN_SRC_CABLE_CONTACT_H

#include "cable/line.h"

#define CPSI_TOUCH CPS_TOUCH /* step.h */

/* At the reference, where a step begins: base, axes, normals, gaps; friction bounds of the
 * reference, a first guess where friction is consistent, zero for an initial configuration by
 * statics (`frictionless`). */
void cpsi_contact_set_reference(CpsiLine *line, CpsContactPolicy contact,
                                CpsFrictionPolicy friction_policy, bool frictionless);

/* Move the base back to the reference, where rounds begin (lines with local axes). */
void cpsi_contact_reset(CpsiLine *line);

/* Axes, curvature, normal, slip, gap and friction law of the present contacts at `base` (lines with
 * local axes). */
void cpsi_contact_update_geometry(CpsiLine *line);

/* [m] The largest penetration of a node into an obstacle that it may not enter, >= 0. */
double cpsi_contact_depth(const CpsiLine *line);

/* [m] The slip between two points along the surface that contact c touches, as cpsi_obstacle_slip;
 * for an element on the obstacle shrunk by the allowance of its chord. */
Vec3 cpsi_contact_slip_between(const CpsiLine *line, int c, Vec3 from, Vec3 to);

/* Does a contact bear, or rub, whose node is beyond a fold, where the face of the contact is not?
 */
bool cpsi_contact_bears_beyond(const CpsiLine *line);

/* Is there a reaction between an obstacle and an element? */
bool cpsi_contact_holds_element(const CpsiLine *line);

/* No reaction and no friction at contact c. */
void cpsi_contact_clear(CpsiLine *line, int c);

/* The slip from the reference to `position` on the tangent planes of the reference: without local
 * axes, or with frozen friction. */
void cpsi_contact_plane_slip(CpsiLine *line);

/* After rounds: elements that bear nothing on what is round, and no longer face it, leave it. */
void cpsi_contact_leave(CpsiLine *line);

/* After rounds: the direction of a slip half round an obstacle is undetermined; it is set to 0
 * where no friction acts. */
void cpsi_contact_clear_undetermined_slip(CpsiLine *line);

/* Has a node with friction moved round its obstacle by more than a quarter of a turn, or slid half
 * round it, the obstacle turning by up to another quarter? Then its slip is not known, and a
 * shorter substep is needed. */
bool cpsi_contact_turns_too_far(const CpsiLine *line);

/* Shorten the displacement from `base` to `position` where it exceeds the range of the tangent
 * planes at the base and, with `sides`, before an element passes to the other side of an obstacle
 * (obstacle_side.h). Returns the remaining share. */
double cpsi_contact_shorten(CpsiLine *line, bool sides);

/* Move `position`, and then `base`, along the surface where nodes touch, by the displacement
 * position - base. Returns the largest angle [rad] by which the axes of a touching node turn. */
double cpsi_contact_move_base(CpsiLine *line, bool sides);

/* Does contact c do nothing: has it neither forces nor a bound, on something rigid or above what
 * gives? */
static inline bool cpsi_contact_is_idle(const CpsiLine *line, int c) {
    const double *f = &line->friction_force[3 * c];
    const CpsiObstacle *obstacle = cpsi_line_obstacle(line, c);
    if (line->friction_bound[c] != 0 || line->reaction[c] != 0 || f[0] != 0 || f[1] != 0 ||
        f[2] != 0)
        return false;
    if (!obstacle || !(obstacle->stiffness > 0)) return true;
    const Vec3 u = vec3_sub(cpsi_line_place(line, line->position, c),
                            cpsi_line_place(line, line->reference, c));
    return vec3_dot(vec3_at(line->normal, c), u) + line->gap[c] >= 0;
}

#endif
