/* SPDX-License-Identifier: BSD-3-Clause */
/* Several feet of a place on one obstacle: beside the concave edges of a mesh, its folds.
 *
 * A place that touches both faces beside a fold touches as if these were two obstacles. An obstacle
 * that has folds may be asked as seen from one of its faces: with CpsiObstacle.face set, the foot
 * of a place in obstacle.h is the one that is reached from that face without crossing a fold. */
#ifndef CAPSTAN_SRC_GEOMETRY_FOLDS_H
#define CAPSTAN_SRC_GEOMETRY_FOLDS_H

#include "geometry/shape.h"

/* No face: the nearest foot. */
enum { CPSI_NO_FACE = -1, CPSI_MOST_FEET = 6 };

typedef struct CpsiFoot {
    int face;    /* triangle of the mesh that it is on */
    bool beyond; /* it is on the plane of that triangle, beyond a fold */
    double gap;  /* [m] as cpsi_obstacle_gap */
    Vec3 normal; /* of length 1, towards the free side */
} CpsiFoot;

/* Is it a rigid mesh with folds? On one that gives a place has its nearest foot alone. */
bool cpsi_obstacle_has_folds(const CpsiObstacle *obstacle);

/* The feet of x on an obstacle with folds, the nearest first: that one, and others whose gap is
 * less than a part of the radius; returns their number, 1 to CPSI_MOST_FEET. Behind a fold they are
 * those on the planes of the faces there. */
int cpsi_obstacle_feet(const CpsiObstacle *obstacle, Vec3 x, CpsiFoot out[CPSI_MOST_FEET]);

/* The face of the foot of x whose normal is nearest to n. */
int cpsi_obstacle_face_towards(const CpsiObstacle *obstacle, Vec3 x, Vec3 n);

/* The foot of x that is reached from the face of the obstacle. */
CpsiFoot cpsi_obstacle_foot(const CpsiObstacle *obstacle, Vec3 x);

/* The normal where the way of cpsi_obstacle_slip from one point to another begins: that at the foot
 * of `from`; if the surface folds between the two, the normal at the end, for then the way is
 * straight in its plane. */
Vec3 cpsi_obstacle_first_normal(const CpsiObstacle *obstacle, Vec3 from, Vec3 to);

#endif
