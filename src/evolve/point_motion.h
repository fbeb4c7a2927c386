/* SPDX-License-Identifier: BSD-3-Clause */
/* Points in time (capstan/motion.h). A point moves by the scheme of the nodes of lines
 * (time_step.h), and the ends of lines at it have its history: x*, v* and k are theirs as well, so
 * that two lines joined by a point are one line. */
#ifndef CAPSTAN_SRC_EVOLVE_POINT_MOTION_H
#define CAPSTAN_SRC_EVOLVE_POINT_MOTION_H

#include "evolve/state.h"

/* The points and the ends of lines at them begin with the velocities that the scene gives; bodies
 * have theirs. */
void cpsi_point_motion_start(CpsEvolution *evolution);

/* Give each point and the ends of lines at it one next step: an Euler step where that of one of
 * them is; where an obstacle moves, of all lines and points of a group (points.h), which are found.
 * Of one group, whose step is taken again, those of other groups stay as they are: they may have
 * been advanced. */
enum { CPSI_ALL_GROUPS = -2 };
void cpsi_point_motion_join(CpsEvolution *evolution, int group);
/* x*, v* and k of the step that begins. */
void cpsi_point_motion_predict(CpsEvolution *evolution);

/* [N] The inertia of a point at a place, in a step in time. */
Vec3 cpsi_point_inertia(const CpsiPoint *point, Vec3 place);
/* [N/m] minus its derivative. */
double cpsi_point_inertia_stiffness(const CpsiPoint *point);

/* [J] What the scheme loses if free point `index` comes to a place, where obstacle `on` bears it
 * with a reaction [N] along a normal: to inertia, of the point and of the ends of lines there, and
 * to what gives. Below 0 the point would gain it. */
double cpsi_point_loss(CpsEvolution *evolution, int index, Vec3 place, int on, double reaction,
                       Vec3 normal);

/* The step has been taken, and the points are reported on: the ledger, and the step becomes the
 * past. */
void cpsi_point_motion_advance(CpsEvolution *evolution);
/* A quasi-static step has been taken: all are at rest. */
void cpsi_point_motion_stop(CpsEvolution *evolution);

#endif
