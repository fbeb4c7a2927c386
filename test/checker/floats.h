/* SPDX-License-Identifier: BSD-3-Clause */
/* What the water does to points that float, by their height above its surface. */
#ifndef CAPSTAN_CHECKER_FLOATS_H
#define CAPSTAN_CHECKER_FLOATS_H

#include "joint_motion.h"
#include "sea.h"

/* In a step the surface about a point is a plane through `at`, and the pressure of the water grows
 * against n. */
typedef struct Afloat {
    Real at[3], n[3];
} Afloat;

/* The surface at rest. And: that of the waves at a time, about a point in a step in time. */
Afloat floats_at_rest(double surface);
Afloat floats_in_waves(const Sea *sea, Real g, Real time, const PointMotion *motion);
/* [m] How high a place is above it, upwards times n_z. */
Real floats_height(const Afloat *surface, const double *x);
/* [m] z of the surface above or below a place. */
Real floats_level(const Afloat *surface, const double *x);

/* [-] How much of a float of the height `extent` is in the water, its middle at a height; where it
 * has no height and is within `touch` of the surface, the least and the most. */
void floats_wet(Real extent, Real height, Real touch, Real share[2]);
/* [J] The work that the buoyancy of a float does from a height up to where all of it is dry. */
Real floats_energy(Real displaced, Real extent, Real height);

#endif
