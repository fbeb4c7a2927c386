/* SPDX-License-Identifier: BSD-3-Clause */
/* A trial of the search for the places of free points and bodies (balance.h): the lines solved with
 * their ends held there, and what the forces on points and bodies leave. */
#ifndef CAPSTAN_SRC_EVOLVE_TRIAL_H
#define CAPSTAN_SRC_EVOLVE_TRIAL_H

#include "cable/network.h"
#include "evolve/point_set.h"
#include "evolve/state.h"
#include "evolve/water.h"
#include "linalg/graph_matrix.h"

/* Stiffness added, in units of the largest force over the length of a point's longest line: where
 * slack lines have none, the rounding of forces moves a point by a thousandth of that length. */
#define CPSI_REGULAR 1e-8

/* Of groups with no more bodies, the most that a file may have, it is asked whether they are stable
 * together. */
enum { CPSI_TOGETHER = 100 };

/* A free point in a trial. */
typedef struct CpsiFree {
    int point;
    Vec3 place, rest; /* rest: r */
    Vec3 left;        /* r + R n + F */
    double tension;   /* [N] of all elements that end there, together */
    double stiffness; /* [N/m] rho, of the size of the lines' */
    /* at the nearest obstacle, where there is one */
    int obstacle;
    double gap, friction, bound, reaction;
    bool gives;               /* that obstacle does (soft_point.h): R = `spring` max(0, -over) */
    double spring, over;      /* [N/m]; [m] by how much it is above where the spring begins */
    Vec3 normal, slip, force; /* force: F */
    bool drags;               /* an anchor: in a plane across `normal`, within its bound */
    CpsiWater water;          /* whose buoyancy is in `rest` */
    CpsiInSet in_set;         /* where a set holds it; then no obstacle bears it */
    bool reached;             /* by the forest along which the points are balanced */
    Vec3 start; /* where the point was, on the surface and turned with it; in what gives, as deep
                   as the place */
} CpsiFree;

/* `rest` with another buoyancy. */
static inline Vec3 cpsi_rest_with(const CpsiFree *at, double buoyancy) {
    return vec3_axpy(buoyancy - at->water.buoyancy, at->water.n, at->rest);
}

/* A free body in a trial: what acts on it, and what of that nothing balances. */
typedef struct CpsiRigid {
    int body;
    CpsiPose pose;
    CpsiWrench inertia, damping;  /* of a step in time */
    CpsiWrench lines, rest, left; /* rest: all but supports; left: of that in its free directions */
} CpsiRigid;

/* Places of the points and of the lines' nodes in rounds (point_rounds.h), where these are taken.
 */
typedef struct CpsiPointRounds {
    double *place, *weight; /* (points and nodes, 3) [m], (points and nodes) */
    CpsiAnderson anderson;
} CpsiPointRounds;

struct CpsiBalance {
    int count;                  /* free points */
    CpsiFree *at, *from, *best; /* (count) of the trial, before it, and of the best one */
    int *number;                /* (points) of a free point, else -1 */
    int body_count;             /* free bodies */
    CpsiRigid *rigid, *rigid_from, *rigid_best, *rigid_now; /* (body_count) */
    int *rigid_of;           /* (points) the free body that a point is on, else -1 */
    int unknowns;            /* 3 count + 6 body_count */
    int line_count;          /* lines at free points, or at points on free bodies */
    int *line;               /* (line_count) */
    bool *chose;             /* (count) points with a choice of places */
    int *iterations;         /* (lines) of trials that were not kept */
    unsigned char *state;    /* of all lines before the step */
    size_t *offset;          /* (lines + 1) of each in `state` */
    double *tangent;         /* (line_count, 36) */
    double *smooth;          /* (line_count, 36) of a stiffness beside it (following.h), and */
    double (*rows)[3][3];    /* (count) what it multiplies the rows of points by */
    int *joined;             /* (points) groups of those that follow there (points.h) */
    CpsiGraphMatrix *matrix; /* of the unknowns */
    double *kept;            /* (body_count, 6) of its diagonal */
    double *turned;          /* (body_count, 3) [rad] by the last round */
    double *coupling;        /* (6 body_count, 6 body_count) forces on bodies by motions of others,
                                and scratch memory, of no more than CPSI_TOGETHER */
    double *together;        /* likewise */
    int *node;               /* (count + 2 body_count) their blocks in the matrix of the scene */
    double *right, *step;    /* (unknowns) */
    int (*ends)[2];          /* (line_count, 2) the joints at their ends, or CPSI_NO_JOINT */
    CpsiJoint *joint;        /* the free points, then the points on free bodies */
    int *joint_of;           /* (points) the joint that a point is, or CPSI_NO_JOINT */
    CpsiNetworkBody *held;   /* (body_count) */
    CpsiNetworkMove guess;
    CpsiNetwork network;
    CpsiPointRounds rounds;
    double force;    /* [N] the largest of the trial */
    double acting;   /* [N] ... without the tensions of inextensible lines, which follow from it */
    double rounding; /* [N] of the forces of the lines by that of places */
    bool certified;  /* are all lines, in this trial? */
    bool follows;    /* friction bounds follow the reactions */
    int trials;
    int open_trials; /* of this search, in which a line was not certified */
    CpsEvolution *evolution;
    CpsiTask task;
    CpsiArena arena; /* in which all this lies */
};

/* Memory for the search; NULL where there is none. The lines of the evolution are placed. */
CpsiBalance *cpsi_balance_create(const CpsEvolution *evolution);
void cpsi_balance_free(CpsiBalance *balance);

/* The place of a point in the trial; false where it is neither free nor on a free body. */
bool cpsi_trial_place(const CpsiBalance *balance, int point, Vec3 *place);
/* The obstacle nearest to a place, of all or of the rigid ones, how far it is [m], and its normal;
 * CPS_NO_OBSTACLE without one, then the gap is infinite. */
int cpsi_trial_nearest(const CpsEvolution *evolution, Vec3 place, bool rigid, double *gap,
                       Vec3 *normal);
/* The nearest obstacle, and where the point was on it when the step began. Of an anchor that drags:
 * the plane in which it does, and where it is held. */
void cpsi_trial_find_obstacle(const CpsEvolution *evolution, CpsiFree *at);
/* [m] A point that is no farther from an obstacle, or has slid no farther, touches it, or is at
 * rest. */
double cpsi_trial_touch(const CpsiBalance *balance, const CpsiFree *at);
/* rho s - F with the friction F that would balance: within the bound the point is to stick. */
Vec3 cpsi_trial_friction_test(const CpsiFree *at);
bool cpsi_is_to_stick(const CpsiFree *at);
/* From the reference point of a free body to a point on it, in the axes of the scene. */
Vec3 cpsi_trial_arm(const CpsiBalance *balance, const CpsiRigid *rigid, int point);

/* Use the blocks of the free points and bodies of the search (joint_system.h). */
void cpsi_trial_use_blocks(CpsiBalance *balance);
/* The options of the step: without friction where lines are placed by statics. */
CpsiStepOptions cpsi_trial_options(const CpsEvolution *evolution);
/* The points and bodies where the step began. */
void cpsi_begin_again(CpsiBalance *balance);

/* Do no forces of a bounded size act on its points but friction: does none float, and no anchor
 * drag? Otherwise it has no proof, and no answer as one program. */
bool cpsi_is_without_bounds(const CpsiBalance *balance);
/* The line as it was before the step; all lines of the search. */
void cpsi_trial_restore_line(CpsiBalance *balance, int line);
void cpsi_trial_restore_lines(CpsiBalance *balance);
/* Take the step of the lines of the search, as it is imposed on them. */
void cpsi_step_lines(CpsiBalance *balance);
/* The forces that the lines as they are leave on the points and bodies. */
void cpsi_read_forces(CpsiBalance *balance);
/* Solve the lines for the places of the points and bodies. */
void cpsi_try_places(CpsiBalance *balance);
/* [N] The largest force that nothing balances, moments over the arm of their body; now. */
double cpsi_largest_left(const CpsiBalance *balance, const CpsiFree *at, const CpsiRigid *rigid);
double cpsi_left_now(const CpsiBalance *balance);
/* Is so much left within the tolerance? */
bool cpsi_is_balanced(const CpsiBalance *balance, double left);
/* Is a line of the group inextensible? */
bool cpsi_has_inextensible(const CpsiBalance *balance);
/* Is a point at rest, or its friction at its bound and against the slip, to the same tolerance?
 * Where hardly anything is stiff, what is left at a point does not tell. */
bool cpsi_obeys_friction(const CpsiBalance *balance, const CpsiFree *at);
/* Is the point in its set and in no obstacle? True of one without a set. */
bool cpsi_is_kept_in_set(const CpsiBalance *balance, const CpsiFree *at);
/* Is the trial an answer: lines certified, points and bodies balanced by forces that obey their
 * laws? */
bool cpsi_is_answer(const CpsiBalance *balance);

#endif
