/* SPDX-License-Identifier: BSD-3-Clause */
/* What the nodes of a line see of the obstacles: normals, gaps, axes, and the way slid so far. */
#ifndef CAPSTAN_SRC_CABLE_CONTACT_H
#define CAPSTAN_SRC_CABLE_CONTACT_H

#include "cable/line.h"

#define CPSI_TOUCH CPS_TOUCH /* evolve.h */

/* [rad] In one part of a step no obstacle turns by more, and no node with friction goes farther
 * round one. */
#define CPSI_QUARTER 1.57079632679489661923

/* At the reference, where a step begins: base, axes, normals, gaps; friction bounds of the
 * reference, a first guess where friction is consistent, none for a start laid by statics
 * (`frictionless`). */
void cpsi_contact_set_reference(CpsiLine *line, CpsContactPolicy contact,
                                CpsFrictionPolicy friction, bool frictionless);

/* Back to the reference (a line that follows), from where the rounds begin. */
void cpsi_contact_reset(CpsiLine *line);

/* The contacts of the nodes at `base` (a line that follows): the nearest obstacles. Those it had
 * keep what they have, in whatever place. `pressed`: one that is pressed stays with its obstacle,
 * whatever is as near. */
void cpsi_contact_detect(CpsiLine *line, bool pressed);

/* From another place of the nodes (a line that follows), with the contacts that they have: axes,
 * curvature, normal, slide and gap at `base`. */
void cpsi_contact_update_geometry(CpsiLine *line);

/* [m] How deep the deepest node is inside an obstacle that keeps it out, >= 0. */
double cpsi_contact_depth(const CpsiLine *line);

/* [m] The way between two points along the surface that contact c touches, as cpsi_obstacle_slip:
 * of an element that of the obstacle shrunk by what its chord may cut in. */
Vec3 cpsi_contact_slip_between(const CpsiLine *line, int c, Vec3 from, Vec3 to);

/* No reaction and no friction at contact c. */
void cpsi_contact_clear(CpsiLine *line, int c);

/* The way slid from the reference to `position` on the tangent planes of the pose: where nothing
 * follows, or friction is frozen. */
void cpsi_contact_plane_slip(CpsiLine *line);

/* A way half round an obstacle has no direction: it is 0 of what no friction acts on. After
 * rounds. */
void cpsi_contact_clear_undetermined_slip(CpsiLine *line);

/* Has a node with friction gone round its obstacle by more than a quarter of a turn, or on the
 * obstacle, which turned by up to another, half round? Then the way that it slid is not known: a
 * shorter part of the step is needed. */
bool cpsi_contact_turns_too_far(const CpsiLine *line);

/* Shorten the way from `base` to `position` where it goes farther than the tangent planes there
 * tell, and, if `sides` matter, before an element comes to the other side of an obstacle
 * (obstacle_side.h). Returns the share that is left. */
double cpsi_contact_shorten(CpsiLine *line, bool sides);

/* Along the surface: what `position` and then `base` become when the nodes move by `position` -
 * base, where they touch. Returns the largest angle [rad] by which a touching node's axes turn on
 * the way: what the next look changes. */
double cpsi_contact_move_base(CpsiLine *line, bool sides);

#endif
