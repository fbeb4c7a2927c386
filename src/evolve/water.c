/* SPDX-License-Identifier: BSD-3-Clause */
/* The surface of still water (water.h). */
#include "evolve/water.h"

#include <math.h>

#include "base/status.h"

/* A step that ends this near to the surface, per its way there, ends at it: rounding. */
static const double NEAR = 1e-9;
/* A first guess is no better than this, per length of the point's longest line. */
static const double GUESSED = 1e-6;

CpsStatus cpsi_water_check(const CpsScene *scene, const double gravity[3], const char *what,
                           CpsError *err) {
    if (!scene->has_water_surface) return CPS_OK;
    if (gravity[0] == 0 && gravity[1] == 0 && gravity[2] <= 0) return CPS_OK;
    return CPSI_FAIL_AT("gravity", err, CPS_ERR_ARGUMENT,
                        "%s: (%g, %g, %g) m/s2 in a scene with a water surface, which is a plane "
                        "z = constant: expected (0, 0, -g)",
                        what, gravity[0], gravity[1], gravity[2]);
}

/* [N] D under this gravity. */
static double displaced(const CpsiPoint *point, const double gravity[3]) {
    return point->displaced_mass > 0 ? point->displaced_mass * vec3_norm(vec3_load(gravity)) : 0;
}

double cpsi_buoyancy_at(const CpsiPoints *points, const CpsiPoint *point, const double gravity[3]) {
    return point->position[2] <= points->surface ? displaced(point, gravity) : 0;
}

CpsiWater cpsi_water_at(const CpsiPoints *points, int point, const double gravity[3], double z) {
    return (CpsiWater){.displaced = displaced(&points->point[point], gravity),
                       .height = z - points->surface};
}

void cpsi_water_range(const CpsiWater *water, double touch, double range[2]) {
    range[0] = water->height < -touch ? water->displaced : 0;
    range[1] = water->height > touch ? 0 : water->displaced;
}

CpsPointWater cpsi_water_state(const CpsiWater *water, double touch) {
    return !(water->displaced > 0)  ? CPS_POINT_WATER_NONE
           : water->height < -touch ? CPS_POINT_WATER_SUBMERGED
           : water->height > touch  ? CPS_POINT_WATER_ABOVE
                                    : CPS_POINT_WATER_FLOATING;
}

double cpsi_water_near(const CpsiPoints *points, int point, double z) {
    const CpsiPoint *of = &points->point[point];
    const bool is_near =
        of->displaced_mass > 0 && fabs(z - points->surface) <= GUESSED * of->length;
    return is_near ? points->surface : z;
}

double cpsi_water_stop(const CpsiWater *from, double surface, double z) {
    const double height = z - surface;
    const bool passes = from->height * height < 0 || fabs(height) <= NEAR * fabs(from->height);
    return passes ? surface : z;
}
