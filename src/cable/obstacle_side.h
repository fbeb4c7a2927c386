/* SPDX-License-Identifier: BSD-3-Clause */
/* The sides of cylinders and spheres on which a line lies: no step may move it across an axis or a
 * centre. */
#ifndef CAPSTAN_SRC_CABLE_OBSTACLE_SIDE_H
#define CAPSTAN_SRC_CABLE_OBSTACLE_SIDE_H

#include "cable/line.h"

/* The share of a move at which an element comes too near to an axis or a centre, or `most` if none
 * does. All nodes move straight and simultaneously from `from` to `to` (n, 3). An element may not
 * come nearer than half of its former distance, or half the radius if that is less. All round
 * obstacles count, also those without contacts. */
double cpsi_obstacle_side_share(const CpsiLine *line, const double *from, const double *to,
                                double most);

/* The round obstacle that such a move passes: an element comes as near to its axis or centre as it
 * must not. CPS_NO_OBSTACLE where none is passed. */
int cpsi_obstacle_passed(const CpsiLine *line, const double *from, const double *to);

#endif
