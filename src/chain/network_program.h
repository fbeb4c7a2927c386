/* SPDX-License-Identifier: BSD-3-Clause */
/* A program over several chains whose ends meet at joints, for the interior-point loop:
 *
 *     min  sum of the chains' energies  -  sum_J load_J.x_J,
 *
 * where a node of a chain that is at joint J moves by x_J in the common axes of all chains. These
 * are three unknowns, or follow from the six of a body that the joint is on, which has a quadratic
 * energy of its own. Such a node is `held` in its chain: the equations of these unknowns have its
 * forces. Nodes at an end may be at the joint together; the elements between them do not stretch.
 * What else acts on a joint, contact and friction, is a chain of one node.
 *
 * The linear system of each chain is eliminated towards its joints, by three solutions for each of
 * its ends there; the joints are left with a matrix of their own (linalg/graph_matrix.h). Chains
 * are factorised and solved by several threads, with the same bits whatever their number. */
#ifndef CAPSTAN_SRC_CHAIN_NETWORK_PROGRAM_H
#define CAPSTAN_SRC_CHAIN_NETWORK_PROGRAM_H

#include "base/workers.h"
#include "chain/chain_program.h"
#include "linalg/graph_matrix.h"

/* The first and the last node of a chain. */
enum { CPSI_FIRST_NODE, CPSI_LAST_NODE, CPSI_END_NODES, CPSI_NO_JOINT = -1 };

/* Forces of a bounded size on joints (hinge.c): the energy A max(0, d.x_J - gap) adds to a joint
 * the force -R d, R in [0, A]. A is the bound times the weight. */
typedef struct CpsiHinges {
    int count;
    int *first;             /* (count) the first of the joint's three unknowns */
    double (*direction)[3]; /* (count) d in the common axes */
    double *bound, *weight; /* (count) > 0 */
    double *gap;            /* (count) of any sign */
    double (*s)[2], (*z)[2], (*q)[2], (*ds)[2], (*dz)[2];
} CpsiHinges;

typedef struct CpsiNetworkProgram {
    CpsiProgram base;             /* of the joints and bodies: u, load, .. */
    int count;                    /* chains */
    CpsiChainProgram *chain;      /* (count) each filled by the caller, of the same units */
    int (*joint)[CPSI_END_NODES]; /* (count) of its end nodes, or CPSI_NO_JOINT; of a chain of one
                                     node the first */
    /* (count) so many nodes beyond the one that is at the joint move with it, as those on a drum:
     * before it, or after it */
    int (*beyond)[CPSI_END_NODES];
    int joints;
    CpsiJointMap *map; /* (joints) */
    int bodies;
    int *body_first;         /* (bodies) their first unknown */
    double (*stiffness)[36]; /* (bodies) of the quadratic energy u' K u/2, K symmetric and >= 0 */
    CpsiHinges hinges;
    CpsiGraphMatrix *matrix; /* of the joints and bodies, whose blocks in use are its unknowns */
    CpsiWorkers *workers;    /* NULL: the thread that calls does everything */
    double *kept;            /* (workers, longest) right-hand side of the chain that each solves */
    int longest;
    /* of each chain, with its ties held: is it factorised, (from, to, 3, 3) the forces on its ties
     * by their displacements, (tie, 3) those by its right-hand side */
    bool *factored;
    double (*block)[CPSI_END_NODES][CPSI_END_NODES][9];
    double (*force)[CPSI_END_NODES][3];
} CpsiNetworkProgram;

extern const CpsiKind cpsi_hinge;
void cpsi_hinges_layout(CpsiHinges *hinges, CpsiArena *arena, int count);
/* Add the hinges' stiffness to the matrix of the joints. */
void cpsi_hinges_add(const CpsiHinges *hinges, CpsiGraphMatrix *matrix);

/* What belongs to the caller: the matrix, and `count` >= 1 threads. */
typedef struct CpsiNetworkTools {
    CpsiGraphMatrix *matrix;
    CpsiWorkers *workers;
    int count;
} CpsiNetworkTools;

/* Place the arrays for so many chains of at most n nodes, points included, joints, and bodies; the
 * chains' own arrays are placed by the caller. */
void cpsi_network_layout(CpsiNetworkProgram *network, CpsiArena *arena, int chains, int n,
                         int joints, int bodies, const CpsiNetworkTools *tools);

#endif
