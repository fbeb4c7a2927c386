/* SPDX-License-Identifier: BSD-3-Clause */
/* A plane obstacle: gap, normal and a frame whose third axis is the normal. */
#ifndef CAPSTAN_SRC_GEOMETRY_PLANE_H
#define CAPSTAN_SRC_GEOMETRY_PLANE_H

#include "base/vec3.h"

typedef struct CpsiPlane {
    Vec3 point;
    Vec3 axis[3]; /* orthonormal, right-handed; axis[2] is the unit normal, towards the free side */
} CpsiPlane;

/* The plane through `point` with `normal` of any non-zero length. The tangent axes are as close to
 * x and y as they can be, so that a horizontal plane keeps x, y, z to the last bit. */
CpsiPlane cpsi_plane(const double point[3], const double normal[3]);

/* Signed distance of x from the plane [m], positive on the free side. */
static inline double cpsi_plane_gap(const CpsiPlane *plane, const double x[3]) {
    return vec3_dot(plane->axis[2], vec3_sub(vec3_load(x), plane->point));
}

/* Components of v along the axes, and back. */
static inline void cpsi_plane_to_frame(const CpsiPlane *plane, double out[3], const double v[3]) {
    const Vec3 a = vec3_load(v);
    for (int i = 0; i < 3; i++) out[i] = vec3_dot(plane->axis[i], a);
}

static inline void cpsi_plane_from_frame(const CpsiPlane *plane, double out[3], const double v[3]) {
    Vec3 sum = vec3_scale(v[0], plane->axis[0]);
    sum = vec3_axpy(v[1], plane->axis[1], sum);
    vec3_store(out, vec3_axpy(v[2], plane->axis[2], sum));
}

#endif
