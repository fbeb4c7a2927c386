/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/point.h: points where lines meet. A line whose end has the kind CPS_END_KIND_POINT ends
 * at a point of the scene (scene.h), and all lines that end there pull on it. A point is held, or
 * free: then each load step finds the place at which the forces on it balance, together with the
 * lines, each of which is certified there (docs/theory.md 6d). It rests on one obstacle at a time,
 * the nearest, or that in which it lies deepest: where two must hold it, as in a groove, no place
 * is found.
 *
 *     CpsPoint point[2] = {cps_point_default(), cps_point_default()};
 *     point[0].name = "anchor";
 *     point[1].name = "knot";
 *     point[1].kind = CPS_POINT_KIND_FREE;
 *     line.end[CPS_END_B].kind = CPS_END_KIND_POINT;
 *     line.end_point[CPS_END_B] = 1;
 *
 * These are plain structs like those of scene.h. */
#ifndef CAPSTAN_POINT_H
#define CAPSTAN_POINT_H

#include <stdbool.h>

#include "capstan/base.h"
#include "capstan/constraint.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum CpsPointKind {
    CPS_POINT_KIND_HELD,   /* at its position, to which stages may move it */
    CPS_POINT_KIND_FREE,   /* where the forces on it balance */
    CPS_POINT_KIND_ON_BODY /* on a body (body.h), with which it moves; stages do not change it */
} CpsPointKind;

typedef struct CpsPoint {
    uint32_t cookie;
    const char *name;
    CpsPointKind kind; /* default held */
    /* [m] where it is, or where a free one begins; default 0 0 0. Lines that end there begin there:
     * where they all start by statics, that of a free point is a first guess */
    double position[3]; /* of a point on a body: in the axes of the body */
    int body;           /* index in the scene, of a point on a body */
    double force[3];    /* [N] on a free point, beside its lines and its weight; default 0 0 0 */
    /* [N] along gravity, with which it changes (submerged weight): of a clump; negative of a buoy,
     * which lifts; default 0 */
    double weight;
    /* [N] >= 0, default 0: of the water that it displaces. In a scene with a water surface the
     * weight above is that in the water; what leaves it is heavier by this much, and at the surface
     * the buoyancy is whatever between 0 and this keeps it there. Without a surface not read. */
    double displaced_weight;
    /* [m] >= 0, default 0: of what floats, upwards, with the point in its middle. Not 0, the
     * buoyancy grows evenly as it sinks, from 0 where all of it is out of the water. */
    double height;
    /* of steps in time (motion.h): [kg] >= 0, default 0, its mass and added mass, beside those of
     * the lines that end there; [m/s] its velocity as the history begins, of a free point, default
     * 0 0 0 */
    double inertia, velocity[3];
    /* [m2] >= 0, default 0: of a free point, with which it bears on obstacles that give
     * (CpsObstacle.stiffness), beside the halves of the last elements of its lines */
    double bearing_area;
    /* Of a held point that is an anchor: the force along the plane on which it lies that it can
     * bear, level where it lies on none, and the one across it, upwards. What is exceeded is said
     * in the report; with `drags` the anchor bears no more than its capacity along the plane, and
     * gives way in it against that force, as by friction of this bound: its position is that from
     * which it drags, and where it has come to rest it stays. */
    bool has_holding_capacity; /* default false */
    double holding_capacity;   /* [N] > 0, with the flag */
    bool has_uplift_limit;     /* default false */
    double uplift_limit;       /* [N] > 0, with the flag */
    bool drags;                /* default false; needs a capacity */
    /* of a free point, default none: the set in which it is (constraint.h). No obstacle bears such
     * a point: where it would lie in one, no place is found */
    CpsConstraint constraint;
} CpsPoint;

CPS_API CpsPoint cps_point_default(void);

/* What a stage changes at a point, reached in equal increments over the stage: the position of one
 * that is held then, or the force on one that is free then. A held point that becomes free is
 * released, and the force on it begins with that which held it and its weight; a free one that is
 * to be held is moved from where it is. */
typedef struct CpsPointChange {
    int point; /* index in the scene */
    CpsPointKind kind;
    double value[3];    /* [m] or [N] */
    bool has_velocity;  /* default false */
    double velocity[3]; /* [m/s] with the flag: of a held point after the step (motion.h) */
} CpsPointChange;

/* How a point touches the obstacles. */
typedef enum CpsPointState {
    CPS_POINT_STATE_HELD = 0,
    CPS_POINT_STATE_FREE = 1,  /* off all obstacles */
    CPS_POINT_STATE_STICK = 2, /* at rest on one */
    CPS_POINT_STATE_SLIP = 3,  /* sliding on one, with friction at its bound */
    CPS_POINT_STATE_ON_BODY = 4
} CpsPointState;

/* Where a free point with a displaced weight is, in a scene with a water surface. */
typedef enum CpsPointWater {
    CPS_POINT_WATER_NONE = 0, /* of all others */
    CPS_POINT_WATER_SUBMERGED = 1,
    CPS_POINT_WATER_FLOATING = 2, /* at the surface */
    CPS_POINT_WATER_ABOVE = 3
} CpsPointWater;

/* The report on a point. Where lines that free points connect have no equilibrium together, each of
 * them is infeasible or unbounded, and its `proof` (step.h) is a part of theirs: of a self-stress,
 * which lacks `proof_length` in all, the force in this line from end A towards end B, the largest
 * being 1; of a motion, which lowers their energy by `proof_force` in all, its direction. The
 * points then stay where they are, without a place. Forces are on the point. On an obstacle the
 * point bears all that the lines bring there, the halves of their last elements included. */
typedef struct CpsPointReport {
    CpsPointState state;
    CpsPointWater water;
    double position[3]; /* [m] in the coordinates of the scene */
    double lines[3];    /* [N] sum of the lines that end here */
    /* [N] force and weight of a free point, its weight in air where `water` is not none; 0 of a
     * held one */
    double load[3];
    double support[3];  /* [N] what holds a held point, or the body it is on; 0 of a free one */
    double reaction;    /* [N] R >= 0 of the obstacle that it touches, along `normal` */
    double normal[3];   /* [-] 0 0 0 where it touches none */
    double friction[3]; /* [N] |F| <= mu R */
    double slip[3];     /* [m] on the obstacle in this step, in time from x* (motion.h) */
    double inertia[3];  /* [N] of its own mass in a step in time: minus mass times acceleration */
    double residual[3]; /* [N] sum of all forces: what nothing balances */
    double dissipated;  /* [J] by its friction in this step, or by its drag */
    double buoyancy;  /* [N] upwards; where `water` is none it is part of the weight, and 0 here */
    double displaced; /* [N] the largest buoyancy, under the gravity of the step */
    /* the force of the water is the buoyancy times this direction: 0 0 1, in waves e_z + a/g with
     * the acceleration a of the water (motion.h); 0 0 0 where `water` is none */
    double water_direction[3];
    double
        water_level; /* [m] z of the surface above or below it, in the coordinates of the scene */
    /* of an anchor; 0 of what it has no capacity or limit of */
    double capacity_used, uplift_used; /* [-] force over capacity, uplift over limit */
    double set_reaction[3];            /* [N] of the set that it is held to */
    double drag[3];                    /* [m] by which it has given way in this step */
    double dragged;                    /* [m] the sum of their lengths since the start */
    int obstacle; /* index in the scene; CPS_NO_OBSTACLE where it touches none */
    /* places tried in this step, each with a step of every line of the group: free points that
     * lines connect, also by way of others, are searched for together */
    int trial_count;
    bool has_place; /* the residual is no larger than 100 tolerances of the group's largest force */
} CpsPointReport;

struct CpsEvolution;

/* cps_evolution_point_report (evolve.h) with places relative to the origin of the views
 * (CpsLineView), from which they lose no digits far from 0. */
CPS_API CpsPointReport cps_evolution_point_view(const struct CpsEvolution *evolution, int point);

#ifdef __cplusplus
}
#endif
#endif
