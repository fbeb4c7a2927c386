/* SPDX-License-Identifier: BSD-3-Clause */
/* The data of an evolution. */
#ifndef CAPSTAN_SRC_EVOLVE_STATE_H
#define CAPSTAN_SRC_EVOLVE_STATE_H

#include "base/workers.h"
#include "capstan/failure.h"
#include "evolve/bodies.h"
#include "evolve/points.h"
#include "evolve/workspace.h"

/* A stage lets go and grasps at most so many nodes per line. */
enum { CPSI_STEP_NAME = 96, CPSI_GRASP_CHANGES = 2 * CPS_MAX_GRASPS };

/* A stage; positions are relative to the origin. */
typedef struct CpsiEvolutionStage {
    const char *name;
    int steps, change_count, point_change_count, body_change_count, grasp_change_count, turn_count,
        shift_count, sway_count, pay_out_count;
    CpsChange *change;
    CpsGraspChange *grasp_change;
    CpsPointChange *point_change;
    CpsBodyChange *body_change;
    CpsTurn *turn;
    CpsShift *shift;
    CpsSway *sway;
    double *series; /* the rows of all sways */
    CpsPayOut *pay_out;
    bool static_stiffness;
    bool gravity_changes;
    double gravity[3]; /* [m/s2] at its end, with the flag */
    double duration;   /* [s] 0: quasi-static */
    double error;      /* [m] that a step may make; 0: its steps are of equal length */
    uint64_t hash;     /* of this stage and all before it */
} CpsiEvolutionStage;

/* What a step is of its stage. */
typedef struct CpsiPortion {
    int part;          /* its number, from 0 */
    double from, to;   /* [-] shares of the stage where it begins and ends; of the last step 1 */
    double begin, end; /* [s] since the stage began */
    bool is_last;
} CpsiPortion;

/* Arrays of equal entries for what a line does not have; shared by all lines, whose largest number
 * of nodes is n. */
typedef struct CpsiViewFill {
    double *zero;         /* (3 n) 0 */
    double *one;          /* (n) 1 */
    int *first, *none;    /* (n) 0: the first obstacle; CPS_NO_OBSTACLE */
    unsigned char *state; /* (n) CPS_NODE_STATE_FREE */
} CpsiViewFill;

struct CpsEvolution {
    CpsiArena arena;
    CpsStepReport report;
    char step_name[CPSI_STEP_NAME];
    CpsiStepOptions options;
    int line_count, stage_count;
    int obstacle_count;
    CpsiObstacle *obstacle; /* (obstacle_count) */
    CpsiShift *shift;       /* (obstacle_count) how each is shifted in the step */
    double *angle;          /* (obstacle_count) [rad] by which each turns in the step */
    CpsiMove *move;         /* (line_count) the change of each line in the step */
    CpsiLine *line;         /* (line_count) */
    CpsCurrentRow
        *current_row; /* the scene's current, about the origin; and of each line, or NULL */
    CpsiFlow *flow;
    CpsiWave *wave; /* (waves of the scene), and what is known of them; NULL: none */
    CpsiWaves waves;
    CpsiGivenWater water; /* without a function: none */
    double *excitation;   /* of all bodies (excitation.h) */
    double *radiation;    /* of all bodies (radiation.h) */
    CpsiCylinder *member; /* of all bodies (members.h) */
    CpsiPoints points;
    CpsiBodies bodies;
    CpsiEvolutionStage *stage; /* (stage_count) */
    CpsiEvolutionStage live;   /* of a move that the history does not hold */
    /* what stages are checked against, in the coordinates of the scene */
    CpsObstacle *given_obstacle; /* (obstacle_count) without their sets of friction forces */
    CpsBody *given_body;         /* (bodies) */
    CpsLine *given_line;         /* (line_count) names and lengths only */
    CpsEnd *from;        /* (line_count, 2) where an end was when the stage that changes it began */
    CpsRelease *release; /* (line_count, 2) of the ends (failure.h) */
    CpsBreak parted;     /* the break that the last step was */
    int break_count;     /* breaks taken */
    CpsOutcome lone;     /* of the points and bodies in the step at which no line ends any more */
    double gravity[3], gravity_from[3]; /* [m/s2] now, and when the stage under way began */
    double gravity_given[3];            /* [m/s2] that of the scene */
    bool in_time;                       /* a step may have a duration */
    CpsTimeScheme time_scheme;
    double time, interval; /* [s] now, and of the last step, 0: quasi-static */
    CpsiFormula formula;   /* of the step under way, in time */
    double elapsed;        /* [s] since the stage under way began, where it has an `error` */
    double next;           /* [s] length of its next step; 0: its longest */
    CpsPace pace;          /* of the last step */
    bool ground_moved;     /* an obstacle turned or moved in it */
    bool restarts;         /* the step under way is an Euler step (time_step.h) */
    bool has_static;       /* the first step places lines by statics */
    bool *is_static;       /* (line_count) */
    double *
        mass; /* (line_count) [kg/m] weight per gravity; 0 where there is no gravity at the start */
    int done; /* steps of the history taken */
    int move_count;    /* moves taken beside the history */
    int current, part; /* the next stage, and how many of its steps have been taken */
    bool ended;        /* an infeasible or unbounded step ends the history */
    bool is_kept;      /* `before` is the state before the last step, which was a move */
    int workspace_count;
    CpsiWorkspace *workspace; /* (workspace_count) one for each thread */
    CpsiWorkers *workers;     /* the threads; NULL where there is only the caller's */
    void *before;         /* the state before a step that may be interrupted or taken back; NULL:
                             none was asked for */
    CpsiViewFill fill;    /* what views show where a line lacks an array */
    double origin[3];     /* [m] all positions are relative to it */
    uint64_t fingerprint; /* of all constant data but the history: identifies the scene */
};

/* The last move found no equilibrium: its report is shown, and what follows begins before it. */
static inline bool cpsi_move_failed(const CpsEvolution *evolution) {
    return evolution->is_kept && cps_outcome_is_final(evolution->report.outcome);
}

#endif
