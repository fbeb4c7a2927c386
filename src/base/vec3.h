/* SPDX-License-Identifier: BSD-3-Clause */
/* Three-dimensional vectors by value, for geometry outside the hot loops. */
#ifndef CAPSTAN_SRC_BASE_VEC3_H
#define CAPSTAN_SRC_BASE_VEC3_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

typedef struct Vec3 {
    double x, y, z;
} Vec3;

static inline Vec3 vec3(double x, double y, double z) { return (Vec3){x, y, z}; }
static inline Vec3 vec3_load(const double a[3]) { return (Vec3){a[0], a[1], a[2]}; }
/* Vector j of an array (.., 3). */
static inline Vec3 vec3_at(const double *a, int j) { return vec3_load(a + 3 * (ptrdiff_t)j); }
static inline void vec3_store(double out[3], Vec3 a) {
    out[0] = a.x;
    out[1] = a.y;
    out[2] = a.z;
}
static inline Vec3 vec3_add(Vec3 a, Vec3 b) { return (Vec3){a.x + b.x, a.y + b.y, a.z + b.z}; }
static inline Vec3 vec3_sub(Vec3 a, Vec3 b) { return (Vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static inline Vec3 vec3_scale(double k, Vec3 a) { return (Vec3){k * a.x, k * a.y, k * a.z}; }
static inline Vec3 vec3_axpy(double k, Vec3 a, Vec3 b) {
    return (Vec3){k * a.x + b.x, k * a.y + b.y, k * a.z + b.z};
}
static inline double vec3_dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline Vec3 vec3_cross(Vec3 a, Vec3 b) {
    return (Vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/* The part of v normal to the unit vector n. */
static inline Vec3 vec3_reject(Vec3 v, Vec3 n) { return vec3_axpy(-vec3_dot(v, n), n, v); }
static inline double vec3_norm(Vec3 a) { return sqrt(vec3_dot(a, a)); }
/* |a||b| - a.b >= 0 without cancellation, for vectors whose lengths are known. */
static inline double vec3_angle_defect(Vec3 a, Vec3 b, double size_a, double size_b) {
    const double size = size_a * size_b, dot = vec3_dot(a, b);
    if (!(dot > 0)) return size - dot;
    const Vec3 cross = vec3_cross(a, b);
    return vec3_dot(cross, cross) / (size + dot);
}
/* m += by a b' */
static inline void vec3_add_outer(double m[3][3], double by, Vec3 a, Vec3 b) {
    const double left[3] = {a.x, a.y, a.z}, right[3] = {b.x, b.y, b.z};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) m[i][j] += by * left[i] * right[j];
}
/* m += by 1 */
static inline void vec3_add_identity(double m[3][3], double by) {
    for (int i = 0; i < 3; i++) m[i][i] += by;
}
static inline bool vec3_finite(const double a[3]) {
    return isfinite(a[0]) && isfinite(a[1]) && isfinite(a[2]);
}

#endif
