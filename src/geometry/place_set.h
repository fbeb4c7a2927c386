/* SPDX-License-Identifier: BSD-3-Clause */
/* Closed convex sets of places (capstan/constraint.h), all of one form: with y = Q (x - centre),
 * the rows of Q being orthonormal axes,
 *
 *     low <= y <= high   along each axis, and   |(y_1 .. y_round)| <= radius   where round > 0.
 *
 * Of an axis that is round the interval is the whole line. */
#ifndef CAPSTAN_SRC_GEOMETRY_PLACE_SET_H
#define CAPSTAN_SRC_GEOMETRY_PLACE_SET_H

#include "base/vec3.h"
#include "capstan/constraint.h"

typedef struct CpsiPlaceSet {
    Vec3 centre;            /* [m] */
    double axes[9];         /* rows */
    double low[3], high[3]; /* [m] */
    int round;              /* 0, 2 or 3: the first axes so many */
    double radius;          /* [m] */
} CpsiPlaceSet;

/* Of a constraint that has been checked and is one; of a set of set.h a ball without a radius, in
 * the axes of the scene. */
CpsiPlaceSet cpsi_place_set(const CpsConstraint *given);

/* The place of the set nearest to x. */
Vec3 cpsi_place_set_project(const CpsiPlaceSet *set, Vec3 x);

/* The way from x to that place, in the axes of the set: exactly 0 along those in which x is in it.
 */
void cpsi_place_set_back(const CpsiPlaceSet *set, Vec3 x, double own[3]);

/* The derivative of the nearest place by x; on a boundary that from inside. */
void cpsi_place_set_slopes(const CpsiPlaceSet *set, Vec3 x, double out[3][3]);

/* sup over y in the set of v.(y - x), for x in the set and v (3) in its own axes: v is in the
 * normal cone at x where it vanishes. INFINITY: the set has no end in that direction. */
double cpsi_place_set_gap(const CpsiPlaceSet *set, const double v[3], Vec3 x);

/* The vector with components (3) in the axes of the set; and the components of a vector. */
Vec3 cpsi_place_set_from(const CpsiPlaceSet *set, const double own[3]);
void cpsi_place_set_to(const CpsiPlaceSet *set, Vec3 v, double own[3]);

/* The part of v along which the set has no end: the nearest v in its recession cone. */
Vec3 cpsi_place_set_recedes(const CpsiPlaceSet *set, Vec3 v);

#endif
