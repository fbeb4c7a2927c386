/* SPDX-License-Identifier: BSD-3-Clause */
/* The boundary of a friction set as edges, corners and arcs, found from its support function. */
#ifndef CAPSTAN_SRC_CABLE_FRICTION_BOUNDARY_H
#define CAPSTAN_SRC_CABLE_FRICTION_BOUNDARY_H

#include "chain/friction_shape.h"
#include "set/set.h"

/* Fill the boundary of a planar set with a support function by formula and points no farther from 0
 * than `reach`. Its count is 0 where the boundary has other pieces, or too many, or no inside. */
void cpsi_friction_boundary_find(const CpsSet *closed, double reach, CpsiFrictionShape *shape);

/* The normals of arcs beside an edge become those of the edge, and `inner` the distance of the
 * nearest piece from 0. */
void cpsi_friction_boundary_finish(CpsiFrictionShape *shape);

#endif
