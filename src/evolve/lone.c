/* SPDX-License-Identifier: BSD-3-Clause */
/* Free points at which no line ends any more (lone.h): the forces on such a point do not change on
 * its way, and it has no energy but their work. */
#include "evolve/lone.h"

#include <math.h>

#include "evolve/points.h"

/* Steps along a ray, each of the distance to the nearest obstacle; the ray ends after so many
 * lengths of the point's longest line. */
enum { MARCHES = 400 };
static const double FARTHEST = 1e6;

/* [m] Along the unit vector d to the surface of the water; INFINITY: not on this way. */
static double to_surface(const CpsiBalance *balance, const CpsiFree *at, Vec3 d, double touch) {
    const CpsiPoints *points = &balance->evolution->points;
    const double height = at->place.z - points->surface;
    if (!points->has_surface || !(at->water.displaced > 0) || fabs(height) <= touch ||
        !(height * d.z < 0))
        return INFINITY;
    return -height / d.z;
}

/* [m] ... and to the first obstacle. */
static double to_obstacle(const CpsiBalance *balance, Vec3 from, Vec3 d, double touch,
                          double farthest) {
    double t = 0;
    for (int i = 0; i < MARCHES && t < farthest; i++) {
        double gap;
        Vec3 normal = vec3(0, 0, 0);
        const int on =
            cpsi_trial_nearest(balance->evolution, vec3_axpy(t, d, from), false, &gap, &normal);
        if (on == CPS_NO_OBSTACLE) break;
        if (gap <= touch && !(vec3_dot(normal, d) > 0)) return t;
        t += fmax(gap, touch);
    }
    return INFINITY;
}

CpsOutcome cpsi_lone_point(CpsiBalance *balance) {
    CpsiFree *at = &balance->at[0];
    cpsi_try_places(balance);
    if (cpsi_is_answer(balance)) return CPS_OUTCOME_SOLVED;
    /* what gives pushes less and less on the way: nothing but it may hold the point */
    const Vec3 drives = at->gives ? at->rest : at->left;
    const double touch = cpsi_trial_touch(balance, at), left = vec3_norm(drives);
    const Vec3 from = at->place, d = vec3_scale(1 / left, drives);
    const double farthest = FARTHEST * balance->evolution->points.point[at->point].length,
                 surface = to_surface(balance, at, d, touch),
                 obstacle = to_obstacle(balance, from, d, touch, farthest);
    if (!(left > 0) || (isinf(surface) && isinf(obstacle))) return CPS_OUTCOME_UNBOUNDED;
    at->place = vec3_axpy(fmin(surface, obstacle), d, from);
    if (surface < obstacle) at->place.z = balance->evolution->points.surface;
    cpsi_try_places(balance);
    return cpsi_is_answer(balance) ? CPS_OUTCOME_SOLVED : CPS_OUTCOME_STALLED;
}
