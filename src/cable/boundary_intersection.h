/* SPDX-License-Identifier: BSD-3-Clause */
/* The boundary that two planar convex sets made of edges, corners and arcs have in common. */
#ifndef CAPSTAN_SRC_CABLE_BOUNDARY_INTERSECTION_H
#define CAPSTAN_SRC_CABLE_BOUNDARY_INTERSECTION_H

#include "chain/friction_shape.h"

/* Fill the boundary of the intersection of two sets with a point inside both. Its count is 0 where
 * it has too many pieces, or where rounding leaves their order open. */
void cpsi_boundary_intersect(const CpsiFrictionShape *one, const CpsiFrictionShape *other,
                             const double inside[2], CpsiFrictionShape *out);

#endif
