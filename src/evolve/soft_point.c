/* SPDX-License-Identifier: BSD-3-Clause */
/* Free points on obstacles that give (soft_point.h). */
#include "evolve/soft_point.h"

#include <math.h>

#include "geometry/obstacle.h"

/* How many obstacles that give there are, or that a place lies in. */
static int count_soft(const CpsEvolution *evolution, const Vec3 *place) {
    int count = 0;
    for (int k = 0; k < evolution->obstacle_count; k++) {
        const CpsiObstacle *on = &evolution->obstacle[k];
        if (on->stiffness > 0 && (!place || cpsi_obstacle_gap(on, *place) < 0)) count++;
    }
    return count;
}

bool cpsi_soft_point_is_between(const CpsEvolution *evolution, Vec3 place) {
    return count_soft(evolution, &place) > 1;
}

void cpsi_soft_point_areas(CpsEvolution *evolution) {
    CpsiPoints *points = &evolution->points;
    if (count_soft(evolution, NULL) == 0) return;
    for (int i = 0; i < points->count; i++) points->point[i].area = points->given[i].bearing_area;
    for (int k = 0; k < 2 * evolution->line_count; k++) {
        const CpsiLine *line = &evolution->line[k / 2];
        if (points->tie[k] != CPSI_NO_POINT)
            points->point[points->tie[k]].area +=
                line->bearing_width * cpsi_line_share(line, cpsi_line_end_node(line, k % 2));
    }
}

double cpsi_soft_point_stiffness(const CpsEvolution *evolution, int index, int on) {
    return on == CPS_NO_OBSTACLE
               ? 0
               : evolution->obstacle[on].stiffness * evolution->points.point[index].area;
}

CpsiSoft cpsi_soft_point_spring(const CpsEvolution *evolution, int index, int on, Vec3 from) {
    const CpsiObstacle *obstacle = &evolution->obstacle[on];
    const double own = cpsi_soft_point_stiffness(evolution, index, on);
    if (!(obstacle->damping > 0) || !(evolution->interval > 0)) return (CpsiSoft){own, 0};
    return cpsi_soft_damp(obstacle, own, evolution->points.point[index].inertia.span,
                          cpsi_soft_depth(obstacle, from));
}

/* Where the point was when the step began, on obstacle k as it is now. */
static Vec3 place_before(const CpsEvolution *evolution, int index, int k) {
    return cpsi_shift_carry(&evolution->shift[k], vec3_load(evolution->points.point[index].before));
}

/* Is it borne by obstacles? */
static bool may_bear(const CpsiPoint *point) {
    return point->kind == CPS_POINT_KIND_FREE && !point->on.is_there;
}

bool cpsi_soft_point_is_crossed(const CpsEvolution *evolution, int index, Vec3 place) {
    bool crossed = false;
    if (!may_bear(&evolution->points.point[index])) return false;
    for (int k = 0; k < evolution->obstacle_count; k++)
        crossed = crossed || cpsi_soft_crosses(&evolution->obstacle[k],
                                               place_before(evolution, index, k), place);
    return crossed;
}

/* The obstacle in which a place lies deepest, and how deep [m]; CPS_NO_OBSTACLE: it lies in none,
 * then 0. `before`: before the obstacles took the motion of the step. */
static int deepest(const CpsEvolution *evolution, Vec3 place, bool before, double *depth) {
    int found = CPS_NO_OBSTACLE;
    *depth = 0;
    for (int k = 0; k < evolution->obstacle_count; k++) {
        const Vec3 x = before ? cpsi_shift_carry(&evolution->shift[k], place) : place;
        const double gap = cpsi_obstacle_gap(&evolution->obstacle[k], x);
        if (!(-gap > *depth)) continue;
        *depth = -gap;
        found = k;
    }
    return found;
}

Vec3 cpsi_soft_point_push(const CpsEvolution *evolution, int index) {
    double depth;
    const Vec3 place = vec3_load(evolution->points.point[index].position);
    const int on = deepest(evolution, place, false, &depth);
    if (on == CPS_NO_OBSTACLE) return vec3(0, 0, 0);
    return vec3_scale(cpsi_soft_point_stiffness(evolution, index, on) * depth,
                      cpsi_obstacle_normal(&evolution->obstacle[on], place));
}

/* [J] Stored under a point at a place. */
static double stored_at(const CpsEvolution *evolution, int index, Vec3 place, bool before) {
    double depth;
    const int on = deepest(evolution, place, before, &depth);
    return 0.5 * cpsi_soft_point_stiffness(evolution, index, on) * depth * depth;
}

double cpsi_soft_point_growth(const CpsEvolution *evolution, int index, Vec3 place) {
    const CpsiPoint *point = &evolution->points.point[index];
    if (!may_bear(point)) return 0;
    return stored_at(evolution, index, place, false) -
           stored_at(evolution, index, vec3_load(point->before), true);
}

double cpsi_soft_point_damped(const CpsEvolution *evolution, int index, Vec3 place,
                              double reaction) {
    const CpsiPoint *point = &evolution->points.point[index];
    double now;
    const int on = deepest(evolution, place, false, &now);
    if (!may_bear(point) || on == CPS_NO_OBSTACLE || !(evolution->obstacle[on].damping > 0))
        return 0;
    const double was =
        cpsi_soft_depth(&evolution->obstacle[on], place_before(evolution, index, on));
    return (reaction - cpsi_soft_point_stiffness(evolution, index, on) * now) * (now - was);
}
