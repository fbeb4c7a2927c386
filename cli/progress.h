/* SPDX-License-Identifier: BSD-3-Clause */
/* How far a run has come: a bar on a terminal, a line per tenth elsewhere, nothing when quiet. All on standard
 * error. */
#ifndef CAPSTAN_CLI_PROGRESS_H
#define CAPSTAN_CLI_PROGRESS_H

#include <stdbool.h>
#include <stdio.h>

typedef struct Progress {
    bool quiet, terminal;
    int steps;
    int tenths;   /* last one reported */
    double begun; /* [s] */
    double drawn; /* [s] when the bar was last drawn */
} Progress;

/* Monotonic time [s]. */
double cli_now(void);

/* Text from a scene file with control characters replaced, so that it cannot steer a terminal; at most `width`
 * characters, padded to it when pad is set. */
void cli_put_text(FILE *out, const char *text, int width, bool pad);

Progress progress_begin(int steps, bool quiet);
void progress_step(Progress *progress, int done, const char *name);
/* Take the bar away. */
void progress_end(Progress *progress);

#endif
