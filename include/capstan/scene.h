/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/scene.h: lines, obstacles and loads, and the history of their changes. These are plain
 * structs that the caller fills and the library copies; the caller may free them after the call,
 * and all that they point to. Begin each one as cps_scene_default(), cps_line_default(),
 * cps_obstacle_default() or cps_stage_default(): others are refused. cps_scene_check checks
 * ranges, and its message names the member. S90 is Souza de Cursi (1990), M77 Moreau (1977). */
#ifndef CAPSTAN_SCENE_H
#define CAPSTAN_SCENE_H

#include "capstan/body.h"
#include "capstan/constraint.h"
#include "capstan/elasticity.h"
#include "capstan/grasp.h"
#include "capstan/ground.h"
#include "capstan/loads.h"
#include "capstan/mesh.h"
#include "capstan/motion.h"
#include "capstan/point.h"
#include "capstan/set.h"
#include "capstan/shape.h"
#include "capstan/shift.h"
#include "capstan/winch.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum CpsObstacleKind {
    CPS_OBSTACLE_PLANE,    /* a half-space; `normal` points to its free side */
    CPS_OBSTACLE_CYLINDER, /* a solid cylinder of infinite length: a bollard, a pipe, a drum */
    CPS_OBSTACLE_SPHERE,   /* a solid ball */
    CPS_OBSTACLE_GROUND,   /* what lies below the points of a grid */
    CPS_OBSTACLE_SURFACE,  /* where a function is negative */
    CPS_OBSTACLE_CAPSULE,  /* a cylinder with round ends: a bollard, a tank (shape.h) */
    CPS_OBSTACLE_TORUS,    /* a ring: a shackle, a bent tube */
    CPS_OBSTACLE_CONE,     /* a cone with a round tip, without end */
    CPS_OBSTACLE_BOX,      /* a box with round edges: a quay, a slab */
    CPS_OBSTACLE_MESH      /* what is nearer than the radius to a mesh, or behind it */
} CpsObstacleKind;

/* The set of friction forces F that two coefficients describe, at the reaction R. By M77 section 4
 * the slip is opposite to an outward normal of the set at F. */
typedef enum CpsFrictionShape {
    CPS_FRICTION_SHAPE_ELLIPSE, /* (F1/mu1)^2 + (F2/mu2)^2 <= R^2; a disc where mu1 = mu2 */
    CPS_FRICTION_SHAPE_BOX      /* |F1| <= mu1 R and |F2| <= mu2 R: two independent laws */
} CpsFrictionShape;

/* An obstacle. Lines stay on its free side and have friction on it. */
typedef struct CpsObstacle {
    uint32_t cookie;
    const char *name;
    CpsObstacleKind kind; /* default plane */
    /* [m] a point of the plane or of the cylinder's axis, the centre of the sphere, capsule, torus
     * or box, the tip of the cone, or the origin of a ground, surface or mesh; default 0 0 0 */
    double point[3];
    double normal[3]; /* [-] of a plane, of any length but 0; default 0 0 1 */
    /* [-] axis of rotation of what is round, of a cone into it; not 0 0 0; default 0 1 0 */
    double axis[3];
    double radius;  /* [m] > 0; of a torus its tube, a cone its tip, a box or mesh its edges */
    CpsShape shape; /* what else these have */
    const CpsGround *ground; /* of a ground, which stays in its place; an evolution retains it */
    CpsSurface surface;      /* of a surface, which does so as well */
    const CpsMesh *mesh;     /* of a mesh, which an evolution retains */
    /* [-] coefficient mu >= 0, default 0; where two directions differ, along the first one */
    double friction;
    bool has_friction_lateral; /* default false: the coefficient is the same in all directions */
    double friction_lateral;   /* [-] >= 0, with the flag: across the first direction */
    CpsFrictionShape friction_shape; /* default ellipse */
    /* In place of coefficients: the set of the friction forces on the line per unit normal force,
     * a bounded set of R^2 that contains 0, with components along the first and second tangent; the
     * second one is normal x first. It need not be symmetric (a ratchet). The evolution keeps what
     * it needs of it. Default NULL. */
    const CpsSet *friction_set;
    /* [-] the first direction is its part in the tangent plane, fixed in space but for shifts,
     * which turn it; default 0 0 0: the direction of the line, with which it turns */
    double grain[3];
    double stiffness; /* [N/m3] >= 0, default 0: rigid; else it gives, by pressure over depth */
    double damping;   /* [N s/m3] >= 0, of what gives: its pressure over velocity; default 0 */
    /* it may be shifted (shift.h), more than by turns about its own axis; default false */
    bool moves;
} CpsObstacle;
enum { CPS_END_A = 0, CPS_END_B = 1 };

typedef enum CpsStartKind {
    CPS_START_STRAIGHT, /* from point[0] to point[1] */
    CPS_START_POLYLINE, /* along point[0..point_count-1] */
    CPS_START_ARC,      /* from point[0], around centre point[1], turning about axis */
    CPS_START_STATIC,   /* the equilibrium without friction under the given ends */
    CPS_START_NODES     /* node i at point[i], with the forces of the reference if known */
} CpsStartKind;

/* The first reference configuration. Nodes lie on the shape at their natural arc lengths. An
 * elastic line is stretched evenly over a shape that is longer than itself; a shape that is shorter
 * is refused (use a static start).
 *
 * Given nodes may be any x_R of S90, also a slack one: no element may be longer than twice its
 * natural length, or than that length where the line is inextensible. The tensions T_R and either
 * the reactions R_R or the bounds A_R may be given too; arrays that are NULL are computed from the
 * positions. */
typedef struct CpsStart {
    CpsStartKind kind;
    int point_count;     /* straight, arc: 2; polyline: >= 2; static: 0; nodes: element_count + 1 */
    const double *point; /* (point_count, 3) [m] */
    double axis[3];      /* [-] arc: axis of the turn, right-hand rule, default 0 0 1 */
    /* nodes: (element_count) [N] T_R >= 0. NULL: K (|x'| - 1)^+, and 0 for an inextensible line */
    const double *tension;
    /* nodes: (element_count + 1) [N] R_R >= 0 of the obstacle that the node touches. NULL: S90
     * section 2 d 2, the positive part of -((T_R t)' + w).n, with the force on a free end */
    const double *reaction;
    /* nodes: (element_count + 1) [N] A_R >= 0 in place of `reaction`: R_R = A_R/mu with the
     * coefficient at the node. With frozen friction it is the bound of the first step. */
    const double *friction_bound;
} CpsStart;

/* An interval of a line in which friction differs, for instance chain and wire in one line. */
typedef struct CpsFrictionZone {
    double from, to; /* [m] natural arc length from end A, 0 <= from < to <= length of the line */
    double factor;   /* [-] >= 0, multiplies the friction of every obstacle that it touches */
} CpsFrictionZone;

/* A stretch of a line of one make: chain, wire, fibre rope. */
typedef struct CpsSection {
    const char *type; /* name of its make; may be NULL */
    double length;    /* [m] natural length > 0 */
    double weight;    /* [N/m] >= 0 per natural length, along gravity (submerged weight) */
    double inertia;   /* [kg/m] >= 0, default 0, as of a line */
    double stiffness; /* [N] EA > 0, INFINITY: inextensible; finite in all sections or in none */
    int stiffness_row_count; /* default 0; or of a table in place of `stiffness` */
    const CpsStiffnessRow *stiffness_row;
    bool has_dynamic_stiffness; /* default false: `stiffness` is the only one */
    CpsDynamicStiffness dynamic_stiffness;
    bool has_breaking_load; /* default false */
    double breaking_load;   /* [N] > 0, with the flag: of what the report's utilisation is a part */
    bool has_break_at;      /* default false */
    double break_at;        /* [N] > 0, with the flag: above this tension it parts (failure.h) */
} CpsSection;

/* A clump or a buoy at a node of a line. */
typedef struct CpsPointWeight {
    double arc_length; /* [m] natural, of a node between the ends */
    double weight;     /* [N] along gravity (submerged weight); negative: a buoy lifts the line */
    double inertia;    /* [kg] >= 0, default 0: mass that moves with the node (motion.h) */
} CpsPointWeight;

/* A line that carries tension only. Node 0 is end A, node `element_count` is end B. */
typedef struct CpsLine {
    uint32_t cookie;
    const char *name;
    double length;                /* [m] natural length > 0 */
    int element_count;            /* >= 1 */
    const double *element_length; /* (element_count) [m], their sum is `length`; NULL: all equal */
    double weight;           /* [N/m] >= 0 per natural length, along gravity (submerged weight) */
    double inertia, damping; /* [kg/m], [N s] >= 0, default 0: mass, and damping (motion.h) */
    double bearing_width;    /* [m] >= 0, default 0: with which it bears on obstacles that give */
    double velocity[3];      /* [m/s] of the free nodes as the history begins; default 0 0 0 */
    double stiffness;        /* [N] EA > 0; INFINITY: inextensible */
    int stiffness_row_count; /* default 0; or of a table in place of `stiffness`, as of a section */
    const CpsStiffnessRow *stiffness_row;
    bool has_dynamic_stiffness; /* default false; as of a section */
    CpsDynamicStiffness dynamic_stiffness;
    bool has_breaking_load, has_break_at; /* default false */
    double breaking_load; /* [N] > 0, with the flag: of what the report's utilisation is a part */
    double break_at;      /* [N] > 0, with the flag: above this tension it parts (failure.h) */
    /* (section_count) from A to B, each ending at a node; their lengths make up `length`. NULL, the
     * default: the line is of one make, with what is above, which is not read otherwise. */
    int section_count;
    const CpsSection *section;
    bool quasi_static; /* in steps in time too (motion.h): it needs no inertia; default false */
    int point_weight_count, zone_count; /* >= 0, default 0 */
    const CpsPointWeight *point_weight; /* in order from A to B; several may be at one node */
    /* (zone_count) in order, without overlap; elsewhere the factor is 1, at a node it is a mean */
    const CpsFrictionZone *zone;
    CpsStart start;
    CpsEnd end[2]; /* default: A held where the start places it, as a position has to be; B free */
    int end_point[2];            /* of ends at points: the index in the scene; default 0 */
    CpsWinch winch[2];           /* at ends A and B; default none */
    CpsConstraint constraint[2]; /* of free ends A and B (constraint.h); default none */
    const CpsLineLoads *loads;   /* springs, forces and drag (loads.h); NULL, the default: none */
} CpsLine;

/* A new imposed position or force of an end of a line, reached in equal increments over the stage.
 * A free end that gets a position is moved from where it is; a held end that gets a force is
 * released from what it carried, and one of CPS_END_KIND_RELEASED is let go at once (failure.h). */
typedef struct CpsChange {
    int line, end; /* index in the scene; CPS_END_A or CPS_END_B */
    CpsEnd to;
    bool has_velocity;  /* default false */
    double velocity[3]; /* [m/s] with the flag: of a held end after the step (motion.h) */
} CpsChange;

/* A rotation about the axis of a cylinder .. cone; what sticks to it moves with it. */
typedef struct CpsTurn {
    int obstacle; /* index in the scene */
    double angle; /* [rad] of the rotation in this stage, by the right-hand rule */
} CpsTurn;

/* An entry of the history: changes that take place in `step_count` equal load steps. */
typedef struct CpsStage {
    uint32_t cookie; /* of cps_stage_default(); a stage made otherwise is refused */
    const char *name;
    int step_count;  /* >= 1 */
    double duration; /* [s] >= 0, default 0: quasi-static; else in time (motion.h) */
    double error;    /* [m] >= 0, default 0: equal steps; else no longer ones (CpsPace) */
    /* lines stretch by their static stiffness; default false: a dynamic one (elasticity.h) */
    bool static_stiffness;
    int change_count;
    const CpsChange *change;
    int turn_count;
    const CpsTurn *turn;
    int shift_count, sway_count, pay_out_count; /* default 0 */
    const CpsShift *shift;
    const CpsSway *sway; /* oscillations of what changes, with a duration */
    const CpsPayOut *pay_out;
    int point_change_count, body_change_count, grasp_change_count; /* default 0 */
    const CpsPointChange *point_change;
    const CpsBodyChange *body_change;
    const CpsGraspChange *grasp_change;
    bool gravity_changes; /* default false: gravity stays as it is; needs a scene with a gravity */
    /* [m/s2] with the flag: at the end of the stage. Weights change in proportion to the scene's */
    double gravity[3];
} CpsStage;

typedef enum CpsFrictionPolicy {
    /* the bound A = mu R has the reaction of the reference configuration (S90 section 2 d) */
    CPS_FRICTION_POLICY_FROZEN,
    /* the default, Coulomb's law: the bound has the reaction of the configuration reached */
    CPS_FRICTION_POLICY_CONSISTENT
} CpsFrictionPolicy;

typedef enum CpsContactPolicy {
    CPS_CONTACT_POLICY_REACHED,  /* the default: no node ends below an obstacle */
    CPS_CONTACT_POLICY_REFERENCE /* only nodes that touch at the reference are kept out, S90 (35) */
} CpsContactPolicy;

typedef enum CpsLinearSystem {
    CPS_LINEAR_SYSTEM_CHAIN, /* block tridiagonal, cost linear in the nodes */
    CPS_LINEAR_SYSTEM_DENSE  /* the same matrix in full: small lines and tests only */
} CpsLinearSystem;

enum { CPS_MAX_THREADS = 256 };

typedef struct CpsSolverOptions {
    /* [-] certified when gap <= tolerance * scale, 1e-14..1e-2, default 1e-8. Above 1e-8, steps of
     * an elastic line on a plane without directions of friction are solved to a hundredth of it,
     * and nodes in contact are CPS_NODE_STATE_UNRESOLVED unless the step is warm. */
    double tolerance;
    /* of one program of a line, 1..1000, default 60; 20 more per doubling beyond 12 800 elements */
    int max_iterations;
    CpsLinearSystem linear_system; /* default chain */
    /* [-] 1e-9..1: a step is halved until its halves change the displacements, per length of the
     * line, and the tensions, per largest force, by no more than this; default 0: never for this
     * reason */
    double path_tolerance;
    int max_halvings; /* how often a step may be halved, for any reason, 0..30, default 10 */
    /* default false: a step is first solved by Newton's method from the one before */
    bool cold;
    /* threads that share the lines, 1..CPS_MAX_THREADS, default 1: that of the caller. The answers
     * are the same, bit for bit. */
    int thread_count;
} CpsSolverOptions;

typedef struct CpsScene {
    uint32_t cookie;
    const char *title; /* may be NULL */
    double gravity[3]; /* [m/s2] default 0 0 -9.81; the weight of the lines has its direction */
    /* default false: all is under water, or nothing. Else free points with a displaced weight float
     * (point.h), and gravity has no part along x or y and does not point upwards */
    bool has_water_surface;
    double water_surface;      /* [m] with the flag: z of the still water's surface */
    const CpsCurrent *current; /* (loads.h) default NULL: still water, or none */
    int obstacle_count;        /* >= 0 */
    const CpsObstacle *obstacle;
    int line_count; /* >= 1 */
    const CpsLine *line;
    int point_count; /* >= 0, default 0 */
    const CpsPoint *point;
    int body_count; /* >= 0, default 0 */
    const CpsBody *body;
    int stage_count;
    const CpsStage *stage; /* (stage_count) */
    CpsFrictionPolicy friction_policy;
    CpsContactPolicy contact_policy;
    CpsTimeScheme time_scheme; /* of stages and moves with a duration (motion.h) */
    bool in_time;              /* default false: moves have a duration only where a stage has one */
    CpsSolverOptions solver;
} CpsScene;

CPS_API CpsScene cps_scene_default(void);
CPS_API CpsLine cps_line_default(void);
CPS_API CpsObstacle cps_obstacle_default(void);
CPS_API CpsStage cps_stage_default(void); /* one step in which nothing changes; without a name */

/* Check all that can be checked before solving. The message of an error names line, value and what
 * was expected. Returns CPS_OK, CPS_ERR_ARGUMENT, CPS_ERR_LIMIT or CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_scene_check(const CpsScene *scene, CpsError *err);

#ifdef __cplusplus
}
#endif
#endif
