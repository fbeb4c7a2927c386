/* SPDX-License-Identifier: BSD-3-Clause */
/* The four parameters of the method of 1990 on the command line: --h, --lambda, --n, --delta. */
#ifndef CAPSTAN_CLI_RUN_REGULARIZED_OPTIONS_H
#define CAPSTAN_CLI_RUN_REGULARIZED_OPTIONS_H

#include "capstan/regularized.h"
#include "options.h"

/* The values given; NaN: the default of the method. */
typedef struct RegularizedOptions {
    double h, penalty, stiffness, delta;
} RegularizedOptions;

/* False after a message of `command`. */
bool regularized_options_read(const CliOptions *options, const char *command,
                              RegularizedOptions *out);
/* Whether any of the four is given. */
bool regularized_options_given(const CliOptions *options);
/* The default parameters of the method, with those given replaced. */
CpsRegularizedParameters regularized_options_apply(const RegularizedOptions *given,
                                                   const CpsRegularized *regularized);

#endif
