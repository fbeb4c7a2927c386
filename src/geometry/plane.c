/* SPDX-License-Identifier: BSD-3-Clause */
/* The frame of a plane obstacle (plane.h). */
#include "geometry/plane.h"

CpsiPlane cpsi_plane(const double point[3], const double normal[3]) {
    /* scale by the largest component first: the square of a tiny or huge normal would underflow or
     * overflow */
    const Vec3 raw = vec3_load(normal);
    const double largest = fmax(fabs(raw.x), fmax(fabs(raw.y), fabs(raw.z)));
    const Vec3 scaled = vec3_scale(1 / largest, raw);
    const Vec3 n = vec3_scale(1 / vec3_norm(scaled), scaled);
    /* x, or y where the normal is nearly along x, made orthogonal to the normal */
    const Vec3 seed = fabs(n.x) <= 0.75 ? vec3(1, 0, 0) : vec3(0, 1, 0);
    const Vec3 along = vec3_reject(seed, n);
    const Vec3 t = vec3_scale(1 / vec3_norm(along), along);
    return (CpsiPlane){.point = vec3_load(point), .axis = {t, vec3_cross(n, t), n}};
}
