/* SPDX-License-Identifier: BSD-3-Clause */
/* Rotations as unit quaternions w, x, y, z. */
#ifndef CAPSTAN_SRC_BASE_ROTATION_H
#define CAPSTAN_SRC_BASE_ROTATION_H

#include "base/vec3.h"

typedef struct Rotation {
    double w, x, y, z;
} Rotation;

/* Of a quaternion of any length but 0. */
static inline Rotation rotation_load(const double q[4]) {
    double size = 0;
    for (int i = 0; i < 4; i++) size = fmax(size, fabs(q[i]));
    const double w = q[0] / size, x = q[1] / size, y = q[2] / size, z = q[3] / size,
                 by = 1 / sqrt(w * w + x * x + y * y + z * z);
    return (Rotation){by * w, by * x, by * y, by * z};
}
static inline void rotation_store(double q[4], Rotation r) {
    q[0] = r.w;
    q[1] = r.x;
    q[2] = r.y;
    q[3] = r.z;
}
static inline Vec3 rotation_vector_part(Rotation r) { return vec3(r.x, r.y, r.z); }

static inline Vec3 rotation_apply(Rotation r, Vec3 v) {
    const Vec3 u = rotation_vector_part(r), t = vec3_scale(2, vec3_cross(u, v));
    return vec3_add(vec3_axpy(r.w, t, v), vec3_cross(u, t));
}

/* First b, then a. */
static inline Rotation rotation_after(Rotation a, Rotation b) {
    const Vec3 u = rotation_vector_part(a), v = rotation_vector_part(b),
               s = vec3_add(vec3_axpy(a.w, v, vec3_scale(b.w, u)), vec3_cross(u, v));
    const double q[4] = {a.w * b.w - vec3_dot(u, v), s.x, s.y, s.z};
    return rotation_load(q);
}
static inline Rotation rotation_inverse(Rotation r) { return (Rotation){r.w, -r.x, -r.y, -r.z}; }

/* By the angle |v| about v, and back: the vector of an angle up to pi. */
static inline Rotation rotation_of(Vec3 v) {
    const double angle = vec3_norm(v), half = 0.5 * angle,
                 by = angle > 1e-8 ? sin(half) / angle : 0.5;
    const double q[4] = {cos(half), by * v.x, by * v.y, by * v.z};
    return rotation_load(q);
}
static inline Vec3 rotation_vector(Rotation r) {
    const Vec3 u = r.w < 0 ? vec3_scale(-1, rotation_vector_part(r)) : rotation_vector_part(r);
    const double sine = vec3_norm(u), angle = 2 * atan2(sine, fabs(r.w));
    return vec3_scale(sine > 1e-12 ? angle / sine : 2, u);
}

#endif
