/* SPDX-License-Identifier: BSD-3-Clause */
/* Anderson acceleration of the rounds on tangent planes: extrapolates where the next round starts
 * from the last few rounds. */
#ifndef CAPSTAN_SRC_CABLE_ANDERSON_H
#define CAPSTAN_SRC_CABLE_ANDERSON_H

#include <stdbool.h>

#include "base/arena.h"

enum { CPSI_ANDERSON_MEMORY = 8 };

/* Positions and displacements of the last rounds, of n nodes. */
typedef struct CpsiAnderson {
    int count;                 /* changes known, at most CPSI_ANDERSON_MEMORY, the newest first */
    bool begun;                /* a round is known */
    double *from;              /* (n, 3) [m] where the present round starts */
    double *to, *displacement; /* (n, 3) [m] where the last round ended, and its displacement */
    double *d_to[CPSI_ANDERSON_MEMORY]; /* (n, 3) [m] changes of these from one round to the next */
    double *d_displacement[CPSI_ANDERSON_MEMORY]; /* (n, 3) [m] */
} CpsiAnderson;

void cpsi_anderson_layout(CpsiAnderson *anderson, CpsiArena *arena, int n);

/* Start anew: the next round starts at `place` (n, 3), and earlier rounds are forgotten. */
void cpsi_anderson_start(CpsiAnderson *anderson, int n, const double *place);

/* The round has moved the nodes to `place` (n, 3). Change `place` to where the next round is to
 * start. Nodes with weight 0 do not enter the least-squares problem. */
void cpsi_anderson_accelerate(CpsiAnderson *anderson, int n, const double *weight, double *place);

#endif
