/* SPDX-License-Identifier: BSD-3-Clause */
/* The commands of `capstan`: each takes its own argc, argv (argv[0] is the command's name) and
 * returns the exit code. To add one: write cli/cmd_NAME.c, declare it here, add a row to COMMANDS
 * in main.c. */
#ifndef CAPSTAN_CLI_COMMANDS_H
#define CAPSTAN_CLI_COMMANDS_H

#include "capstan/base.h"

/* Exit codes of every command; 128 + signal number after a signal. */
enum {
    EXIT_OK = 0,            /* done; run: solved and certified */
    EXIT_NOT_CERTIFIED = 1, /* ran, but a step is not certified */
    EXIT_USAGE = 2,         /* the command line is wrong */
    EXIT_INPUT = 3,         /* the scene is wrong; the message says file:line:column */
    EXIT_IO = 4,            /* a file cannot be read or written */
    EXIT_NO_SOLUTION = 5,   /* infeasible or unbounded, with its proof */
    EXIT_LIMIT = 6          /* out of memory, or over a limit */
};

int cmd_run(int argc, char **argv);
int cmd_check(int argc, char **argv);
int cmd_schema(int argc, char **argv);
int cmd_law(int argc, char **argv);
int cmd_drive(int argc, char **argv);
int cmd_study(int argc, char **argv);
int cmd_offset(int argc, char **argv);

/* Print "capstan: FILE:LINE:COLUMN: message" on standard error; returns the exit code of the
 * error's status. */
int cli_report(const CpsError *err);

#endif
