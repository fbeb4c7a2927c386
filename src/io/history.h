/* SPDX-License-Identifier: BSD-3-Clause */
/* What the writers of results and the pictures share: the history so far in numbers, and sampled
 * shapes for the pictures.
 *
 * Fields go to files step by step; memory keeps one row of reports per step and at most about sixty
 * sampled shapes, so it does not grow with the number of nodes. */
#ifndef CAPSTAN_SRC_IO_HISTORY_H
#define CAPSTAN_SRC_IO_HISTORY_H

#include <locale.h>
#include <stdbool.h>

#include "capstan/results.h"
#include "io/base/write_directory.h"

typedef struct CpsiNetcdf CpsiNetcdf;

typedef struct CpsiLineRow {
    CpsLineReport report;
    bool held[2];         /* was the position of this end imposed? */
    double open_reaction; /* [N] largest reaction on a node that does not touch */
} CpsiLineRow;

typedef struct CpsiRow {
    CpsStepReport report; /* its name is `name` */
    char *name;
    double open_reaction; /* [N] largest over the lines */
    CpsiLineRow *line;
} CpsiRow;

/* Beside CpsNodeState: touches nothing, and has friction all the same. */
enum { CPSI_SHAPE_IN_AIR = 3 };

/* A line at one step, thinned to a number of points that a picture can show. */
typedef struct CpsiShape {
    int points;
    double *abscissa;     /* (points) [m] */
    double *position;     /* (points, 3) [m] */
    double *reference;    /* (points, 3) [m] where the step started */
    double *tension;      /* (points - 1) [N] mean over the elements between two points */
    unsigned char *state; /* (points) CpsNodeState, or CPSI_SHAPE_IN_AIR */
} CpsiShape;

typedef struct CpsiSnapshot {
    int step;         /* index of its row */
    CpsiShape *shape; /* one per line, owning a single block of memory */
} CpsiSnapshot;

/* The steps first..last (inclusive) that make up an entry of the history. */
typedef struct CpsiStage {
    char *name;
    int first, last;
    double *turn; /* (obstacle_count) [rad] by which each turns in one load step */
} CpsiStage;

struct CpsResults {
    CpsiDirectory *directory;
    CpsiNetcdf *netcdf;
    locale_t locale; /* "C": numbers are written with a point whatever the program's locale */
    bool paraview;   /* .vtp and .pvd files are written */
    bool failed;     /* a call has failed: nothing may be committed any more */

    char *title; /* "" when the scene has none */
    double gravity[3];
    double origin[3]; /* [m] that of the views */
    int obstacle_count;
    CpsObstacle *obstacle; /* (obstacle_count), without names and friction sets, about the origin of
                              the views */
    int line_count;
    char **line_name;
    double *line_length; /* [m] */
    int *line_elements;
    int stage_count;
    CpsiStage *stage;
    int planned_steps;

    int row_count, row_capacity;
    CpsiRow *row;
    int snapshot_count, snapshot_capacity;
    CpsiSnapshot *snapshot;
};

/* Is this step among those that get their own plan view and elevation? All of a short history; of a
 * long one the ends of its stages, or an even selection, and always the first and the last step. */
bool cpsi_results_pictured(const CpsResults *results, int step);

/* [rad] By how much an obstacle turns in one step; and since the start, when that step is over. */
double cpsi_results_turn(const CpsResults *results, int step, int obstacle);
double cpsi_results_turned(const CpsResults *results, int step, int obstacle);

/* Worst outcome so far. */
CpsOutcome cpsi_results_outcome(const CpsResults *results);

/* How node j rests, the stronger of its contacts: where it slides on one obstacle it slides. */
static inline unsigned char cpsi_node_state(const CpsLineView *view, int j) {
    const unsigned char state = view->state[j],
                        other = view->contacts > 1 ? view->state[view->elements + 1 + j] : 0;
    return other > state ? other : state;
}

#endif
