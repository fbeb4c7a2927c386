/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan law --plot: the picture of a law as a file that is written completely or not at all. */
#ifndef CAPSTAN_CLI_PLOT_FILE_H
#define CAPSTAN_CLI_PLOT_FILE_H

#include "capstan/results.h"

/* Two components "I,J", from 1, of n; NULL: the first two, or the only one. False where there is no
 * such pair. */
bool law_plot_axes(const char *text, int n, int axis[2]);

/* Draw to `path` as cps_write_file does. Returns EXIT_OK, or another exit code after a message on
 * standard error. */
int cli_plot(CpsFileWriter *draw, void *user, const char *path);

/* The same for the picture of a friction law, or where `set` is NULL of a resistance law. */
int law_plot(const CpsSet *set, const CpsResistance *resistance, const CpsLawPicture *picture,
             const char *path);

#endif
