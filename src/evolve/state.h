/* SPDX-License-Identifier: BSD-3-Clause */
/* The data of an evolution. */
#ifndef CAPSTAN_SRC_EVOLVE_STATE_H
#define CAPSTAN_SRC_EVOLVE_STATE_H

#include "base/workers.h"
#include "capstan/evolve.h"
#include "evolve/workspace.h"

enum { CPSI_STEP_NAME = 96 };

/* The change of one end in one stage. */
typedef struct CpsiChange {
    int line, end;
    CpsEnd from, to; /* `from` is found when the stage begins */
} CpsiChange;

typedef struct CpsiEvolutionStage {
    const char *name;
    int steps, change_count, turn_count;
    CpsiChange *change;
    CpsTurn *turn;
    double from[3], to[3]; /* [m/s2] gravity before the stage and after it */
} CpsiEvolutionStage;

/* Arrays of equal entries for what a line does not have; shared by all lines, whose largest number
 * of nodes is n. */
typedef struct CpsiViewFill {
    double *zero;         /* (3 n) 0 */
    double *one;          /* (n) 1 */
    int *first, *none;    /* (n) 0: the first obstacle; -1: none */
    unsigned char *state; /* (n) CPS_NODE_STATE_FREE */
} CpsiViewFill;

struct CpsEvolution {
    CpsiArena arena;
    CpsStepReport report;
    char step_name[CPSI_STEP_NAME];
    CpsiStepOptions options;
    int line_count, stage_count, step_count;
    int obstacle_count;
    CpsiObstacle *obstacle;     /* (obstacle_count) */
    const char **obstacle_name; /* (obstacle_count) */
    double *angle;              /* (obstacle_count) [rad] by which each turns in the step */
    CpsiMove *move;             /* (line_count) the change of each line in the step */
    CpsiLine *line;             /* (line_count) */
    CpsiEvolutionStage *stage;  /* (stage_count) */
    bool has_static;            /* the first step places lines by statics */
    bool *is_static;            /* (line_count) */
    double *
        mass; /* (line_count) [kg/m] weight per gravity; 0 where there is no gravity at the start */
    int done; /* steps taken */
    int current, part; /* the next stage, and how many of its steps have been taken */
    bool ended;        /* an infeasible or unbounded step ends the history */
    int workspace_count;
    CpsiWorkspace *workspace; /* (workspace_count) one for each thread */
    CpsiWorkers *workers;     /* the threads; NULL where there is only the caller's */
    void *before;             /* the state before a step, where one may be interrupted; else NULL */
    CpsiViewFill fill;        /* what views show where a line lacks an array */
    double origin[3];         /* [m] all positions are relative to it */
    uint64_t fingerprint;     /* of all constant data: identifies the scene */
};

#endif
