/* SPDX-License-Identifier: BSD-3-Clause */
/* Obstacles that move under points in time (moving_ground.h). */
#include "evolve/moving_ground.h"

#include <math.h>

#include "cable/obstacle_side.h"

/* Rounding of a quarter of a turn that a point has gone, by its places, which are known to the
 * tolerance of points. */
static const double GONE_ROUNDING = 1e-6;

static bool moves(const CpsEvolution *evolution, int k) {
    return evolution->angle[k] != 0 || !cpsi_shift_is_none(&evolution->shift[k]);
}

bool cpsi_ground_moves(const CpsEvolution *evolution) {
    for (int k = 0; k < evolution->obstacle_count; k++)
        if (moves(evolution, k)) return true;
    return false;
}

/* The share of the step for which the ground carries the reference of a point along. */
static double share_of(const CpsEvolution *evolution, const CpsiPoint *point) {
    return evolution->interval > 0 ? point->inertia.span / evolution->formula.length : 1;
}

/* How obstacle k is shifted in that share. */
static CpsiShift shift_of(const CpsEvolution *evolution, int k, double share) {
    return share < 1 ? cpsi_shift_part(&evolution->shift[k], 1 - share, 1) : evolution->shift[k];
}

/* Both places of the formula of the second order, taken along to the end of the step by ground that
 * turns: that of a point which goes with it is where it is, while x* lies outside of its circle. */
static Vec3 carry_both(const CpsEvolution *evolution, const CpsiPoint *point, int k) {
    const CpsiObstacle *on = &evolution->obstacle[k];
    const double longer = 1 + 1 / evolution->formula.ratio, angle = evolution->angle[k];
    const CpsiShift shift = evolution->shift[k], both = cpsi_shift_part(&shift, 1 - longer, 1);
    const Vec3 last = cpsi_obstacle_carry(on, vec3_load(point->before), &shift, angle),
               first =
                   cpsi_obstacle_carry(on, vec3_load(point->inertia.past), &both, longer * angle);
    return vec3_axpy(evolution->formula.back, vec3_sub(last, first), last);
}

static bool turns(const CpsEvolution *evolution, int k) {
    return evolution->angle[k] != 0 || !cpsi_vec3_is_zero(evolution->shift[k].turn);
}

Vec3 cpsi_ground_carry(const CpsEvolution *evolution, const CpsiPoint *point, int k) {
    const double share = share_of(evolution, point);
    if (share < 1 && turns(evolution, k)) return carry_both(evolution, point, k);
    const CpsiShift shift = shift_of(evolution, k, share);
    const double *from = evolution->interval > 0 ? point->inertia.reference : point->before;
    return cpsi_obstacle_carry(&evolution->obstacle[k], vec3_load(from), &shift,
                               share * evolution->angle[k]);
}

Vec3 cpsi_ground_way(const CpsEvolution *evolution, int k, Vec3 x) {
    if (k < 0 || !moves(evolution, k)) return vec3(0, 0, 0);
    const Vec3 before = cpsi_obstacle_turn(&evolution->obstacle[k], x, -evolution->angle[k]);
    return vec3_add(vec3_sub(x, before), cpsi_shift_to(&evolution->shift[k], before));
}

double cpsi_ground_rate(const CpsEvolution *evolution, const CpsiPoint *point) {
    const int k = point->report.obstacle;
    if (k < 0 || cpsi_shift_is_none(&evolution->shift[k])) return 0;
    const CpsiShift shift = shift_of(evolution, k, share_of(evolution, point));
    const Vec3 way = cpsi_shift_to(&shift, vec3_load(point->report.position));
    return vec3_dot(way, vec3_load(point->report.normal)) / point->inertia.span;
}

bool cpsi_ground_outruns(const CpsEvolution *evolution, const CpsiPoint *point, Vec3 start) {
    const double gone = CPSI_QUARTER * (1 + GONE_ROUNDING);
    if (!(evolution->interval > 0)) return false;
    const Vec3 x = vec3_load(point->report.position);
    for (int k = 0; k < evolution->obstacle_count; k++) {
        const CpsiShift *shift = &evolution->shift[k];
        if (cpsi_obstacle_turns_too_far(evolution->angle[k], shift) ||
            cpsi_obstacle_may_pass(&evolution->obstacle[k], shift, vec3_load(point->before), x, 0))
            return true;
    }
    if (point->report.obstacle == CPS_NO_OBSTACLE) return false;
    const CpsiObstacle *on = &evolution->obstacle[point->report.obstacle];
    const double angle =
        cpsi_obstacle_angle(on, cpsi_obstacle_normal(on, start), vec3_load(point->report.normal));
    return on->friction[0] > 0 && !(fabs(angle) <= gone);
}
