/* SPDX-License-Identifier: BSD-3-Clause */
/* An obstacle, and what the kinds of obstacles do differently: the functions of obstacle.h that
 * each shape has of its own. All of them see the obstacle where it is now; a shape with a place of
 * its own subtracts frame.point first. */
#ifndef CAPSTAN_SRC_GEOMETRY_SHAPE_H
#define CAPSTAN_SRC_GEOMETRY_SHAPE_H

#include "capstan/scene.h"
#include "geometry/plane.h"

typedef struct CpsiObstacle {
    CpsObstacleKind kind;
    CpsiPlane frame; /* plane: the surface. Cylinder .. cone: axis[2] is its axis. Sphere: axis[2]
                        is its axis of rotation. Box, mesh: its own axes */
    double radius;   /* [m] as in scene.h; ground, surface: the step in which paths are examined */
    CpsShape form;   /* what shapes have beside a radius */
    const CpsGround *ground; /* of a ground, else NULL */
    CpsSurface surface;      /* of a surface given as a function */
    const CpsMesh *mesh;     /* of a mesh, else NULL */
    int face;                /* of a mesh with folds: see folds.h; CPSI_NO_FACE */
    double stiffness;        /* [N/m3] by which it gives; 0: it is rigid */
    double damping;          /* [N s/m3] of what gives */
    double friction[2];      /* [-] along the first tangent of the contact and across it */
    CpsFrictionShape shape;
    bool has_set;   /* the friction forces are those of a set instead, which the line holds
                       (cable/line.h) */
    bool has_grain; /* the first tangent is that of `grain`, not of the line */
    Vec3 grain;
    bool moves; /* it may be shifted */
} CpsiObstacle;

typedef struct CpsiShapeTable {
    double (*gap)(const CpsiObstacle *o, Vec3 x);
    double (*depth)(const CpsiObstacle *o, Vec3 from, Vec3 to);
    Vec3 (*normal)(const CpsiObstacle *o, Vec3 x);
    /* [1/m] xx, xy, yy of the surface through x along the tangents t and b */
    void (*curvature)(const CpsiObstacle *o, Vec3 x, Vec3 t, Vec3 b, double out[3]);
    Vec3 (*move)(const CpsiObstacle *o, Vec3 x, Vec3 u);
    Vec3 (*slip)(const CpsiObstacle *o, Vec3 from, Vec3 to);
    double (*angle)(const CpsiObstacle *o, Vec3 from, Vec3 to);
    double (*range)(const CpsiObstacle *o, Vec3 x);
} CpsiShapeTable;

extern const CpsiShapeTable cpsi_shape_plane, cpsi_shape_cylinder, cpsi_shape_sphere,
    cpsi_shape_smooth, cpsi_shape_rounded, cpsi_shape_mesh;

/* Where the straight element from a to b is nearest to a body of cpsi_shape_rounded, or farthest
 * out of one that it is inside of, as a share of its way; false where that is one of its ends. */
bool cpsi_rounded_faces(const CpsiObstacle *obstacle, Vec3 a, Vec3 b, double *share);

/* From the plane's point, the cylinder's axis or the sphere's centre to x, on a cylinder across the
 * axis. */
Vec3 cpsi_obstacle_spoke(const CpsiObstacle *obstacle, Vec3 x);

#endif
