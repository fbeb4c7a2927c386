/* SPDX-License-Identifier: BSD-3-Clause */
/* Free points on obstacles that give (CpsPoint.bearing_area; cable/soft.h has the nodes of lines).
 * The obstacle opposes to a point that lies deeper than its surface by d the reaction R = k d, k =
 * stiffness x area. The area is that of the point, and of the half of the last element of every
 * line that ends there its length times the bearing width of the line: so a line that is cut at a
 * node bears there as before. In a step in time damping of the obstacle opposes the motion with the
 * same area. */
#ifndef CAPSTAN_SRC_EVOLVE_SOFT_POINT_H
#define CAPSTAN_SRC_EVOLVE_SOFT_POINT_H

#include "cable/soft.h"
#include "evolve/state.h"

/* Find the areas of all points, of the lines that end there in the step. */
void cpsi_soft_point_areas(CpsEvolution *evolution);
/* [N/m] k of point `index` on obstacle `on`; 0 of one that does not give. */
double cpsi_soft_point_stiffness(const CpsEvolution *evolution, int index, int on);
/* What opposes it in the step under way, as a node (cable/soft.h); `from`: its reference x*, or
 * where the step began, on the obstacle as it is now. */
CpsiSoft cpsi_soft_point_spring(const CpsEvolution *evolution, int index, int on, Vec3 from);
/* Has it gone into or out of what gives, if it comes to a place in the step? */
bool cpsi_soft_point_is_crossed(const CpsEvolution *evolution, int index, Vec3 place);
/* Does a place lie in two obstacles that give? A point bears on the one alone in which it lies
 * deepest: at the groove between both its force jumps from one to the other. */
bool cpsi_soft_point_is_between(const CpsEvolution *evolution, Vec3 place);
/* [N] What the obstacle in which it lies deepest, if that gives, does to it where it is. */
Vec3 cpsi_soft_point_push(const CpsEvolution *evolution, int index);
/* [J] What obstacles that give have stored more under a point, if it comes to a place, than before
 * the step; and what that in which it lies has lost to its damping in a step in time, with a
 * reaction [N]. 0 of one that is not free. */
double cpsi_soft_point_growth(const CpsEvolution *evolution, int index, Vec3 place);
double cpsi_soft_point_damped(const CpsEvolution *evolution, int index, Vec3 place,
                              double reaction);

#endif
