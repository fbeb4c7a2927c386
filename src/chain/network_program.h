/* SPDX-License-Identifier: BSD-3-Clause */
/* A program over several chains whose ends meet at joints, for the interior-point loop:
 *
 *     min  sum of the chains' energies  -  sum_J load_J.x_J,
 *
 * where a node of a chain that is at joint J moves by x_J, three unknowns in the common axes of all
 * chains. Such a node is `held` in its chain: the joint's equation has its forces. What else acts
 * on a joint, contact and friction, is a chain of one node.
 *
 * The linear system of each chain is eliminated towards its joints, by three solutions for each of
 * its ends there; the joints are left with a dense matrix. */
#ifndef CAPSTAN_SRC_CHAIN_NETWORK_PROGRAM_H
#define CAPSTAN_SRC_CHAIN_NETWORK_PROGRAM_H

#include "chain/chain_program.h"

/* The first and the last node of a chain. */
enum { CPSI_FIRST_NODE, CPSI_LAST_NODE, CPSI_END_NODES, CPSI_NO_JOINT = -1 };

typedef struct CpsiNetworkProgram {
    CpsiProgram base;             /* of the joints: u, load, .. (joints, 3) */
    int count;                    /* chains */
    CpsiChainProgram *chain;      /* (count) each filled by the caller, of the same units */
    int (*joint)[CPSI_END_NODES]; /* (count) of its end nodes, or CPSI_NO_JOINT; of a chain of one
                                     node the first */
    int joints;
    double *matrix; /* (3 joints, 3 joints) and its factor */
    double *kept;   /* right-hand side of the chain that is being solved */
    int *pivot;     /* (3 joints) */
} CpsiNetworkProgram;

/* Place the arrays for so many chains of at most n nodes, points included, and joints; the chains'
 * own arrays are placed by the caller. */
void cpsi_network_layout(CpsiNetworkProgram *network, CpsiArena *arena, int chains, int n,
                         int joints);

#endif
