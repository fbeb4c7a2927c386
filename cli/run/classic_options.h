/* SPDX-License-Identifier: BSD-3-Clause */
/* The four parameters of the method of 1990 on the command line: --h, --lambda, --n, --delta. */
#ifndef CAPSTAN_CLI_RUN_CLASSIC_OPTIONS_H
#define CAPSTAN_CLI_RUN_CLASSIC_OPTIONS_H

#include "capstan/classic.h"
#include "options.h"

/* Those given; NaN: the method's own. */
typedef struct ClassicOptions {
    double h, penalty, stiffness, delta;
} ClassicOptions;

/* False after a message of `command`. */
bool classic_options_read(const CliOptions *options, const char *command, ClassicOptions *out);
/* Is any of the four given? */
bool classic_options_given(const CliOptions *options);
/* Those of the method, but for the ones given. */
CpsClassicParameters classic_options_apply(const ClassicOptions *given, const CpsClassic *classic);

#endif
