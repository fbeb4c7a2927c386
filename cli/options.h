/* SPDX-License-Identifier: BSD-3-Clause */
/* Command-line options: one table with help texts, one parser for all commands. */
#ifndef CAPSTAN_CLI_OPTIONS_H
#define CAPSTAN_CLI_OPTIONS_H

#include <stdbool.h>
#include <stdio.h>

/* The commands that an option belongs to. */
enum {
    FOR_RUN = 1,
    FOR_CHECK = 2,
    FOR_SCHEMA = 4,
    FOR_LAW = 8,
    FOR_STUDY = 16,
    FOR_DRIVE = 32,
    FOR_OFFSET = 64,
    FOR_ALL = 127
};

/* The arguments of an option that can be repeated. */
enum { CLI_LIST_MOST = 256 };
typedef struct CliList {
    int count;
    const char *item[CLI_LIST_MOST];
} CliList;

typedef struct CliOptions {
    bool help, version;
    bool json, quiet, resume;
    bool overwrite;             /* run, study: --force, replace what is there */
    const char *output;         /* NULL: not given */
    const char *path_tolerance; /* run: path tolerance, NULL: the scene's */
    bool no_paraview;           /* run: no .vtp and .pvd files */
    bool stiffness;             /* run: stiffness.csv */
    bool out_table;             /* run: history.out */
    const char *fields;         /* run: variables of result.nc, NULL: all */
    const char *sync;           /* run: step or end, NULL: step */
    const char *threads;        /* run: number of threads, NULL: 1 */
    const char *method;         /* run: exact or regularized, NULL: exact */
    const char *operand;        /* the scene or law file, "-" for standard input; NULL: not given */
    const char *plot;           /* law: picture, NULL: none */
    const char *axes;           /* law: components drawn, NULL: the first two */
    bool history;               /* study: all steps by three methods */
    const char *complete;       /* study: how slack is laid out, NULL: not requested */
    const char *judge;          /* study: file of a configuration, NULL: none */
    const char *tolerance;      /* study: tolerance of judgements, NULL: 1e-8 */
    /* study, run: parameters of the method of 1990, NULL: its default */
    const char *delta, *lambda, *n, *h;
    const char *step; /* study: name or number of a step, NULL: the first */
    bool eliminate;   /* drive: the reduced law */
    const char *line; /* study: name of a line, NULL: the first */
    /* offset: headings in degrees, largest offset in m, number of steps, NULL: the default */
    const char *headings, *to, *steps;
    const char *body; /* offset: name of a body, NULL: the first */
    bool broken;      /* offset: with each line missing as well */
    CliList velocity, force;
} CliOptions;

/* Parse argv[1..argc-1] for one command.
 *
 *   command  a FOR_ bit: options of other commands are refused
 *   operand  required operand, "SCENE.yaml"; in brackets an optional one, "[scene|law]"; NULL:
 *            none
 *
 * Returns true; or false after a message on standard error (exit with EXIT_USAGE). With --help or
 * --version given, a missing operand is accepted. */
bool cli_parse(int argc, char **argv, unsigned command, const char *operand, CliOptions *out);

/* List the options of `commands` (FOR_ bits), one line each. */
void cli_print_options(FILE *out, unsigned commands);

#endif
