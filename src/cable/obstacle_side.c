/* SPDX-License-Identifier: BSD-3-Clause */
/* The admissible share of a move that must not pass an obstacle (obstacle_side.h).
 *
 * Let d be the direction from the axis or the centre to the nearest point of an element. The whole
 * element lies beyond the plane normal to d through that point. As its ends move straight, it stays
 * beyond the parallel plane at the least admissible distance, and so at least as far away, until an
 * end reaches this plane. There d is computed anew. An element that only passes by reaches no
 * plane; one that moves straight inwards reaches the first plane where it must stop; every share
 * found in this way is safe. */
#include "cable/obstacle_side.h"

/* Least admissible distance, relative to the smaller of the radius and the former distance. */
static const double NEAREST = 0.5;
/* The move ends within this relative distance of the least admissible one. */
static const double CLOSE = 1e-3;
/* Rounding of a quarter of a turn and of that part of a radius as they are asked for. */
static const double ROUNDING = 1e-9;
/* Planes computed at most; then the move ends at the share reached. */
enum { PLANES = 100 };

/* The point of the straight segment from a to b that is nearest to the origin. */
static Vec3 nearest(Vec3 a, Vec3 b) {
    const Vec3 along = vec3_sub(b, a);
    const double passed = -vec3_dot(a, along), whole = vec3_dot(along, along);
    return passed <= 0 ? a : passed >= whole ? b : vec3_axpy(passed / whole, along, a);
}

/* Further share of the move at which an end at `arm`, which moves by `move`, reaches the plane
 * normal to d at distance `least`. */
static double share_until_plane(Vec3 d, Vec3 arm, Vec3 move, double least) {
    const double in = -vec3_dot(d, move);
    return in > 0 ? (vec3_dot(d, arm) - least) / in : INFINITY;
}

/* The admissible share for one element with its ends at a and b, which move by u and v, all
 * relative to the axis or centre. */
static double safe_share(double radius, Vec3 a, Vec3 b, Vec3 u, Vec3 v, double most) {
    const double least = NEAREST * fmin(radius, vec3_norm(nearest(a, b)));
    double share = 0;
    if (least > 0)
        for (int i = 0; i < PLANES && share < most; i++) {
            const Vec3 a_now = vec3_axpy(share, u, a), b_now = vec3_axpy(share, v, b),
                       point = nearest(a_now, b_now);
            const double distance = vec3_norm(point);
            if (!(distance > (1 + CLOSE) * least)) return share;
            const Vec3 d = vec3_scale(1 / distance, point);
            share +=
                fmin(share_until_plane(d, a_now, u, least), share_until_plane(d, b_now, v, least));
            if (share >= most) return most;
        }
    return least > 0 ? share : most;
}

/* Is the element with its ends at a and b as near to the axis or centre as it must not be, after
 * this share of the move? */
static bool is_passing(double radius, Vec3 a, Vec3 b, Vec3 u, Vec3 v, double share) {
    const double least = NEAREST * fmin(radius, vec3_norm(nearest(a, b)));
    const Vec3 point = nearest(vec3_axpy(share, u, a), vec3_axpy(share, v, b));
    return vec3_norm(point) <= (1 + 2 * CLOSE) * least;
}

/* Has the obstacle sides? What gives may be gone through. */
static bool has_sides(const CpsiObstacle *obstacle) {
    return cpsi_obstacle_is_round(obstacle) && !(obstacle->stiffness > 0);
}

double cpsi_obstacle_side_share(const CpsiLine *line, const double *from, const double *to,
                                double most) {
    double share = most;
    for (int k = 0; k < line->obstacle_count; k++) {
        const CpsiObstacle *obstacle = &line->obstacle[k];
        if (!has_sides(obstacle)) continue;
        Vec3 a = cpsi_obstacle_spoke(obstacle, vec3_load(from)),
             u = vec3_sub(cpsi_obstacle_spoke(obstacle, vec3_load(to)), a);
        for (int j = 1; j < line->n; j++) {
            const Vec3 b = cpsi_obstacle_spoke(obstacle, vec3_at(from, j));
            const Vec3 v = vec3_sub(cpsi_obstacle_spoke(obstacle, vec3_at(to, j)), b);
            share = safe_share(obstacle->radius, a, b, u, v, share);
            a = b;
            u = v;
        }
    }
    return share;
}

int cpsi_obstacle_passed(const CpsiLine *line, const double *from, const double *to) {
    const double share = cpsi_obstacle_side_share(line, from, to, 1);
    if (!(share < 1)) return CPS_NO_OBSTACLE;
    for (int k = 0; k < line->obstacle_count; k++) {
        const CpsiObstacle *obstacle = &line->obstacle[k];
        if (!has_sides(obstacle)) continue;
        for (int j = 1; j < line->n; j++) {
            const Vec3 a = cpsi_obstacle_spoke(obstacle, vec3_at(from, j - 1)),
                       b = cpsi_obstacle_spoke(obstacle, vec3_at(from, j));
            const Vec3 u = vec3_sub(cpsi_obstacle_spoke(obstacle, vec3_at(to, j - 1)), a),
                       v = vec3_sub(cpsi_obstacle_spoke(obstacle, vec3_at(to, j)), b);
            if (is_passing(obstacle->radius, a, b, u, v, share)) return k;
        }
    }
    return CPS_NO_OBSTACLE;
}

bool cpsi_obstacle_turns_too_far(double angle, const CpsiShift *shift) {
    const double turn = fabs(angle) + (shift ? vec3_norm(shift->turn) : 0);
    return turn > CPSI_QUARTER * (1 + ROUNDING);
}

bool cpsi_obstacle_may_pass(const CpsiObstacle *obstacle, const CpsiShift *shift, Vec3 from, Vec3 x,
                            double reach) {
    if (obstacle->kind == CPS_OBSTACLE_PLANE || cpsi_shift_is_none(shift)) return false;
    const double most = CPSI_MOST_SHIFT * obstacle->radius * (1 + ROUNDING),
                 size = vec3_norm(cpsi_shift_to(shift, x)), way = vec3_norm(vec3_sub(x, from)),
                 apart = vec3_norm(vec3_sub(x, cpsi_shift_carry(shift, from)));
    return size > most && apart > most && cpsi_obstacle_gap(obstacle, x) <= size + way + reach;
}
