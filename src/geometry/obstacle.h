/* SPDX-License-Identifier: BSD-3-Clause */
/* Obstacles: distance, axes of contact, and motion along the surface.
 *
 * The normal n(x) of a surface at a point x is the normal at the foot of x, the nearest point of
 * the surface. On plane, cylinder and sphere this map and the geodesics have closed forms; on the
 * other shapes the map has, and ways hold to second order in their length (shape_rounded.c). On
 * ground and surfaces given as functions all of this holds to first order in the height above the
 * surface, and ways to second order in their length (shape_smooth.c). */
#ifndef CAPSTAN_SRC_GEOMETRY_OBSTACLE_H
#define CAPSTAN_SRC_GEOMETRY_OBSTACLE_H

#include "geometry/shape.h"
#include "geometry/shift.h"

CpsiObstacle cpsi_obstacle(const CpsObstacle *def);

/* Does the step problem change as nodes move on the obstacle: is its surface curved, does it give,
 * or does its friction depend on the line's direction? */
bool cpsi_obstacle_needs_local_axes(const CpsiObstacle *obstacle);

/* Has an obstacle of this kind an axis of rotation? */
static inline bool cpsi_obstacle_kind_has_axis(CpsObstacleKind kind) {
    return kind == CPS_OBSTACLE_CYLINDER || kind == CPS_OBSTACLE_SPHERE ||
           kind == CPS_OBSTACLE_CAPSULE || kind == CPS_OBSTACLE_TORUS || kind == CPS_OBSTACLE_CONE;
}
/* Has it a radius, and what else CpsShape says? */
static inline bool cpsi_obstacle_kind_has_radius(CpsObstacleKind kind) {
    return cpsi_obstacle_kind_has_axis(kind) || kind == CPS_OBSTACLE_BOX;
}

/* Is it a cylinder or a sphere with the lines outside, with an axis or a centre that they may
 * pass? */
bool cpsi_obstacle_is_round(const CpsiObstacle *obstacle);
/* Is it a capsule, torus, cone or box, or a shape with the lines inside (shape_rounded.c)? */
bool cpsi_obstacle_is_rounded(const CpsiObstacle *obstacle);
/* May a straight element between two points of its free side cut into it, so that
 * cpsi_obstacle_faces is of use? */
bool cpsi_obstacle_faces_lines(const CpsiObstacle *obstacle);
/* Do elements touch it at their nodes only, so that the contact of one may be the third of a node?
 */
static inline bool cpsi_obstacle_may_be_third(const CpsiObstacle *obstacle) {
    return obstacle->kind == CPS_OBSTACLE_PLANE || obstacle->kind == CPS_OBSTACLE_MESH;
}
/* Is what lies inside it convex? */
bool cpsi_obstacle_is_convex(const CpsiObstacle *obstacle);
/* Is there an obstacle below or above x? Not beyond the edge of a grid that is not extended, but
 * for `rounding` [m]. */
bool cpsi_obstacle_covers(const CpsiObstacle *obstacle, Vec3 x, double rounding);
/* [-] By which friction at x is multiplied. */
double cpsi_obstacle_friction_factor(const CpsiObstacle *obstacle, Vec3 x);

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

/* [rad] The angle between two normals: of a round obstacle about a cylinder's axis by the
 * right-hand rule, from -pi to pi; else that of the great circle, from 0 to pi. 0 on a plane. */
double cpsi_obstacle_angle(const CpsiObstacle *obstacle, Vec3 from, Vec3 to);

/* [m] The range of the tangent plane at x: the radius of curvature of the surface through it. */
double cpsi_obstacle_range(const CpsiObstacle *obstacle, Vec3 x);

/* The point (1 - share) a + share b of the straight element from a to b that is nearest to the axis
 * of a cylinder or the centre of a sphere, or that has the least gap to another shape. False where
 * that is one of its ends, and of planes, ground, surfaces and what gives, into which elements go
 * as their nodes do. */
bool cpsi_obstacle_faces(const CpsiObstacle *obstacle, Vec3 a, Vec3 b, double *share);

/* Is friction on the obstacle a disc, the same in all directions? */
bool cpsi_obstacle_is_isotropic(const CpsiObstacle *obstacle);

/* The obstacle whose surface is parallel to this one, deeper by `depth`. */
CpsiObstacle cpsi_obstacle_within(const CpsiObstacle *obstacle, double depth);

/* [m] How far an element of natural length l may cut into an obstacle whose smallest convex radius
 * of curvature is R: delta = min(l^2/(4 R), R/4). A chord between two points of the surface cuts in
 * by l^2/(8 R) and more, but by less than delta up to l = 1.3 R. */
double cpsi_obstacle_allowance(const CpsiObstacle *obstacle, double l);

/* x carried along as the obstacle is shifted to where it is now, and turns about its own axis. */
Vec3 cpsi_obstacle_carry(const CpsiObstacle *obstacle, Vec3 x, const CpsiShift *shift,
                         double angle);

/* Shift the obstacle; its grain goes with it. */
void cpsi_obstacle_shift(CpsiObstacle *obstacle, const CpsiShift *shift);

/* x carried along as the obstacle turns about its axis by `angle` [rad], right-hand rule. */
Vec3 cpsi_obstacle_turn(const CpsiObstacle *obstacle, Vec3 x, double angle);

#endif
