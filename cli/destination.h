/* SPDX-License-Identifier: BSD-3-Clause */
/* The directory of a command's results. */
#ifndef CAPSTAN_CLI_DESTINATION_H
#define CAPSTAN_CLI_DESTINATION_H

#include "capstan/results.h"
#include "options.h"

/* The directory given with -o; otherwise results/NAME, with -regularized, -offset or -study
 * appended for such results, for a scene .../NAME.yaml of so many lines, whose parent is made. A
 * directory that capstan may not write to is refused before anything is computed. Returns NULL
 * after a message, with the exit code in *code; the caller frees the name. */
char *cli_destination(const CliOptions *options, CpsResultsKind kind, int line_count, int *code);

#endif
