/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/scene.h: lines, obstacles and loads, and the history of what is done to them.
 *
 * Plain value structs, filled by the user, copied by the library. Start from cps_scene_default(),
 * cps_line_default(), ... : a struct made otherwise lacks its cookie and is refused. */
#ifndef CAPSTAN_SCENE_H
#define CAPSTAN_SCENE_H

#include "capstan/set.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum CpsObstacleKind {
    CPS_OBSTACLE_PLANE,    /* a plane: the side `normal` points to is free */
    CPS_OBSTACLE_CYLINDER, /* a solid cylinder without ends: a bollard, a pipe, a drum */
    CPS_OBSTACLE_SPHERE    /* a solid ball */
} CpsObstacleKind;

/* How two coefficients make a set of friction forces (M77 section 4: the force is normal to the
 * set's boundary against the sliding). */
typedef enum CpsFrictionShape {
    CPS_FRICTION_SHAPE_ELLIPSE, /* (F1/mu1)^2 + (F2/mu2)^2 <= R^2; the disc of Coulomb's law where
                             mu1 = mu2 */
    CPS_FRICTION_SHAPE_BOX      /* |F1| <= mu1 R and |F2| <= mu2 R: two independent laws */
} CpsFrictionShape;

/* An obstacle. Lines stay on its free side and have friction on it. */
typedef struct CpsObstacle {
    uint32_t cookie;
    const char *name;
    CpsObstacleKind kind; /* default plane */
    double point[3];  /* [m] a point of the plane or of the cylinder's axis, the sphere's centre;
                         default 0 0 0 */
    double normal[3]; /* [-] plane: any non-zero length, default 0 0 1 */
    double axis[3];   /* [-] of the cylinder, and of the turn of cylinder and sphere; any non-zero
                         length, default 0 1 0 */
    double radius;    /* [m] cylinder, sphere: > 0 */
    double friction;  /* [-] coefficient mu >= 0, default 0; where two directions differ, that along
                         the first one */
    bool has_friction_lateral; /* default false: in all directions as along the first */
    double friction_lateral;   /* [-] >= 0, with the flag: coefficient across the first direction */
    CpsFrictionShape friction_shape; /* default ellipse */
    /* default NULL; else any planar set of set.h, bounded and with 0 in it, of the friction forces
     * on the line per unit normal force, along the first and second tangent: in place of the
     * coefficients. The second tangent is normal x first. It need not be symmetric (a ratchet); the
     * evolution keeps what it needs of it. In the line's own axes it turns with the line; `grain`
     * fixes it in space */
    const CpsSet *friction_set;
    double grain[3]; /* [-] the first direction, its part in the tangent plane, fixed in space;
                        default 0 0 0: along the line */
} CpsObstacle;

typedef enum CpsEndKind {
    CPS_END_KIND_HELD,    /* `value` is the imposed position [m]         (S90 (8), remark 2.3.4) */
    CPS_END_KIND_FREE,    /* `value` is the force applied to the end [N] (S90 (9)) */
    CPS_END_KIND_AT_START /* held where the start puts it, which must not be a static start; `value`
                             is not read. Of lines alone, not of changes */
} CpsEndKind;

typedef struct CpsEnd {
    CpsEndKind kind;
    double value[3];
} CpsEnd;

enum { CPS_END_A = 0, CPS_END_B = 1 };

typedef enum CpsStartKind {
    CPS_START_STRAIGHT, /* from point[0] to point[1] */
    CPS_START_POLYLINE, /* along point[0..point_count-1] */
    CPS_START_ARC,      /* from point[0], around centre point[1], turning about axis */
    CPS_START_STATIC,   /* by statics: the frictionless equilibrium under the ends given */
    CPS_START_NODES /* any configuration: node i at point[i], with the forces of the reference if
                       they are known */
} CpsStartKind;

/* The first reference configuration. Nodes follow the shape by natural length, an elastic line
 * being stretched evenly over a shape longer than itself; a shape shorter than the line is refused
 * (use static).
 *
 * Given nodes are any x_R of S90, also one that is slack: no element at more than twice its length,
 * or beyond it where the line is inextensible. With them go T_R and either R_R or A_R; of the
 * arrays that are NULL the first step knows what the places tell. */
typedef struct CpsStart {
    CpsStartKind kind;
    int point_count;     /* straight, arc: 2; polyline: >= 2; static: 0; nodes: element_count + 1 */
    const double *point; /* (point_count, 3) [m] */
    double axis[3];      /* [-] arc: axis of the turn, right-hand rule, default 0 0 1 */
    const double *tension; /* nodes: (element_count) [N] T_R >= 0; NULL: K (|x'| - 1)^+, and 0 of an
                              inextensible line */
    /* nodes: (element_count + 1) [N] R_R >= 0 of the obstacle that the node touches; NULL: S90
     * section 2 d 2, -((T_R t)' + w).n where that is positive, with the force on a free end */
    const double *reaction;
    /* nodes: (element_count + 1) [N] A_R >= 0 in place of `reaction`, R_R = A_R/mu with the node's
     * own coefficient; with frozen friction it is the bound of the first step */
    const double *friction_bound;
} CpsStart;

/* An interval of a line with another friction: chain and wire in one line, say. */
typedef struct CpsFrictionZone {
    double from, to; /* [m] natural arc length from end A, 0 <= from < to <= length of the line */
    double factor;   /* [-] >= 0, of the coefficients, or the friction set, of whatever obstacle it
                        touches */
} CpsFrictionZone;

/* A tension-only line, node 0 at end A, node `element_count` at end B. */
typedef struct CpsLine {
    uint32_t cookie;
    const char *name;
    double length;                /* [m] natural length > 0 */
    int element_count;            /* >= 1 */
    const double *element_length; /* (element_count) [m], their sum is `length`; NULL: all equal */
    double weight;    /* [N/m] >= 0 per natural length, along gravity (submerged weight) */
    double stiffness; /* [N] EA > 0; INFINITY: inextensible */
    int zone_count;   /* >= 0, default 0 */
    /* (zone_count) in order from A to B, without overlap; the factor elsewhere is 1. A node's is
     * the mean over the length that it stands for */
    const CpsFrictionZone *zone;
    CpsStart start;
    CpsEnd end[2]; /* default: A held where the start puts it, B free without force; a position
                      must agree with the start */
} CpsLine;

/* One end of one line gets a new imposed position or force. A free end given a position is grabbed
 * where it is and moved; a held end given a force is let go from the force it carries. */
typedef struct CpsChange {
    int line; /* index in the scene */
    int end;  /* CPS_END_A or CPS_END_B */
    CpsEnd to;
} CpsChange;

/* A cylinder or sphere turns about its axis, and takes along what sticks to it. */
typedef struct CpsTurn {
    int obstacle; /* index in the scene */
    double angle; /* [rad] by which it turns in this stage, right-hand rule */
} CpsTurn;

/* An entry of the history, reached in `step_count` equal load steps. */
typedef struct CpsStage {
    uint32_t cookie; /* of cps_stage_default(); a stage made otherwise is refused */
    const char *name;
    int step_count; /* >= 1 */
    int change_count;
    const CpsChange *change;
    int turn_count;
    const CpsTurn *turn;
    bool gravity_changes; /* default false: gravity stays as it is */
    double gravity[3]; /* [m/s2] else what the scene's becomes in the stage's steps; a line's weight
                          goes with it: w per |g| of the scene */
} CpsStage;

typedef enum CpsFrictionPolicy {
    CPS_FRICTION_POLICY_FROZEN, /* the bound A = mu R is that of the reference configuration   (S90
                            section 2 d) */
    CPS_FRICTION_POLICY_CONSISTENT /* the default, Coulomb's law: A = mu R with the reaction of the
                               configuration reached */
} CpsFrictionPolicy;

typedef enum CpsContactPolicy {
    CPS_CONTACT_POLICY_REACHED,  /* no node ends below an obstacle: contact of the configuration
                                    reached */
    CPS_CONTACT_POLICY_REFERENCE /* only what touches at the reference is kept out, S90 (35) */
} CpsContactPolicy;

typedef enum CpsLinearSystem {
    CPS_LINEAR_SYSTEM_CHAIN, /* block tridiagonal, cost linear in the nodes */
    CPS_LINEAR_SYSTEM_DENSE  /* the same matrix in full: small lines and tests only */
} CpsLinearSystem;

typedef struct CpsSolverOptions {
    double tolerance;   /* [-] certified when gap <= tolerance * scale, 1e-14..1e-2, default 1e-8 */
    int max_iterations; /* of one solve of a line, 1..1000, default 60; 20 more for each doubling of
                           its elements beyond 12 800 */
    CpsLinearSystem linear_system; /* default chain */
    /* [-] a step is cut until two halves change displacements per length and tensions per largest
     * force by no more, 1e-9..1; default 0: steps are as given */
    double path_tolerance;
    int max_halvings; /* how often a step may be halved, for the path or because it does not
                     converge, 0..30, default 10 */
    bool cold; /* each step is solved from nothing; default false: first by Newton's method from
                  the step before */
    int thread_count; /* threads that share the lines of a step, 1..256, default 1, the caller's; of
                         no use beyond the number of lines. The answers are the same bits. */
} CpsSolverOptions;

typedef struct CpsScene {
    uint32_t cookie;
    const char *title;  /* may be NULL */
    double gravity[3];  /* [m/s2] default 0 0 -9.81; its direction is that of the lines' weight */
    int obstacle_count; /* >= 0 */
    const CpsObstacle *obstacle;
    int line_count; /* >= 1 */
    const CpsLine *line;
    int stage_count; /* >= 0 */
    const CpsStage *stage;
    CpsFrictionPolicy friction_policy;
    CpsContactPolicy contact_policy;
    CpsSolverOptions solver;
} CpsScene;

CPS_API CpsScene cps_scene_default(void);
CPS_API CpsLine cps_line_default(void);
CPS_API CpsObstacle cps_obstacle_default(void);
CPS_API CpsStage cps_stage_default(void); /* one step in which nothing changes; without a name */

/* Check everything that can be known before solving.
 *
 *   err   may be NULL; err->message names the line, the value found and what was expected
 *
 * Returns CPS_OK, CPS_ERR_ARGUMENT, CPS_ERR_LIMIT or CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_scene_check(const CpsScene *scene, CpsError *err);

#ifdef __cplusplus
}
#endif
#endif
