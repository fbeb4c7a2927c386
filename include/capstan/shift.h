/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/shift.h: obstacles that move: a bollard that is moved, a table that tilts, a belt. A
 * stage or a move (scene.h, evolve.h) shifts them from where they are.
 *
 *     CpsShift lift = {.obstacle = 0, .by = {0, 0, 0.5}};
 *     CpsStage move = cps_stage_default();
 *     move.shift_count = 1;
 *     move.shift = &lift;
 *
 * These are plain structs like those of scene.h. */
#ifndef CAPSTAN_SHIFT_H
#define CAPSTAN_SHIFT_H

#include "capstan/base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A rigid motion of an obstacle that `moves`: it turns about a point, which is translated
 * meanwhile. At share s of the stage what was at x is at
 *
 *     about + s by + R(s turn) (x - about),
 *
 * R(v) the rotation by the angle |v| about v, right-hand rule. What sticks to the obstacle moves
 * with it, and what it meets is pushed. It needs Coulomb's law and contact that is reached. Held
 * ends and nodes must not be in its way. A CpsTurn of the same stage is about the obstacle's own
 * axis, wherever that is. */
typedef struct CpsShift {
    int obstacle;    /* index in the scene */
    double by[3];    /* [m] in this stage */
    double turn[3];  /* [rad] default 0 0 0; in this stage, at most 10 000 turns */
    double about[3]; /* [m] default 0 0 0; where the point is as the stage begins */
} CpsShift;

/* Where an obstacle is now, and how it moved in the last step. */
typedef struct CpsObstacleReport {
    double point[3]; /* [m] its point, see CpsObstacle */
    double axis[3];  /* [-] of length 1: the normal of a plane, the axis of a cylinder .. cone, the
                        third axis of a box */
    double side[3];  /* [-] of length 1: the first axis of a box, else one across `axis` */
    double grain[3]; /* [-] as the scene gives it, turned by shifts */
    /* [m], [rad], [m] the shift of the last step, see CpsShift; `about` where it turns, else 0 */
    double by[3], turn[3], about[3];
    double turned; /* [rad] by which it turned about its own axis in the last step */
} CpsObstacleReport;

struct CpsEvolution;

/* cps_evolution_obstacle_report (evolve.h) with places relative to the origin of the views
 * (CpsLineView), from which they lose no digits far from 0. */
CPS_API CpsObstacleReport cps_evolution_obstacle_view(const struct CpsEvolution *evolution,
                                                      int obstacle);

#ifdef __cplusplus
}
#endif
#endif
