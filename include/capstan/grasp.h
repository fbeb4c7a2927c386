/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/grasp.h: nodes between the ends of a line that something holds, or pulls: a gripper, a
 * hook, a load that is hung on and taken off. A stage or a move (scene.h, evolve.h) grasps a node
 * where it is, moves it, and lets it go, as it does with ends. While a node is held, both parts of
 * the line go on from it, with a tension each; the holder bears the difference, the weight of the
 * node, and what an obstacle under it did before: a held node is on no obstacle.
 *
 *     CpsGraspChange grip = {.line = 0, .node = 40, .kind = CPS_END_KIND_HELD, .value = {x, y, z}};
 *     CpsStage move = cps_stage_default();
 *     move.grasp_change_count = 1;
 *     move.grasp_change = &grip;
 *
 * These are plain structs like those of scene.h. */
#ifndef CAPSTAN_GRASP_H
#define CAPSTAN_GRASP_H

#include <stdbool.h>

#include "capstan/base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Nodes of one line that are held or pulled at a time. */
enum { CPS_MAX_GRASPS = 8 };

typedef enum CpsEndKind {
    CPS_END_KIND_HELD, /* `value` is the imposed position [m] (S90 (8), remark 2.3.4) */
    CPS_END_KIND_FREE, /* `value` is the force applied to the end [N] (S90 (9)) */
    /* held where the start of the line places it, which must not be static; `value` is not read.
     * For lines only, not for changes */
    CPS_END_KIND_AT_START,
    CPS_END_KIND_POINT,   /* at a point of the scene (`end_point` of the line); `value` is not read.
                             For lines only, not for changes */
    CPS_END_KIND_RELEASED /* let go at once, without a force, also from its point (failure.h);
                             `value` is not read. For changes only, not for lines */
} CpsEndKind;

typedef struct CpsEnd {
    CpsEndKind kind;
    double value[3];
} CpsEnd;

/* What a stage changes at a node, reached in equal increments over the stage: its position, or the
 * force on it. A node that gets a position is held where it is and moved from there. One that is
 * held and gets a force is let go, from the force that holds it; on one that is not held the force
 * begins with that on it, or 0. A node on which there is no force is let go for good. */
typedef struct CpsGraspChange {
    int line;        /* index in the scene */
    int node;        /* 1 .. element_count - 1 */
    CpsEndKind kind; /* held or free */
    double value[3]; /* [m] or [N] */
    bool stays;      /* held where it is: `value` is not read; default false */
    bool at_once;    /* the force has its value from the beginning of the stage; default false */
} CpsGraspChange;

/* A node that is held or pulled, in a view (step.h). */
typedef struct CpsGrasp {
    int node;
    CpsEnd imposed;  /* in this step: position, from the origin of the view, or force */
    double force[3]; /* [N] on the line at this node: of what holds it, or the given one */
} CpsGrasp;

#ifdef __cplusplus
}
#endif
#endif
