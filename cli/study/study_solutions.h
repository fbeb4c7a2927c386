/* SPDX-License-Identifier: BSD-3-Clause */
/* All solutions of a step (S90 results 4.3, 4.4, theorem 6.3): its slack, configurations judged,
 * slack laid out. */
#ifndef CAPSTAN_CLI_STUDY_STUDY_SOLUTIONS_H
#define CAPSTAN_CLI_STUDY_STUDY_SOLUTIONS_H

#include "capstan/evolve.h"

/* The completion of this name; CPS_COMPLETION_COUNT after a message where there is none. */
CpsCompletion study_find_completion(const char *name);

/* The tolerance of judgements from its text, 1e-8 for NULL; NaN after a message where it is
 * none. */
double study_find_tolerance(const char *text);

/* Print the slack parts with what holds them, and how the configuration found and a meander are
 * judged. */
void study_tell_slack(const CpsLineView *view, double tolerance);

/* Judge the configuration of a CSV file: x,y,z or arc_length,x,y,z in a row per node, after rows of
 * names and units. Returns EXIT_OK where it is a solution of P3.1, EXIT_NOT_CERTIFIED where it is
 * none. */
int study_judge(const CpsLineView *view, const char *path, double tolerance, bool quiet);

/* Lay the slack out and write completed.csv and completed.svg. Returns the exit code;
 * EXIT_NOT_CERTIFIED where the configuration written is no solution of P3.1. */
int study_complete(const CpsLineView *view, CpsCompletion how, double tolerance, const char *title,
                   const char *directory, bool quiet);

#endif
