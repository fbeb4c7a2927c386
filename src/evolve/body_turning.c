/* SPDX-License-Identifier: BSD-3-Clause */
/* Moments that no rotation balances (body_turning.h).
 *
 * About the eye the lines have no moment. The loads balance there, about the free axes, in a
 * rotation Q with
 *
 *     M = m(Q),      m(Q) = (Q s) x F + (Q d) x g,
 *
 * s the eye, d = m_W (s - c_W) - m_B (s - c_B) of weight and lift. For a vector v
 *
 *     v.m(Q) = tr(Q' N(v)) <= t(N(v)),      N(v) = (F x v) s' + (g x v) d',
 *
 * t the largest such trace of any rotation (linalg/farthest_rotation.h). So f(v) = v.M - t(N(v)) >
 * 0 proves that no rotation balances M. f is concave, with the slope M - m(Q) of the Q that attains
 * t; its largest value among |v| <= 1 is found by the ellipsoid method, which bounds it from both
 * sides. */
#include "evolve/body_turning.h"

#include <math.h>

#include "cable/existence.h"
#include "linalg/farthest_rotation.h"

/* The ellipsoid method in 3 dimensions: the centre moves by a quarter of the half width, and each
 * half of an ellipsoid lies in one of (9/8) (P - b b'/2). Its volume falls by 0.84, so that
 * iterations are left over at the least moment that is looked for. */
enum { N = 3, ITERATIONS = 1000 };
static const double SHIFT = 1.0 / 4, GROWN = 9.0 / 8, TAKEN = 1.0 / 2;
/* The moment is found to this share. */
static const double SHARE = 0.01;

/* f(v) and its slope. */
static double moment_about(const CpsiTurning *of, Vec3 v, Vec3 *slope) {
    double n[3][3] = {{0}}, q[4];
    vec3_add_outer(n, 1, vec3_cross(of->force, v), of->eye);
    vec3_add_outer(n, 1, vec3_cross(of->gravity, v), of->weight_by);
    const double most = cpsi_farthest_rotation(n, q);
    const Rotation turn = rotation_load(q);
    *slope = vec3_sub(of->moment, vec3_cross(rotation_apply(turn, of->eye), of->force));
    *slope = vec3_sub(*slope, vec3_cross(rotation_apply(turn, of->weight_by), of->gravity));
    return vec3_dot(v, of->moment) - most;
}

static Vec3 along_free(const CpsiTurning *of, Vec3 v) {
    return vec3(of->about[0] ? v.x : 0, of->about[1] ? v.y : 0, of->about[2] ? v.z : 0);
}

/* P h; returns the half width of the ellipsoid along h times |h|. */
static double half_width(double p[N][N], Vec3 h, Vec3 *out) {
    *out = vec3(vec3_dot(vec3_load(p[0]), h), vec3_dot(vec3_load(p[1]), h),
                vec3_dot(vec3_load(p[2]), h));
    return sqrt(fmax(0, vec3_dot(*out, h)));
}

/* The best axis so far. */
typedef struct Best {
    Vec3 axis;
    double moment;
} Best;

/* f(v) and its slope; v of any length. */
static double examine(const CpsiTurning *of, Vec3 v, Best *best, Vec3 *slope) {
    const double here = moment_about(of, v, slope), size = vec3_norm(v);
    if (here > best->moment * size) *best = (Best){vec3_scale(1 / size, v), here / size};
    return here;
}

bool cpsi_turns_for_ever(const CpsiTurning *of, Vec3 *axis, double *moment) {
    const double least = CPSI_LEAST_POWER * of->sizes;
    Vec3 v = along_free(of, of->gravity), slope, by;
    double p[N][N] = {{of->about[0], 0, 0}, {0, of->about[1], 0}, {0, 0, of->about[2]}};
    Best best = {.moment = 0};
    (void)examine(of, v, &best, &slope);
    (void)examine(of, vec3_scale(-1, v), &best, &slope);
    v = vec3(0, 0, 0);
    for (int i = 0; i < ITERATIONS; i++) {
        Vec3 towards = vec3_scale(-1, v);
        if (vec3_dot(v, v) <= 1) {
            const double here = examine(of, v, &best, &slope);
            towards = along_free(of, slope);
            const double most = here + half_width(p, towards, &by);
            if (!(most > fmax(least, (1 + SHARE) * best.moment))) break;
        }
        const double width = half_width(p, towards, &by);
        if (!(width > 0)) break;
        by = vec3_scale(1 / width, by);
        v = vec3_axpy(SHIFT, by, v);
        vec3_add_outer(p, -TAKEN, by, by);
        for (int k = 0; k < N * N; k++) p[k / N][k % N] *= GROWN;
    }
    *axis = best.axis;
    *moment = best.moment;
    return best.moment > least;
}
