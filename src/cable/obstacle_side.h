/* SPDX-License-Identifier: BSD-3-Clause */
/* The sides of cylinders and spheres on which a line lies: no step may move it across an axis or a
 * centre. */
#ifndef CAPSTAN_SRC_CABLE_OBSTACLE_SIDE_H
#define CAPSTAN_SRC_CABLE_OBSTACLE_SIDE_H

#include "base/math.h"
#include "cable/line.h"

/* [rad] In one substep no obstacle turns by more, and no node with friction moves farther round
 * one. */
#define CPSI_QUARTER (0.5 * CPSI_PI)
/* A round obstacle that goes no farther than this share of its radius at once keeps its axis or
 * centre on its side of what it pushes. */
#define CPSI_MOST_SHIFT 0.25

/* The share of a move at which an element comes too near to an axis or a centre, or `most` if none
 * does. All nodes move straight and simultaneously from `from` to `to` (n, 3). An element may not
 * come nearer than half of its former distance, or half the radius if that is less. All round
 * obstacles count, also those without contacts. */
double cpsi_obstacle_side_share(const CpsiLine *line, const double *from, const double *to,
                                double most);

/* The round obstacle that such a move passes: an element comes as near to its axis or centre as it
 * must not. CPS_NO_OBSTACLE where none is passed. */
int cpsi_obstacle_passed(const CpsiLine *line, const double *from, const double *to);

/* A step in time is not divided as others are. Does an obstacle turn too far in it,
 * about its own axis by `angle` [rad] and by `shift`, or NULL? */
bool cpsi_obstacle_turns_too_far(double angle, const CpsiShift *shift);

/* May an obstacle, which is shifted to where it is now, have gone past what went from `from` to x
 * meanwhile, and reaches as far as `reach` [m] from there? What goes along with it, by up to
 * CPSI_MOST_SHIFT of its radius, is where it was as seen from the obstacle, and all that is outside
 * of it there has a radius of it between one side and the other. */
bool cpsi_obstacle_may_pass(const CpsiObstacle *obstacle, const CpsiShift *shift, Vec3 from, Vec3 x,
                            double reach);

#endif
