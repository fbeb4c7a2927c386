/* SPDX-License-Identifier: BSD-3-Clause */
/* Rounds that look ahead: where the next round on tangent planes starts, foreseen from the last
 * few. */
#ifndef CAPSTAN_SRC_CABLE_ANDERSON_H
#define CAPSTAN_SRC_CABLE_ANDERSON_H

#include <stdbool.h>

#include "base/arena.h"

enum { CPSI_ANDERSON_MEMORY = 8 };

/* Places and ways of the last rounds, of n nodes. */
typedef struct CpsiAnderson {
    int count;                 /* changes known, at most CPSI_ANDERSON_MEMORY, the newest first */
    bool begun;                /* a round is known */
    double *from;              /* (n, 3) [m] where the round under way starts */
    double *to, *displacement; /* (n, 3) [m] where the round before ended, and its way */
    double *d_to[CPSI_ANDERSON_MEMORY]; /* (n, 3) [m] changes of these from one round to the next */
    double *d_displacement[CPSI_ANDERSON_MEMORY]; /* (n, 3) [m] */
} CpsiAnderson;

void cpsi_anderson_layout(CpsiAnderson *anderson, CpsiArena *arena, int n);

/* The round to come starts at `place` (n, 3), and nothing before it counts. */
void cpsi_anderson_start(CpsiAnderson *anderson, int n, const double *place);

/* The round has taken the nodes to `place` (n, 3): put it to where the next one is to start. Nodes
 * with weight 0 follow the others. */
void cpsi_anderson_accelerate(CpsiAnderson *anderson, int n, const double *weight, double *place);

#endif
