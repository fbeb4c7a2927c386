/* SPDX-License-Identifier: BSD-3-Clause */
/* Progress of a run: a bar on a terminal, a line per tenth elsewhere, nothing when quiet. All on
 * standard error. */
#ifndef CAPSTAN_CLI_PROGRESS_H
#define CAPSTAN_CLI_PROGRESS_H

#include <stdbool.h>

#include "capstan/scene.h"

typedef struct Progress {
    bool quiet, terminal;
    int steps;
    int tenths;   /* number of tenths already reported */
    double begun; /* [s] beginning of the run */
    /* of a history in time, see progress_in_time; `end` 0: of none */
    double end, time, interval; /* [s] simulated: whole history, so far, length of the last step */
    int known;                  /* steps that were not computed by this program */
    double computing;           /* [s] when it began to compute */
    double drawn;               /* [s] when the bar was last drawn */
} Progress;

/* Monotonic time [s]. */
double cli_now(void);

/* Do steps of the scene have the lengths that an error allows? How many there are is known when the
 * last one has been taken. */
bool cli_has_pace(const CpsScene *scene);

/* Whether step `index` of `steps` is a row of the table. A long history is shown by its first step
 * and the last step of each stage. */
bool cli_is_shown(const CpsScene *scene, int steps, int index);

Progress progress_begin(int steps, bool quiet);
/* A history in time, of so many simulated seconds in all: each progress_step is preceded by
 * progress_time, and progress_computes is called after the steps that are only read back. The time
 * remaining is that which the steps to come take if they take as long as those computed so far. */
void progress_in_time(Progress *progress, double end);
void progress_time(Progress *progress, double time);
void progress_computes(Progress *progress, int known);
void progress_step(Progress *progress, int done, const char *name);
/* Remove the bar. */
void progress_end(Progress *progress);

#endif
