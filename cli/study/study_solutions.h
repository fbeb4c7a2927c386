/* SPDX-License-Identifier: BSD-3-Clause */
/* All solutions of a step (S90 results 4.3, 4.4, theorem 6.3): its slack, the judgement of
 * configurations, completions. */
#ifndef CAPSTAN_CLI_STUDY_STUDY_SOLUTIONS_H
#define CAPSTAN_CLI_STUDY_STUDY_SOLUTIONS_H

#include "capstan/evolve.h"

/* The completion of this name; CPS_COMPLETION_COUNT after a message where there is none. */
CpsCompletion study_find_completion(const char *name);

/* The tolerance of judgements from its text, 1e-8 for NULL; NaN after a message where the text is
 * not a tolerance. */
double study_find_tolerance(const char *text);

/* Print the slack parts with what holds them, and the judgements of the computed configuration and
 * of a meander. */
void study_print_slack(const CpsLineView *view, double tolerance);

/* Judge the configuration of a CSV file: x,y,z or arc_length,x,y,z in a row per node, after rows of
 * names and units. Returns EXIT_OK where it is a solution of P3.1, else EXIT_NOT_CERTIFIED. */
int study_judge(const CpsLineView *view, const char *path, double tolerance, bool quiet);

/* Lay out the slack and write completed.csv and completed.svg. Returns the exit code;
 * EXIT_NOT_CERTIFIED where the configuration written is not a solution of P3.1. */
int study_complete(const CpsLineView *view, CpsCompletion how, double tolerance, const char *title,
                   const char *directory, bool quiet);

#endif
