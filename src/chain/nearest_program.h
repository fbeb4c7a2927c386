/* SPDX-License-Identifier: BSD-3-Clause */
/* The point of a convex set over a chain that is nearest to a given one:
 *
 *     min   sum_j h_j |u_j|^2/(2 V)
 *     s.t.  |e_i| <= 1,            e_i = e_i^0 + (u_i - u_{i-1})/l_i
 *         one link per element i = 1..n-1
 *           g_k + n_k.u >= 0       at node k
 *               half-spaces, any number at a node
 *           u_j in the span of its first `freedom` axes, 0 at held nodes
 *
 * The links are segments of chain_program.h with compliance 0. The half-spaces are its unilateral
 * contacts, all of them `second`: n_k is given in the axes of its node, 0 along axes that are not
 * free. V > 0 is the expected size of u, which makes the duals of order one. The objective is
 * strongly convex: the solution is unique. */
#ifndef CAPSTAN_SRC_CHAIN_NEAREST_PROGRAM_H
#define CAPSTAN_SRC_CHAIN_NEAREST_PROGRAM_H

#include "chain/chain_program.h"

typedef struct CpsiNearestProgram {
    /* first member, so that its kinds can cast to it; its unilateral contacts are the half-spaces
     */
    CpsiChainProgram chain;
    double *weight;          /* (n) h_j */
    int *freedom;            /* (n) free axes of the node, 1..3 */
    double size;             /* V */
    const CpsiKind *kind[3]; /* of its elements */
} CpsiNearestProgram;

/* Place a program for at most n nodes and `halves` half-spaces in the arena. */
void cpsi_nearest_program_layout(CpsiNearestProgram *program, CpsiArena *arena, int n, int halves,
                                 const CpsiLinsysOps *ops);

#endif
