/* SPDX-License-Identifier: BSD-3-Clause */
/* Shapes of obstacles: from the values of a scene file to the scene's structs (see
 * scene_build.h). */
#include "base/math.h"
#include "io/read/scene/scene_build.h"

/* In the order of the keys of an obstacle; surfaces are no part of files. */
static const CpsObstacleKind KIND[] = {CPS_OBSTACLE_PLANE,   CPS_OBSTACLE_CYLINDER,
                                       CPS_OBSTACLE_SPHERE,  CPS_OBSTACLE_GROUND,
                                       CPS_OBSTACLE_CAPSULE, CPS_OBSTACLE_TORUS,
                                       CPS_OBSTACLE_CONE,    CPS_OBSTACLE_BOX};

void cpsi_shape_build(const CpsiObstacleValues *values, CpsObstacle *obstacle) {
    obstacle->kind = KIND[values->obstacle.kind];
    obstacle->shape.angle = values->cone_angle * CPSI_DEGREE;
    if (values->rotation.node) cpsi_rotation_build(&values->rotation, obstacle->shape.rotation);
}
