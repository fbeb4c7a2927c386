/* SPDX-License-Identifier: BSD-3-Clause */
/* What a line keeps of its last steps so that the next one can go on from it (warm_step.h). */
#ifndef CAPSTAN_SRC_CABLE_LOAD_CHANGE_H
#define CAPSTAN_SRC_CABLE_LOAD_CHANGE_H

#include <stdbool.h>

#include "capstan/scene.h"

/* A node that is held or pulled, and the increment of its position [m] or force [N] in a substep.
 */
typedef struct CpsiGraspPart {
    int node;
    CpsEndKind kind;
    double by[3];
} CpsiGraspPart;

/* The increments of the loads in a substep. */
typedef struct CpsiLoadChange {
    bool known;
    int grasp_count;
    CpsiGraspPart grasp[CPS_MAX_GRASPS];
    CpsEndKind kind[2];
    double end[2][3]; /* [m] or [N] */
    double weight[3]; /* [N/m] */
    double turn;      /* [rad] the sum over the obstacles */
    bool winds;       /* a winch pays out or hauls in */
} CpsiLoadChange;

/* How Newton's method has fared (warm_step.h). */
enum { CPSI_NEWTON_PATIENCE = 4 };
typedef struct CpsiNewtonRecord {
    int tried, solved; /* programs of the step: tried, and solved */
    int failed;        /* those not solved, in a row */
    bool guessed;      /* the answer of the step goes back to a guess of it */
    bool began;        /* the first one was solved, from the guess */
    bool polished;     /* the last one was, from the solution of the loop (chain/polish.h) */
    bool unpolished;   /* such an answer was of no use: others are not tried */
    int failures;      /* steps in a row in which it was of no use, up to CPSI_NEWTON_PATIENCE */
    int pause;         /* steps that are next solved without it */
    bool useful;       /* it was of use in a step of the history */
} CpsiNewtonRecord;

#endif
