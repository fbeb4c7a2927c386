/* SPDX-License-Identifier: BSD-3-Clause */
/* Capsules, tori, cones, boxes and insides (rig_shape.h): the nearest point of a core as a
 * parameter of it, and the way (1g) by the stretches of the core, from two equations. */
#include "rig_shape.h"

#include <math.h>
#include <string.h>

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(double *out, const double *a, const double *b) {
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static double between(double x, double low, double high) { return fmax(low, fmin(high, x)); }

bool rig_is_shape(const CpsObstacle *o) {
    return o->shape.inside || o->kind >= CPS_OBSTACLE_CAPSULE;
}

/* The box' own axes: the rows of the rotation matrix of its quaternion, transposed. */
static void box_axes(const CpsObstacle *o, double axis[3][3]) {
    const double *q = o->shape.rotation, n = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) { /* R = 1 + (2/n) (w [v] + [v]^2), column i */
            const double v[3] = {q[1], q[2], q[3]};
            double skew = 0, square = v[i] * v[k];
            if (k == (i + 1) % 3) skew = v[(i + 2) % 3];
            if (k == (i + 2) % 3) skew = -v[(i + 1) % 3];
            if (i == k) square -= dot(v, v);
            axis[i][k] = (i == k) + 2 * (q[0] * skew + square) / n;
        }
}

/* c - point and |x - c|, negative within the core, and the direction out of it. */
static double core_of(const CpsObstacle *o, const double *x, double *core, double *out) {
    double arm[3], axis[3], flat[3], size = sqrt(dot(o->axis, o->axis)), distance = 0;
    for (int k = 0; k < 3; k++) {
        arm[k] = x[k] - o->point[k];
        axis[k] = o->axis[k] / size;
        core[k] = 0;
    }
    if (o->kind == CPS_OBSTACLE_BOX) {
        double own[3][3];
        box_axes(o, own);
        for (int i = 0; i < 3; i++) {
            const double most = o->shape.size[i] / 2 - o->radius,
                         at = between(dot(arm, own[i]), -most, most);
            for (int k = 0; k < 3; k++) core[k] += at * own[i][k];
        }
    }
    const double along = dot(arm, axis);
    for (int k = 0; k < 3; k++) flat[k] = arm[k] - along * axis[k];
    const double across = sqrt(dot(flat, flat)), half = o->shape.length / 2;
    double radial = 0, axial = 0;
    if (o->kind == CPS_OBSTACLE_CYLINDER) axial = along;
    if (o->kind == CPS_OBSTACLE_CAPSULE) axial = between(along, -half, half);
    if (o->kind == CPS_OBSTACLE_TORUS) radial = o->shape.main_radius;
    if (o->kind == CPS_OBSTACLE_CONE) {
        const double s = sin(o->shape.angle), c = cos(o->shape.angle),
                     on = fmax(0, s * across + c * (along - o->radius));
        radial = on * s;
        axial = o->radius + on * c;
    }
    if (o->kind != CPS_OBSTACLE_BOX)
        for (int k = 0; k < 3; k++)
            core[k] = axial * axis[k] + (across > 0 ? radial * flat[k] / across : 0);
    for (int k = 0; k < 3; k++) out[k] = arm[k] - core[k];
    distance = sqrt(dot(out, out));
    for (int k = 0; k < 3; k++) out[k] = distance > 0 ? out[k] / distance : 0;
    return distance;
}

double rig_shape_distance(const CpsObstacle *o, const double *x, double *normal, double *core) {
    double c[3];
    const double sign = o->shape.inside ? -1 : 1, distance = core_of(o, x, c, normal);
    for (int k = 0; k < 3; k++) normal[k] *= sign;
    if (core) memcpy(core, c, sizeof c);
    return sign * (distance - o->radius);
}

void rig_shape_path(const CpsObstacle *o, const double *from, const double *to, double *out) {
    double c0[3], c1[3], e0[3], e1[3], way[3], pole[3], t0[3], t1[3];
    core_of(o, from, c0, e0);
    core_of(o, to, c1, e1);
    for (int k = 0; k < 3; k++) way[k] = c1[k] - c0[k];
    cross(pole, e0, e1);
    const double sine = sqrt(dot(pole, pole)), turn = atan2(sine, dot(e0, e1));
    if (sine < 1e-7) { /* e goes along its chord */
        for (int k = 0; k < 3; k++) way[k] += o->radius * (e1[k] - e0[k]);
        for (int k = 0; k < 3; k++) out[k] = way[k] - dot(way, e1) * e1[k];
        return;
    }
    for (int k = 0; k < 3; k++) pole[k] /= sine;
    cross(t0, pole, e0);
    cross(t1, pole, e1);
    /* the stretches a along t0 and b along t1: way.e1 = a t0.e1, way.e0 = b t1.e0 */
    const double a = dot(way, e1) / dot(t0, e1), b = dot(way, e0) / dot(t1, e0);
    for (int k = 0; k < 3; k++)
        out[k] = (a + b + o->radius * turn) * t1[k] + dot(way, pole) * pole[k];
    if (turn > 1e-3) return;
    /* of a small turn these are differences of rounding: the tangent halfway instead */
    double halfway[3], middle[3];
    for (int k = 0; k < 3; k++) middle[k] = e0[k] + e1[k];
    cross(halfway, pole, middle);
    const double stretch =
        dot(way, halfway) / sqrt(dot(halfway, halfway)) / cos(turn / 2) + o->radius * turn;
    for (int k = 0; k < 3; k++) out[k] = stretch * t1[k] + dot(way, pole) * pole[k];
}
