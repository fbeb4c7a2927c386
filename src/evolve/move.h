/* SPDX-License-Identifier: BSD-3-Clause */
/* What a load step imposes on one line, and where its ends are on the way (docs/theory.md 6g). */
#ifndef CAPSTAN_SRC_EVOLVE_MOVE_H
#define CAPSTAN_SRC_EVOLVE_MOVE_H

#include "cable/line_step.h"

/* The change of a load step: each end from one value to another of the same kind, obstacles by an
 * angle. */
typedef struct CpsiMove {
    CpsEnd from[2], to[2];
    int grasp_count;
    CpsEnd grasp_from[CPS_MAX_GRASPS], grasp_to[CPS_MAX_GRASPS];
    const double *angle; /* (obstacles) [rad] */
    /* where some are shifted: how, (obstacles), and where all are in the end; else NULL */
    const CpsiShift *shift;
    const CpsiObstacle *obstacle;
    double weight_from[3], weight_to[3]; /* [N/m] per natural length */
    double stored_from[2], stored_to[2]; /* [m] on the drums of winches */
    bool has_velocity[2];
    double velocity[2][3]; /* [m/s] of ends in time after the step, with the flag */
} CpsiMove;

/* What is imposed at a share of the way from one place, or force, to another. */
CpsEnd cpsi_move_between(const CpsEnd *from, const CpsEnd *to, double share);

/* Obstacle k of the line at a share of the move. */
CpsiObstacle cpsi_move_obstacle(const CpsiLine *line, const CpsiMove *move, int k, double share);

/* An end at a share of the move. It goes straight, on an obstacle that is shifted as seen from
 * that, and not into one that it touches before the move and after it: where a table turns, or the
 * obstacle is round, the straight way in space of what rests on it leads through it. */
CpsEnd cpsi_move_end(const CpsiLine *line, const CpsiMove *move, int end, double share);

#endif
