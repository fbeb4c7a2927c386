/* SPDX-License-Identifier: BSD-3-Clause */
/* The surface of the water (water.h). */
#include "evolve/water.h"

#include <math.h>

#include "base/status.h"
#include "evolve/ranges.h"
#include "evolve/state.h"

/* A step that ends this near to the surface, per its way there, ends at it: rounding. */
static const double NEAR = 1e-9;
/* Water that falls nearly as freely as this leaves of gravity holds nothing up; no wave that does
 * not break does, but a sum of many may. */
static const double STEEPEST = 0.1;
/* A first guess is no better than this, per length of the point's longest line. */
static const double GUESSED = 1e-6;

/* [N] D under this gravity. */
static double displaced(const CpsiPoint *point, const double gravity[3]) {
    return point->displaced_mass > 0 ? point->displaced_mass * vec3_norm(vec3_load(gravity)) : 0;
}

/* That of the waves at the end of a step in time; as the waves grow, both the height of the surface
 * and the acceleration are a share of theirs. */
static CpsiSurface surface_in_waves(const CpsEvolution *evolution, const CpsiPoint *point) {
    const CpsiPointInertia *inertia = &point->inertia;
    const Vec3 x =
        vec3_axpy(inertia->span, vec3_load(inertia->rest_velocity), vec3_load(inertia->reference));
    const double g = vec3_norm(vec3_load(evolution->gravity)),
                 share = cpsi_waves_share(&evolution->waves);
    CpsiWaves grown = evolution->waves;
    grown.ramp = 0;
    double lift = 0;
    const CpsiWaterMotion water = cpsi_waves_at(&grown, x, &lift);
    Vec3 n = vec3_axpy(share / g, water.acceleration, vec3(0, 0, 1));
    n.z = fmax(n.z, STEEPEST);
    return (CpsiSurface){vec3(x.x, x.y, evolution->points.surface + share * lift), n};
}

void cpsi_water_find_surfaces(CpsEvolution *evolution) {
    const bool waves = evolution->interval > 0 && evolution->waves.count > 0;
    for (int i = 0; i < evolution->points.count; i++) {
        CpsiPoint *point = &evolution->points.point[i];
        point->surface = waves && point->displaced_mass > 0
                             ? surface_in_waves(evolution, point)
                             : cpsi_surface_at_rest(&evolution->points);
    }
}

Vec3 cpsi_surface_below(const CpsiSurface *surface, Vec3 x) {
    const Vec3 n = surface->n, off = vec3_sub(x, surface->at);
    return vec3(x.x, x.y, surface->at.z - (n.x * off.x + n.y * off.y) / n.z);
}

Vec3 cpsi_buoyancy_at(const CpsiPoint *point, const double gravity[3]) {
    CpsiWater water = cpsi_water_at(point, gravity, vec3_load(point->position));
    double range[2];
    cpsi_water_range(&water, 0, range);
    return vec3_scale(range[1], water.n);
}

CpsiWater cpsi_water_at(const CpsiPoint *point, const double gravity[3], Vec3 place) {
    return (CpsiWater){.displaced = displaced(point, gravity),
                       .extent = point->extent,
                       .height = cpsi_surface_height(&point->surface, place),
                       .n = point->surface.n};
}

void cpsi_water_range(const CpsiWater *water, double touch, double range[2]) {
    if (water->extent > 0) {
        const double share = fmin(fmax(0.5 - water->height / water->extent, 0), 1);
        range[0] = range[1] = share * water->displaced;
        return;
    }
    range[0] = water->height < -touch ? water->displaced : 0;
    range[1] = water->height > touch ? 0 : water->displaced;
}

double cpsi_water_stiffness(const CpsiWater *water) {
    return water->displaced > 0 && 2 * fabs(water->height) <= water->extent && water->extent > 0
               ? water->displaced / water->extent
               : 0;
}

CpsPointWater cpsi_water_state(const CpsiWater *water, double touch) {
    const double reach = 0.5 * water->extent + touch;
    return !(water->displaced > 0)  ? CPS_POINT_WATER_NONE
           : water->height < -reach ? CPS_POINT_WATER_SUBMERGED
           : water->height > reach  ? CPS_POINT_WATER_ABOVE
                                    : CPS_POINT_WATER_FLOATING;
}

double cpsi_water_energy(double displaced, double extent, double height) {
    const double wet = 0.5 * extent - height; /* of the float, if it is no more than all of it */
    if (!(wet > 0)) return 0;
    return wet >= extent ? -displaced * height : displaced * wet * (wet / (2 * extent));
}

double cpsi_water_near(const CpsiPoints *points, int point, double z) {
    const CpsiPoint *of = &points->point[point];
    const bool is_near =
        of->displaced_mass > 0 && fabs(z - points->surface) <= GUESSED * of->length;
    return is_near ? points->surface : z;
}

Vec3 cpsi_water_stop(const CpsiWater *from, const CpsiSurface *surface, Vec3 x) {
    const double height = cpsi_surface_height(surface, x), reach = 0.5 * from->extent;
    const bool through = from->height * height < 0 && fabs(height) > reach &&
                         (fabs(from->height) > reach || !(reach > 0));
    const bool near = !(reach > 0) && fabs(height) <= NEAR * fabs(from->height);
    return through || near ? cpsi_surface_below(surface, x) : x;
}
