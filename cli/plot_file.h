/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan law --plot: the picture of a law as a file that is written completely or not at all. */
#ifndef CAPSTAN_CLI_PLOT_FILE_H
#define CAPSTAN_CLI_PLOT_FILE_H

#include "capstan/results.h"

/* Two components "I,J", from 1, of n; NULL: the first two, or the only one. False where there is no
 * such pair. */
bool law_plot_axes(const char *text, int n, int axis[2]);

/* A function that draws into an open file. */
typedef CpsStatus PlotDraw(void *user, FILE *out, CpsError *err);

/* Draw to `path`. A regular file is written under another name beside it and renamed, so that after
 * a failure the old file is still there; a device or pipe is written directly. Returns EXIT_OK, or
 * another exit code after a message on standard error. */
int cli_plot(PlotDraw *draw, void *user, const char *path);

/* The same for the picture of a friction law, or where `set` is NULL of a resistance law. */
int law_plot(const CpsSet *set, const CpsResistance *resistance, const CpsLawPicture *picture,
             const char *path);

#endif
