/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines whose ends meet at joints, as one program: where the joints go in a step, on the tangent
 * planes of the reference. A first guess for the search that takes the whole step of each line
 * (evolve/balance.h). */
#ifndef CAPSTAN_SRC_CABLE_NETWORK_H
#define CAPSTAN_SRC_CABLE_NETWORK_H

#include "cable/line.h"
#include "cable/step_options.h"
#include "chain/network_program.h"

/* A joint that the step moves. */
typedef struct CpsiJoint {
    Vec3 position, load; /* [m] at the reference, [N] */
    double share;        /* [m] natural length that it represents */
    /* contact with the nearest obstacle, NULL: none */
    const CpsiObstacle *obstacle;
    double gap, friction, bound; /* [m], [-], [N] of frozen friction */
} CpsiJoint;

typedef struct CpsiNetwork {
    CpsiNetworkProgram program;
    int lines, joints;       /* that it was laid out for */
    CpsiChainProgram *chain; /* (lines + joints) a program for each, of which some take part */
} CpsiNetwork;

/* Place the arrays for the lines (count) and so many joints. */
void cpsi_network_place(CpsiNetwork *network, CpsiArena *arena, const CpsiLine *line, int count,
                        int joints, const CpsiLinsysOps *ops);

/* The part of it that a step moves. */
typedef struct CpsiNetworkPart {
    int lines, joints;
    const int *number;      /* (lines) of those that the network was laid out for */
    const int (*at)[2];     /* (lines, 2) the joint of each end, or CPSI_NO_JOINT */
    const CpsiJoint *joint; /* (joints) */
} CpsiNetworkPart;

/* Find where the joints go. `line` are all lines; the ends at joints are held where they are, and
 * what else the step imposes is set. Writes the places (joints, 3) [m] and the iterations; false
 * where the program has no solution. The lines' steps are overwritten. */
bool cpsi_network_guess(CpsiNetwork *network, CpsiLine *line, const CpsiNetworkPart *part,
                        const CpsiStepOptions *options, double *place, int *iterations);

#endif
