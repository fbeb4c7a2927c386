/* SPDX-License-Identifier: BSD-3-Clause */
/* Slopes of planes with friction (slopes.h). */
#include "cable/slopes.h"

#include <math.h>

/* A direction leaves a plane by this much more steeply than friction on it asks, which is more than
 * rounding. */
static const double STEEPER = 1e-9;

/* The radius of a disc that contains all friction forces per unit normal force, over the larger
 * coefficient. */
static double disc_factor(const CpsiObstacle *o) {
    const double most = fmax(o->friction[0], o->friction[1]);
    return o->shape == CPS_FRICTION_SHAPE_BOX && most > 0
               ? hypot(o->friction[0], o->friction[1]) / most
               : 1;
}

double cpsi_largest_friction_factor(const CpsiLine *line) {
    double factor = line->friction_factor ? 0 : 1;
    if (line->friction_factor)
        for (int j = 0; j < line->n; j++) factor = fmax(factor, line->friction_factor[j]);
    return factor;
}

bool cpsi_slopes_fill(const CpsiLine *line, double factor, bool frozen, CpsiSlopes *slopes) {
    slopes->count = 0;
    if (line->obstacle_count > CPSI_MOST_SLOPES) return false;
    for (int k = 0; k < line->obstacle_count; k++) {
        const CpsiObstacle *o = &line->obstacle[k];
        if (o->kind != CPS_OBSTACLE_PLANE || o->has_set) return false;
        const double mu = factor * disc_factor(o) * fmax(o->friction[0], o->friction[1]);
        slopes->slope[k] =
            (CpsiSlope){.n = o->frame.axis[2], .rise = frozen ? 0 : mu / hypot(1, mu)};
    }
    slopes->count = line->obstacle_count;
    return true;
}

void cpsi_slopes_add_bounds(const CpsiLine *line, CpsiSlopes *slopes) {
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        const int k = line->obstacle_index ? line->obstacle_index[c] : 0;
        if (k != CPS_NO_OBSTACLE && k < slopes->count)
            slopes->slope[k].bound += disc_factor(&line->obstacle[k]) * line->friction_bound[c];
    }
}

static void consider(const CpsiSlopes *slopes, Vec3 along, CpsiFall *fall) {
    const Vec3 v = vec3_scale(1 / vec3_norm(along), along);
    double power = vec3_dot(fall->sum, v);
    for (int k = 0; k < slopes->count; k++) {
        const CpsiSlope *slope = &slopes->slope[k];
        const double rise = vec3_dot(slope->n, v);
        if (!(rise >= slope->rise)) return;
        power -= slope->bound * vec3_norm(vec3_axpy(-rise, slope->n, v));
    }
    if (!(power > fall->power)) return;
    fall->v = v;
    fall->power = power;
}

/* ... that leaves one plane as steeply as its friction asks, */
static void consider_one(const CpsiSlopes *slopes, int k, CpsiFall *fall) {
    const double rise = slopes->slope[k].rise + STEEPER;
    const Vec3 n = slopes->slope[k].n, t = vec3_axpy(-vec3_dot(fall->sum, n), n, fall->sum);
    const Vec3 up = vec3_scale(rise * vec3_norm(t), n);
    consider(slopes, vec3_axpy(sqrt(fmax(0, 1 - rise * rise)), t, up), fall);
}

/* ... and two, to either side of the corner between them. */
static void consider_two(const CpsiSlopes *slopes, int k, int m, CpsiFall *fall) {
    const Vec3 a = slopes->slope[k].n, b = slopes->slope[m].n, corner = vec3_cross(a, b);
    const double p = slopes->slope[k].rise + STEEPER, q = slopes->slope[m].rise + STEEPER,
                 cosine = vec3_dot(a, b), square = vec3_dot(corner, corner);
    const Vec3 up =
        vec3_axpy((p - cosine * q) / square, a, vec3_scale((q - cosine * p) / square, b));
    const double along = sqrt((1 - vec3_dot(up, up)) / square);
    consider(slopes, vec3_axpy(along, corner, up), fall);
    consider(slopes, vec3_axpy(-along, corner, up), fall);
}

void cpsi_slopes_fall(const CpsiSlopes *slopes, CpsiFall *fall) {
    fall->power = 0;
    consider(slopes, fall->sum, fall);
    for (int k = 0; k < slopes->count; k++) {
        consider_one(slopes, k, fall);
        for (int m = 0; m < k; m++) consider_two(slopes, k, m, fall);
    }
}
