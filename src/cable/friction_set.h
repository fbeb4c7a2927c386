/* SPDX-License-Identifier: BSD-3-Clause */
/* A planar set of friction forces per unit normal force, any of set.h that is bounded and contains
 * 0, prepared for steps: its conic form, the centre of that, and scratch memory, so that its
 * support function needs no allocation. */
#ifndef CAPSTAN_SRC_CABLE_FRICTION_SET_H
#define CAPSTAN_SRC_CABLE_FRICTION_SET_H

#include "capstan/set.h"
#include "chain/elements.h"

typedef struct CpsiFrictionSet CpsiFrictionSet;

/* Is the set admissible as a set of friction forces? `name` is that of its obstacle. */
CpsStatus cpsi_friction_set_check(const CpsSet *set, const char *name, CpsError *err);

/* Make a friction set from a set that has passed the check; NULL for {0}, which is no friction. The
 * caller frees it. */
CpsStatus cpsi_friction_set_make(const CpsSet *set, const char *name, CpsiFrictionSet **out,
                                 CpsError *err);
void cpsi_friction_set_free(CpsiFrictionSet *set);

const CpsiConicSet *cpsi_friction_set_conic(const CpsiFrictionSet *set);
/* Its boundary as edges, corners and arcs; NULL where it is not made of these. */
const CpsiFrictionShape *cpsi_friction_set_shape(const CpsiFrictionSet *set);

/* phi(u) = max -<u, F> over the set: by a formula for polygons, for what is made of points, discs,
 * ellipses and boxes by sums, hulls and linear maps, and for intersections of such sets whose
 * boundaries are edges, corners and arcs; else to about 1e-13 of reach |u| by a
 * small conic program, NaN where that failed. Then it is not thread-safe: it writes to the set's
 * scratch memory. */
double cpsi_friction_set_phi(const CpsiFrictionSet *set, const double u[2]);

#endif
