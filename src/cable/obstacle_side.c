/* SPDX-License-Identifier: BSD-3-Clause */
/* How far a move may go without passing an obstacle (obstacle_side.h).
 *
 * Seen from the axis or the centre, with d the direction to the nearest point of an element, the
 * whole element lies beyond the plane across d through that point. As its ends go straight it stays
 * beyond the plane across d at the distance allowed, and so as far away, up to the first time that
 * an end meets this plane. There d is taken anew. An element that only passes by meets no plane,
 * one that comes straight in meets the first where it may go no farther, and every time so found is
 * safe. */
#include "cable/obstacle_side.h"

/* Of the smaller of radius and distance before. */
static const double NEAREST = 0.5;
/* Nearer to what is allowed than by this share the move ends. */
static const double CLOSE = 1e-3;
/* Planes that are tried before the move ends where it has come. */
enum { PLANES = 100 };

/* The point of the straight piece from a to b that is nearest to the origin. */
static Vec3 nearest(Vec3 a, Vec3 b) {
    const Vec3 along = vec3_sub(b, a);
    const double passed = -vec3_dot(a, along), whole = vec3_dot(along, along);
    return passed <= 0 ? a : passed >= whole ? b : vec3_axpy(passed / whole, along, a);
}

/* Share of the move from now until an end at `arm` that goes by `way` meets the plane across d at
 * distance `least`. */
static double until(Vec3 d, Vec3 arm, Vec3 way, double least) {
    const double in = -vec3_dot(d, way);
    return in > 0 ? (vec3_dot(d, arm) - least) / in : INFINITY;
}

/* The share for one element with its ends at a and b, which go by u and v; all as seen from the
 * axis or centre. */
static double share_of(double radius, Vec3 a, Vec3 b, Vec3 u, Vec3 v, double most) {
    const double least = NEAREST * fmin(radius, vec3_norm(nearest(a, b)));
    double share = 0;
    if (least > 0)
        for (int i = 0; i < PLANES && share < most; i++) {
            const Vec3 a_now = vec3_axpy(share, u, a), b_now = vec3_axpy(share, v, b),
                       point = nearest(a_now, b_now);
            const double distance = vec3_norm(point);
            if (!(distance > (1 + CLOSE) * least)) return share;
            const Vec3 d = vec3_scale(1 / distance, point);
            share += fmin(until(d, a_now, u, least), until(d, b_now, v, least));
            if (share >= most) return most;
        }
    return least > 0 ? share : most;
}

double cpsi_obstacle_side_share(const CpsiLine *line, const double *from, const double *to,
                                double most) {
    double share = most;
    for (int k = 0; k < line->obstacle_count; k++) {
        const CpsiObstacle *obstacle = &line->obstacle[k];
        if (obstacle->kind == CPS_OBSTACLE_PLANE) continue;
        Vec3 a = cpsi_obstacle_spoke(obstacle, vec3_load(from)),
             u = vec3_sub(cpsi_obstacle_spoke(obstacle, vec3_load(to)), a);
        for (int j = 1; j < line->n; j++) {
            const Vec3 b = cpsi_obstacle_spoke(obstacle, vec3_load(&from[3 * j]));
            const Vec3 v = vec3_sub(cpsi_obstacle_spoke(obstacle, vec3_load(&to[3 * j])), b);
            share = share_of(obstacle->radius, a, b, u, v, share);
            a = b;
            u = v;
        }
    }
    return share;
}
