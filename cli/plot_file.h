/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan law --plot: the picture of a law as a file that appears whole or not at all. */
#ifndef CAPSTAN_CLI_PLOT_FILE_H
#define CAPSTAN_CLI_PLOT_FILE_H

#include "capstan/results.h"

/* Two components "I,J", from 1, of n; NULL: the first two, or the one that there is. False: no such
 * pair. */
bool law_plot_axes(const char *text, int n, int axis[2]);

/* Draws to an open file. */
typedef CpsStatus PlotDraw(void *user, FILE *out, CpsError *err);

/* Draw to `path`. A regular file is written beside its place and renamed, so that a failure leaves
 * what was there; into a device or pipe it is written straight. Returns EXIT_OK, or another exit
 * code after a message on standard error. */
int cli_plot(PlotDraw *draw, void *user, const char *path);

/* The same for the picture of a friction law, or where `set` is NULL of a resistance. */
int law_plot(const CpsSet *set, const CpsResistance *resistance, const CpsLawPicture *picture,
             const char *path);

#endif
