/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan law: velocities and forces from the command line, or as CSV from standard input. */
#ifndef CAPSTAN_CLI_LAW_LAW_QUERY_H
#define CAPSTAN_CLI_LAW_LAW_QUERY_H

#include "commands.h"
#include "options.h"

/* Rows of n numbers. */
typedef struct QueryList {
    const char *command; /* name in messages */
    int n, count, capacity;
    double *row; /* (count x n) */
} QueryList;

/* Check that standard input is requested at most once, by the law file or one of the options.
 * Returns EXIT_OK, or EXIT_USAGE after a message. */
int law_query_check_input(const char *command, const char *file, const CliList *velocity,
                          const CliList *force);

/* Add the arguments of one option, "1,2" each, or "-" for all rows of standard input.
 * Returns EXIT_OK, or another exit code after a message on standard error. */
int law_query_read(const CliList *given, const char *option, QueryList *list);

#endif
