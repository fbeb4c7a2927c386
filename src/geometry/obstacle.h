/* SPDX-License-Identifier: BSD-3-Clause */
/* Obstacles: distance, axes of contact, and motion along the surface.
 *
 * The normal n(x) of a surface at a point x is the normal at the foot of x, the nearest point of
 * the surface. On the surfaces here (plane, cylinder, sphere) this map and the geodesics have
 * closed forms. */
#ifndef CAPSTAN_SRC_GEOMETRY_OBSTACLE_H
#define CAPSTAN_SRC_GEOMETRY_OBSTACLE_H

#include "capstan/scene.h"
#include "geometry/plane.h"
#include "geometry/shift.h"

typedef struct CpsiObstacle {
    CpsObstacleKind kind;
    CpsiPlane frame;    /* plane: the surface. Cylinder: axis[2] is its axis. Sphere: axis[2] is its
                           axis of rotation */
    double radius;      /* [m] cylinder, sphere */
    double friction[2]; /* [-] along the first tangent of the contact and across it */
    CpsFrictionShape shape;
    bool has_set;   /* the friction forces are those of a set instead, which the line holds
                       (cable/line.h) */
    bool has_grain; /* the first tangent is that of `grain`, not of the line */
    Vec3 grain;
    bool moves; /* it may be shifted */
} CpsiObstacle;

CpsiObstacle cpsi_obstacle(const CpsObstacle *def);

/* Does the step problem change as nodes move on the obstacle: is its surface curved, or does its
 * friction depend on the line's direction? */
bool cpsi_obstacle_needs_local_axes(const CpsiObstacle *obstacle);

/* From the plane's point, the cylinder's axis or the sphere's centre to x, on a cylinder across the
 * axis. */
Vec3 cpsi_obstacle_spoke(const CpsiObstacle *obstacle, Vec3 x);
/* [m] Signed distance of x, positive on the free side. */
double cpsi_obstacle_gap(const CpsiObstacle *obstacle, Vec3 x);
/* [m] Greatest depth of the straight path between two points below the surface; negative: its
 * distance from the surface. */
double cpsi_obstacle_depth(const CpsiObstacle *obstacle, Vec3 from, Vec3 to);
/* Unit normal at the foot of x, towards the free side. */
Vec3 cpsi_obstacle_normal(const CpsiObstacle *obstacle, Vec3 x);

/* Axes of contact at x: rows first tangent, second tangent, normal. The first tangent is the
 * component of the grain, or of the vector `along`, in the tangent plane; curvature [1/m] of the
 * surface through x as xx, xy, yy in these axes. */
void cpsi_obstacle_axes(const CpsiObstacle *obstacle, Vec3 x, Vec3 along, double axes[9],
                        double curvature[3]);

/* The position of x after a displacement u: the tangential part of u along a geodesic of the
 * surface, then the normal part. */
Vec3 cpsi_obstacle_move(const CpsiObstacle *obstacle, Vec3 x, Vec3 u);

/* The geodesic from the foot of one point to that of another, as a tangent vector at the second
 * point: its length is that of the geodesic, its direction that of the geodesic there. It is the
 * shorter one; for opposite points, one of them. */
Vec3 cpsi_obstacle_slip(const CpsiObstacle *obstacle, Vec3 from, Vec3 to);

/* [rad] The angle between two normals of a round obstacle: about a cylinder's axis by the
 * right-hand rule, from -pi to pi; on a ball that of the great circle, from 0 to pi. 0 on a
 * plane. */
double cpsi_obstacle_angle(const CpsiObstacle *obstacle, Vec3 from, Vec3 to);

/* The point (1 - share) a + share b of the straight element from a to b that is nearest to the axis
 * of a cylinder or the centre of a sphere. False where that is one of its ends, and for a plane. */
bool cpsi_obstacle_faces(const CpsiObstacle *obstacle, Vec3 a, Vec3 b, double *share);

/* Is friction on the obstacle a disc, the same in all directions? */
bool cpsi_obstacle_is_isotropic(const CpsiObstacle *obstacle);

/* [m] How far an element of natural length l may cut into a round obstacle of radius R: delta =
 * min(l^2/(4 R), R/4). A chord between two points of the surface cuts in by l^2/(8 R) and more, but
 * by less than delta up to l = 1.3 R. */
double cpsi_obstacle_allowance(const CpsiObstacle *obstacle, double l);

/* x carried along as the obstacle is shifted to where it is now, and turns about its own axis. */
Vec3 cpsi_obstacle_carry(const CpsiObstacle *obstacle, Vec3 x, const CpsiShift *shift,
                         double angle);

/* Shift the obstacle; its grain goes with it. */
void cpsi_obstacle_shift(CpsiObstacle *obstacle, const CpsiShift *shift);

/* x carried along as the obstacle turns about its axis by `angle` [rad], right-hand rule. */
Vec3 cpsi_obstacle_turn(const CpsiObstacle *obstacle, Vec3 x, double angle);

#endif
