/* SPDX-License-Identifier: BSD-3-Clause */
/* The rule of least motion: of all configurations compatible with the forces of a round, the line
 * takes the one nearest to its reference. */
#ifndef CAPSTAN_SRC_CABLE_LEAST_MOTION_H
#define CAPSTAN_SRC_CABLE_LEAST_MOTION_H

#include "cable/line.h"
#include "cable/step_program.h"
#include "chain/nearest_program.h"

/* Scratch memory of the second program of a round, and data of the round, which lie in the memory
 * that the round's own program needs while it is being solved. */
typedef struct CpsiLeastMotion {
    CpsiNearestProgram program;
    /* (contacts, n) the state of each contact in the round: bits of least_motion.c */
    unsigned char *mark;
    bool *slack;   /* (n) element i between nodes i - 1 and i has no tension */
    int *cluster;  /* (n) of the node */
    double *basis; /* (n, 9) of a cluster: its free directions first, in world axes */
    double *place; /* (n, 3) [m] the new positions of the nodes */
    bool chose;    /* set where there was a choice; cleared by the caller */
} CpsiLeastMotion;

/* For steps that are solved with `program`, whose layout has just ended: the data of the round lie
 * in its last arrays. */
void cpsi_least_motion_layout(CpsiLeastMotion *least, CpsiArena *arena, int n, int contacts,
                              const CpsiChainProgram *program);

/* Move the line from the configuration that a round has found to the one of least sum h |x - x_R|^2
 * among all that are compatible with its forces.
 *
 *   line      reads position, reference, base, slip, gap, normal, friction bounds; writes
 *             position, and tension where there is none
 *   program   the solution of the round; NULL: no force acts on the line anywhere
 *   bounds    of the round
 *
 * Returns the number of iterations. Sets report.places; where the forces leave no choice nothing
 * else changes. Allocates nothing. */
int cpsi_least_motion(CpsiLine *line, CpsiLeastMotion *least, const CpsiChainProgram *program,
                      CpsiBounds bounds, int max_iterations);

/* Set report.places for positions that are kept as the round found them: with tension in every
 * element they are unique. */
void cpsi_places_as_found(CpsiLine *line, const CpsiChainProgram *program);

/* Write the slips of the final configuration to the solution of the round, from which the states of
 * the nodes (stick or slip) are read. */
void cpsi_least_motion_restate(const CpsiLine *line, CpsiChainProgram *program);

#endif
