/* SPDX-License-Identifier: BSD-3-Clause */
/* The independent checker: reads a result.nc and recomputes every residual of every step of every
 * line.
 *
 * It shares no code and no header with the solver or the writer: own reader, own arithmetic (long
 * double, compensated sums). What it knows is docs/results.md (the file) and docs/theory.md (the
 * step problem). Only given.c, which compares the file with a scene, reads that scene with the
 * library. */
#ifndef CAPSTAN_CHECKER_H
#define CAPSTAN_CHECKER_H

#include <stdio.h>

#include "events.h"

/* A record is one step of one line. */
typedef struct CheckerReport {
    int records;        /* in the file */
    int certified;      /* solved, taut, infeasible or unbounded, and confirmed */
    int uncertified;    /* said by the file itself not to be certified */
    int refuted;        /* where something claimed is contradicted or a number is missing */
    int not_finite;     /* with a NaN or an infinity where there must be a number */
    int outcome[9];     /* records by claimed outcome, in the file's numbering */
    int steps;          /* length of the file's unlimited dimension */
    double gap;         /* worst sum of local gaps / scale of the records claimed solved */
    double force;       /* worst imbalance / largest force of the same */
    double stretch;     /* worst |x'| - 1 of inextensible elements of the same */
    double penetration; /* worst depth / length of the same */
    Events events;      /* of all lines in time */
} CheckerReport;

/* Check a file.
 *
 *   worst   NULL accepted
 *   log     one sentence per finding; NULL accepted
 *
 * Returns 0 when nothing is refuted and all is certified, 1 when a record is refuted or not
 * certified, 2 when the file cannot be read as a result file (worst->refuted is 1 then). */
int checker_file(const char *path, CheckerReport *worst, FILE *log);

#endif
