/* SPDX-License-Identifier: BSD-3-Clause */
/* How far a run has come: a bar on a terminal, a line per tenth elsewhere, nothing when quiet. All
 * on standard error. */
#ifndef CAPSTAN_CLI_PROGRESS_H
#define CAPSTAN_CLI_PROGRESS_H

#include <stdbool.h>

#include "capstan/scene.h"

typedef struct Progress {
    bool quiet, terminal;
    int steps;
    int tenths;   /* last one reported */
    double begun; /* [s] */
    double drawn; /* [s] when the bar was last drawn */
} Progress;

/* Monotonic time [s]. */
double cli_now(void);

/* Is step `index` of `steps` a row of the table? A long history is shown by its first step and the
 * last ones of its stages. */
bool cli_is_shown(const CpsScene *scene, int steps, int index);

Progress progress_begin(int steps, bool quiet);
void progress_step(Progress *progress, int done, const char *name);
/* Take the bar away. */
void progress_end(Progress *progress);

#endif
