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
    double drawn; /* [s] when the bar was last drawn */
} Progress;

/* Monotonic time [s]. */
double cli_now(void);

/* Whether step `index` of `steps` is a row of the table. A long history is shown by its first step
 * and the last step of each stage. */
bool cli_is_shown(const CpsScene *scene, int steps, int index);

Progress progress_begin(int steps, bool quiet);
void progress_step(Progress *progress, int done, const char *name);
/* Remove the bar. */
void progress_end(Progress *progress);

#endif
