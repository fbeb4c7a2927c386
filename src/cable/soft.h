/* SPDX-License-Identifier: BSD-3-Clause */
/* Obstacles that give (CpsObstacle.stiffness, CpsLine.bearing_width): the obstacle opposes to a
 * node that lies deeper than its surface by d the reaction R = k d, k = stiffness x width x the
 * length of line that the node stands for, and pulls at none. Friction has the bound mu R as on a
 * rigid one. Only nodes bear on it: the integral of the pressure over the line is taken by their
 * values. */
#ifndef CAPSTAN_SRC_CABLE_SOFT_H
#define CAPSTAN_SRC_CABLE_SOFT_H

#include "cable/line.h"

/* Does an obstacle of the line give? */
bool cpsi_line_has_soft(const CpsiLine *line);

/* [N/m] k of contact c; 0 where its obstacle is rigid, or there is none. */
double cpsi_soft_stiffness(const CpsiLine *line, int c);

/* [m] How much deeper than the surface slip at x is measured. */
double cpsi_soft_way_depth(const CpsiObstacle *obstacle, Vec3 x);

/* [m] The least height, over an obstacle that gives and is no contact of its, of node j at the
 * position; INFINITY: there is none. */
double cpsi_soft_missed(const CpsiLine *line, int j);

/* [J] Stored in what gives, at the position; `before`: before it was shifted to where it is now. */
double cpsi_soft_energy(const CpsiLine *line, bool before);

#endif
