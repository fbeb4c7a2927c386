/* SPDX-License-Identifier: BSD-3-Clause */
/* The frame of a plane obstacle: a point and three axes, of which the third is the normal. */
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

#endif
