/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines whose ends meet at joints, as one program: where the joints go in a step, on the tangent
 * planes of the reference. A first guess for the search that takes the whole step of each line
 * (evolve/balance.h). */
#ifndef CAPSTAN_SRC_CABLE_NETWORK_H
#define CAPSTAN_SRC_CABLE_NETWORK_H

#include "cable/line.h"
#include "cable/line_solve.h"
#include "cable/step_options.h"
#include "chain/network_program.h"

/* A joint that the step moves. */
typedef struct CpsiJoint {
    Vec3 position, load; /* [m] on whose tangent plane the program is, [N] */
    Vec3 slip;           /* [m] along the surface from the reference to there */
    double share;        /* [m] natural length that it represents */
    /* contact with the nearest obstacle, NULL: none */
    const CpsiObstacle *obstacle;
    const struct CpsiEndSet *on; /* the set that holds it, NULL: none */
    double gap, friction, bound; /* [m], [-], [N] of frozen friction */
    bool gives;                  /* the obstacle, with the stiffness `spring` [N/m] */
    double spring;
    /* [N] of the water that it displaces, [m] by how much it is below the surface; 0: no surface */
    double displaced, depth;
    /* an anchor that drags in the plane across `normal`, with friction of no more than `capacity`
     */
    bool drags;
    Vec3 normal;
    double capacity; /* [N] */
    Vec3 dragged;    /* [m] so far in the step */
    int body;        /* that it is on, else -1; then nothing else acts on it */
    Vec3 arm;        /* [m] from the body's reference point */
} CpsiJoint;

/* A body: what acts on it at the places where its joints are [N, N m], and its stiffness (6, 6). */
typedef struct CpsiNetworkBody {
    Vec3 force, moment;
    double stiffness[36];
    bool fixed[6]; /* its directions in which its joints do not move */
} CpsiNetworkBody;

typedef struct CpsiNetwork {
    CpsiNetworkProgram program;
    int lines, joints;       /* that it was laid out for */
    CpsiChainProgram *chain; /* (lines + joints) a program for each, of which some take part */
    CpsiIpmOutcome found;    /* how the last program ended */
    double unit_force;       /* [N] of the last program */
    double turned;           /* [rad] by how much a guess has turned the axes of the lines' nodes */
    CpsiJoined *joined;      /* (lines) each line's part of the solution */
    double **base;           /* (lines) of lines with local axes, the base of the last program, */
    int **obstacle_index;    /* (lines) ... and the obstacles of its contacts */
} CpsiNetwork;

/* Place the arrays for the lines (count) and so many joints and bodies. */
void cpsi_network_place(CpsiNetwork *network, CpsiArena *arena, const CpsiLine *line, int count,
                        int joints, int bodies, const CpsiLinsysOps *ops,
                        const CpsiNetworkTools *tools);

/* The part of it that a step moves. */
typedef struct CpsiNetworkPart {
    int lines, joints, bodies;
    int own;                     /* the first joints are on no body */
    double longer;               /* factor of the elements' lengths */
    double target;               /* relative gap of the solution */
    bool is_refined;             /* by steps in which what sticks moves ever less */
    bool is_exact;               /* to the limit of the arithmetic, whatever is said above */
    bool continues;              /* on the tangent planes to which the last guess has led */
    const int *number;           /* (lines) of those that the network was laid out for */
    const int (*at)[2];          /* (lines, 2) the joint of each end, or CPSI_NO_JOINT */
    const CpsiJoint *joint;      /* (joints) */
    const CpsiNetworkBody *body; /* (bodies) */
} CpsiNetworkPart;

/* How a joint touches its obstacle. */
typedef enum CpsiJointState { CPSI_JOINT_OFF, CPSI_JOINT_SLIDES, CPSI_JOINT_STICKS } CpsiJointState;

/* Where they go. */
typedef struct CpsiNetworkMove {
    double *joint;         /* (own, 3) [m] */
    CpsiJointState *state; /* (own) */
    double *body;          /* (bodies, 6) [m, rad] */
    double *pull;          /* (lines, 2, 3) [N] of each line on what holds its ends */
} CpsiNetworkMove;

/* Find where the joints and bodies go. `line` are all lines; the ends at joints are held where the
 * joints are, and what else the step imposes is set. False where the program has no solution. The
 * lines' steps are overwritten: on curved obstacles their tangent planes move to where the nodes
 * go, and a guess that continues begins there. */
bool cpsi_network_guess(CpsiNetwork *network, CpsiLine *line, const CpsiNetworkPart *part,
                        const CpsiStepOptions *options, const CpsiNetworkMove *out);

/* The same to the limit of the arithmetic, as the program of a line alone is solved: the answer of
 * the step where the tangent planes are the obstacles themselves. network->joined has the parts of
 * the lines. */
bool cpsi_network_solve(CpsiNetwork *network, CpsiLine *line, const CpsiNetworkPart *part,
                        const CpsiStepOptions *options, const CpsiNetworkMove *out);

#endif
