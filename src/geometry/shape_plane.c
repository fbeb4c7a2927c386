/* SPDX-License-Identifier: BSD-3-Clause */
/* A plane: one normal, straight ways (shape.h). */
#include <math.h>

#include "geometry/shape.h"

static double gap(const CpsiObstacle *o, Vec3 x) {
    return vec3_dot(vec3_sub(x, o->frame.point), o->frame.axis[2]);
}

static double depth(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    return -fmin(gap(o, from), gap(o, to));
}

static Vec3 normal(const CpsiObstacle *o, Vec3 x) {
    (void)x;
    return o->frame.axis[2];
}

static void curvature(const CpsiObstacle *o, Vec3 x, Vec3 t, Vec3 b, double out[3]) {
    (void)o;
    (void)x;
    (void)t;
    (void)b;
    out[0] = out[1] = out[2] = 0;
}

static Vec3 move(const CpsiObstacle *o, Vec3 x, Vec3 u) {
    (void)o;
    return vec3_add(x, u);
}

static Vec3 slip(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    return vec3_reject(vec3_sub(to, from), o->frame.axis[2]);
}

static double angle(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    (void)o;
    (void)from;
    (void)to;
    return 0;
}

static double range(const CpsiObstacle *o, Vec3 x) {
    (void)o;
    (void)x;
    return INFINITY;
}

const CpsiShapeTable cpsi_shape_plane = {gap, depth, normal, curvature, move, slip, angle, range};
