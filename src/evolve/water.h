/* SPDX-License-Identifier: BSD-3-Clause */
/* The surface of still water, at which free points float (points.h). The buoyancy B of a point at
 * the height h above it is
 *
 *     B = D where h < 0,   0 <= B <= D where h = 0,   B = 0 where h > 0,
 *
 * D the weight of the water that it displaces: minus the derivative of the convex energy
 * D max(0, h) - D h. In the search for its place (newton_step.h) it is a contact of bounded force.
 */
#ifndef CAPSTAN_SRC_EVOLVE_WATER_H
#define CAPSTAN_SRC_EVOLVE_WATER_H

#include "evolve/points.h"

/* Gravity in a scene with a surface; `what` names the stage that it belongs to, or is "gravity". */
CpsStatus cpsi_water_check(const CpsScene *scene, const double gravity[3], const char *what,
                           CpsError *err);

/* [N] The buoyancy of a point that is let go at its place. */
double cpsi_buoyancy_at(const CpsiPoints *points, const CpsiPoint *point, const double gravity[3]);

/* A point in a trial; its displaced weight is 0 where it cannot leave the water. */
typedef struct CpsiWater {
    double displaced, height; /* [N], [m] above the surface */
    double buoyancy;          /* [N] found */
} CpsiWater;

/* A point at z [m], without a buoyancy yet. */
CpsiWater cpsi_water_at(const CpsiPoints *points, int point, const double gravity[3], double z);
/* [N] The least and the largest buoyancy; it is at the surface up to `touch` [m]. */
void cpsi_water_range(const CpsiWater *water, double touch, double range[2]);
CpsPointWater cpsi_water_state(const CpsiWater *water, double touch);

/* The z of a first guess, which is at the surface where it is near to it. */
double cpsi_water_near(const CpsiPoints *points, int point, double z);
/* The z to which a step leads: none goes through the surface. */
double cpsi_water_stop(const CpsiWater *from, double surface, double z);

#endif
