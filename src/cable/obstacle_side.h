/* SPDX-License-Identifier: BSD-3-Clause */
/* The sides on which a line lies of cylinders and spheres: nothing in a step carries it across an
 * axis or a centre. */
#ifndef CAPSTAN_SRC_CABLE_OBSTACLE_SIDE_H
#define CAPSTAN_SRC_CABLE_OBSTACLE_SIDE_H

#include "cable/line.h"

/* The share of a move at which an element has come too near to an axis or a centre, or `most` if
 * none does: all nodes go straight, at the same time, from `from` to `to` (n, 3), and no element
 * may come nearer than half of its distance before, nor than half the radius where it was farther
 * than that. Every round obstacle counts, watched or not. */
double cpsi_obstacle_side_share(const CpsiLine *line, const double *from, const double *to,
                                double most);

#endif
