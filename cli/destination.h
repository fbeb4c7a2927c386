/* SPDX-License-Identifier: BSD-3-Clause */
/* Where a command writes its results. */
#ifndef CAPSTAN_CLI_DESTINATION_H
#define CAPSTAN_CLI_DESTINATION_H

#include "options.h"

/* The directory given with -o, else results/NAME and `more` for a scene .../NAME.yaml, whose parent
 * is made. One that capstan may not write to is refused before anything is computed. NULL after a
 * message, with the exit code in *code; the caller frees it. */
char *cli_destination(const CliOptions *options, const char *more, int *code);

#endif
