/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/shape.h: obstacles of several shapes, and lines that are inside of them.
 *
 * Capsule, torus, cone and box (scene.h) are what lies within a distance, the `radius` of the
 * obstacle, of a simple body: of a straight line, a circle, a sharp cone, a box. So they have no
 * sharp edge, and one normal everywhere. Their place is the `point` of the obstacle, their
 * direction its `axis`; a box has a rotation instead.
 *
 *     CpsObstacle quay = cps_obstacle_default();
 *     quay.kind = CPS_OBSTACLE_BOX;
 *     quay.radius = 0.1;
 *     quay.shape.size[0] = 10, quay.shape.size[1] = 40, quay.shape.size[2] = 6;
 *
 * These are plain structs like those of scene.h. */
#ifndef CAPSTAN_SHAPE_H
#define CAPSTAN_SHAPE_H

#include <stdbool.h>

#include "capstan/base.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct CpsShape {
    /* of a cylinder, sphere, capsule, torus, cone or box: lines are inside of it, as in the bore of
     * a pipe or in a bowl, and not outside; default false */
    bool inside;
    double length;      /* [m] capsule: between the centres of its two round ends, >= 0 */
    double main_radius; /* [m] torus: of the circle that its tube follows, > radius */
    double angle;       /* [rad] cone: between its axis and its side, > 0 and < pi/2 */
    double size[3];     /* [m] box: from face to face along its own axes, each > 2 radius */
    /* box: turns its own axes, which begin as those of the scene: a quaternion as of a body, of any
     * length but 0; default 1 0 0 0 */
    double rotation[4];
} CpsShape;

#ifdef __cplusplus
}
#endif
#endif
