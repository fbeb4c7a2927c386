/* SPDX-License-Identifier: BSD-3-Clause */
/* The free points that follow a body by the lines between them, recomputed from a file. */
#ifndef CAPSTAN_CHECKER_BODY_POINTS_H
#define CAPSTAN_CHECKER_BODY_POINTS_H

#include "body_stiffness.h"

enum { STAYS = -1 };

typedef struct BodyPoints {
    size_t count;
    int *number;    /* (points of the file) of one that follows, or STAYS */
    size_t *point;  /* (count) its number in the file */
    Junction *now;  /* (points of the file) */
    Real *length;   /* (points of the file) [m] of the longest line there */
    Real *lost;     /* (3 count, 3 count + SIX) forces by moves of points, then of the body */
    Real *feedback; /* (SIX, 3 count) force and moment on a body by moves of points */
} BodyPoints;

/* An end of a line: on the body that moves, on the one whose force is asked for, which may be the
 * same, or at a point that follows. */
typedef struct MovedEnd {
    bool is_on, counts;
    int follower;     /* or STAYS */
    Real map[3][SIX]; /* by the moves of the body that it is on */
} MovedEnd;

/* Those of body k. False: no memory, or what holds one is not known here. Close it in any case. */
bool body_points_open(const StiffnessStep *step, size_t k, BodyPoints *points);
void body_points_close(BodyPoints *points); /* accepts a zeroed struct */

/* Add a line, of which ends[to][from] is what the forces of its ends lose by their moves; what the
 * body loses by its own goes into `stiffness`. */
void body_points_add(BodyPoints *points, Real ends[SIX][SIX], const MovedEnd end[2],
                     Real stiffness[SIX * SIX]);
/* Add what the body loses since the points follow. False where that is not known. */
bool body_points_finish(const StiffnessStep *step, BodyPoints *points, Real stiffness[SIX * SIX]);

#endif
