/* SPDX-License-Identifier: BSD-3-Clause */
/* The rule of least motion: of all places that go with the forces of a round, the line takes the
 * one nearest to its reference. */
#ifndef CAPSTAN_SRC_CABLE_LEAST_MOTION_H
#define CAPSTAN_SRC_CABLE_LEAST_MOTION_H

#include "cable/line.h"
#include "cable/step_program.h"
#include "chain/nearest_program.h"

/* Scratch of the second program of a round, and of what it is made from. */
typedef struct CpsiLeastMotion {
    CpsiNearestProgram program;
    /* (contacts, n) what the round says of each contact: bits of least_motion.c */
    unsigned char *mark;
    bool *slack;   /* (n) element i between nodes i - 1 and i carries nothing */
    int *cluster;  /* (n) of the node */
    double *basis; /* (n, 9) of a cluster: its free directions first, in world axes */
    double *place; /* (n, 3) [m] where the nodes are to go */
    bool chose;    /* set where there was a choice; its reader clears it */
} CpsiLeastMotion;

void cpsi_least_motion_layout(CpsiLeastMotion *least, CpsiArena *arena, int n, int contacts,
                              const CpsiLinsysOps *ops);

/* Move the line from the place that a round has found to the one of least sum h |x - x_R|^2 among
 * all that go with its forces.
 *
 *   line      reads position, reference, base, slide, gap, normal, friction bounds; writes
 *             position, and tension where there is none
 *   program   the solution of the round; NULL: no force acts on the line anywhere
 *   bounds    of the round
 *
 * Returns the iterations it took. Sets report.places; where the forces leave no choice nothing else
 * changes. Allocates nothing. */
int cpsi_least_motion(CpsiLine *line, CpsiLeastMotion *least, const CpsiChainProgram *program,
                      CpsiBounds bounds, int max_iterations);

/* Places that are taken as they were found: with tension in every element there are no others. Sets
 * report.places. */
void cpsi_places_as_found(CpsiLine *line, const CpsiChainProgram *program);

/* The slips of the place reached into the pairs of the round's solution, from which nodes are told
 * to stick or to slip. */
void cpsi_least_motion_restate(const CpsiLine *line, CpsiChainProgram *program);

#endif
