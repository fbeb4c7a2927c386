/* SPDX-License-Identifier: BSD-3-Clause */
/* The surface of the water, at which free points float (points.h). A point at the height h above it
 * has the buoyancy B n, and with D the weight of the water that it displaces and H the height of
 * the float, of which it is the middle,
 *
 *     B = D min(1, max(0, 1/2 - h/H)),     where H = 0     B = D where h < 0,
 *                                                          0 <= B <= D where h = 0,
 *                                                          B = 0 where h > 0:
 *
 * minus the derivative of a convex energy of h = n.(x - at). In the search for its place
 * (newton_step.h) it is a contact of bounded force where H = 0, and a spring elsewhere.
 *
 * The surface at rest is z = constant, and n is upwards. In waves the pressure in the water grows
 * against n = e_z + a/g, a the acceleration of the water, which is the force of Archimedes and that
 * of Froude and Krylov in one. Both the height of the surface and a are those at the end of the
 * step in the place x* + k v* that the point would come to if nothing acted on it: so the surface
 * is a plane in a step, and the step a minimum. Where the point comes to the
 * plane is off the surface of the waves by the distance of both places, which is of second order in
 * the step, times the square of the steepness, and by the square of that distance.
 */
#ifndef CAPSTAN_SRC_EVOLVE_WATER_H
#define CAPSTAN_SRC_EVOLVE_WATER_H

#include "evolve/points.h"

/* Find the surface of the step that begins, in time where the points have been predicted
 * (point_motion.h). */
void cpsi_water_find_surfaces(CpsEvolution *evolution);

/* [m] The height of a place above a surface; that place on it that is upright above or below x. */
static inline double cpsi_surface_height(const CpsiSurface *surface, Vec3 x) {
    return vec3_dot(surface->n, vec3_sub(x, surface->at));
}
Vec3 cpsi_surface_below(const CpsiSurface *surface, Vec3 x);

/* [N] The buoyancy of a point that is let go at its place. */
Vec3 cpsi_buoyancy_at(const CpsiPoint *point, const double gravity[3]);

/* A point in a trial; its displaced weight is 0 where it cannot leave the water. */
typedef struct CpsiWater {
    double displaced, extent, height; /* [N], [m] of the float, [m] above the surface */
    double buoyancy;                  /* [N] found */
    Vec3 n;
} CpsiWater;

/* A point at a place, without a buoyancy yet. */
CpsiWater cpsi_water_at(const CpsiPoint *point, const double gravity[3], Vec3 place);
/* [N] The least and the largest buoyancy; it is at the surface up to `touch` [m]. */
void cpsi_water_range(const CpsiWater *water, double touch, double range[2]);
/* [N/m] By how much it grows as the point sinks, per n n'. */
double cpsi_water_stiffness(const CpsiWater *water);
CpsPointWater cpsi_water_state(const CpsiWater *water, double touch);

/* [J] The energy of which B is the derivative, 0 out of the water. */
double cpsi_water_energy(double displaced, double extent, double height);

/* The z of a first guess, which is at the surface at rest where it is near to it. */
double cpsi_water_near(const CpsiPoints *points, int point, double z);
/* Where a step to x leads: none goes through the surface. */
Vec3 cpsi_water_stop(const CpsiWater *from, const CpsiSurface *surface, Vec3 x);

#endif
