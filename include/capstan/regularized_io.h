/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/regularized_io.h: a study of the 1990 method as files and pictures.
 *     (library capstan-io) */
#ifndef CAPSTAN_CLASSIC_IO_H
#define CAPSTAN_CLASSIC_IO_H

#include <stdio.h>

#include "capstan/io.h"
#include "capstan/regularized.h"
#include "capstan/solutions.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What belongs together in one directory. */
typedef struct CpsStudyFiles {
    const char *title; /* of the pictures */
    const CpsRegularized *classic;
    const CpsStudy *study;
    const CpsFirstOrder *first_order;
} CpsStudyFiles;

/* Write study.csv, study.svg (tensions and errors on the way to the limits), first-order.csv and
 * first-order.svg (P10.1 beside P2.1), relaxed.svg (J and J** of S90 remark 4.6.1), and study.json,
 * the title and the list of the others with sizes and checksums, into `directory`, made if missing
 * (one level). All appear whole and together, or not at all; where they replace others study.json
 * is removed first and comes last (cps_results_missing).
 *
 * Returns CPS_OK, CPS_ERR_ARGUMENT, CPS_ERR_IO or CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_study_write(const char *directory, const CpsStudyFiles *files, CpsError *err);

/* Configurations that a method has gone through. */
typedef struct CpsMethodHistory {
    const char *name;
    const double *position; /* (steps, points, 3) [m] */
} CpsMethodHistory;

/* Write methods.csv (where end B is after each step, and how far each method is from the first
 * one), methods.svg (plan and elevation of all steps, a column per method) and methods.json (the
 * list) into `directory`, as cps_study_write.
 *
 *   methods    1..4 of them; steps >= 1, points >= 2 are the same for all
 *   step_name  (steps) */
CPS_API CpsStatus cps_methods_write(const char *directory, const char *title, int methods,
                                    const CpsMethodHistory *method, int steps, int points,
                                    const char *const *step_name, CpsError *err);

/* A step with its slack laid out in every way (solutions.h). */
typedef struct CpsCompletedLine {
    const char *title;
    const CpsLineView *view;
    const double *position[CPS_COMPLETIONS]; /* (elements + 1, 3) [m] each */
    CpsCompletion chosen;
} CpsCompletedLine;

/* Write completed.csv (the chosen one, a row per node), completed.svg (the longest loose part in
 * plan: as found, and laid out in each way) and completed.json (the list) into `directory`, as
 * cps_study_write. */
CPS_API CpsStatus cps_completed_write(const char *directory, const CpsCompletedLine *line,
                                      CpsError *err);

/* A history of the regularised method by itself. */
typedef struct CpsRegularizedLine {
    const char *name;
    int points;
    const double *position;                     /* (steps, points, 3) [m]; step 0 is the start */
    const CpsRegularizedParameters *parameters; /* (steps); of the start: not used, as below */
    /* (steps) errors are against the exact step with frozen friction */
    const CpsRegularizedReport *report;
    const double *tension; /* (steps, 2) [N] in the first and in the last element */
} CpsRegularizedLine;

typedef struct CpsRegularizedRun {
    const char *title;
    int steps, lines;
    const char *const *step_name;
    const CpsRegularizedLine *line;
    bool complete; /* no step of the history is missing */
    double wall;   /* [s] */
} CpsRegularizedRun;

/* Write history.csv (a row per step and line: parameters, energies, what the parameters leave,
 * ends), summary.json, and line-1.svg, line-2.svg, .. (plan and elevation of all steps of a line)
 * into `directory`, as cps_study_write. There is no certificate: the summary says so. */
CPS_API CpsStatus cps_regularized_write(const char *directory, const CpsRegularizedRun *run,
                                        CpsError *err);

/* summary.json alone, on a stream. */
CPS_API CpsStatus cps_regularized_summary(const CpsRegularizedRun *run, FILE *out, CpsError *err);

#ifdef __cplusplus
}
#endif
#endif
