/* SPDX-License-Identifier: BSD-3-Clause */
/* What the Python package adds to the public headers in C: loops over many directions or points,
 * and a watch that lets Python see its signals while a step is under way. Its declarations are read
 * by declare.py as those of the public headers are. */
#ifndef CAPSTAN_PYTHON_NATIVE_H
#define CAPSTAN_PYTHON_NATIVE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "capstan/evolve.h"
#include "capstan/law.h"
#include "capstan/set.h"

/* Answers of cps_set_support for many directions.
 *
 *   direction (count, n), one after the other
 *   point     (count, n) out, or NULL
 *   value, gap (count) out
 *   outcome   (count) out: CpsSetOutcome
 *
 * Returns CPS_OK, or the first error; what is behind it is not written then. */
CpsStatus capstan_support_many(const CpsSet *set, int64_t count, const double *direction,
                               double *point, double *value, double *gap, int *outcome,
                               CpsError *err);

/* The same of cps_set_project, without a metric; `value` is the distance. */
CpsStatus capstan_project_many(const CpsSet *set, int64_t count, const double *from,
                               double *nearest, double *value, double *gap, int *outcome,
                               CpsError *err);

/* The same of cps_set_contains; `value` is the margin. */
CpsStatus capstan_contains_many(const CpsSet *set, int64_t count, const double *point,
                                double *separating, double *value, double *gap, int *outcome,
                                CpsError *err);

/* The same of cps_set_gauge. */
CpsStatus capstan_gauge_many(const CpsSet *set, int64_t count, const double *point, double *none,
                             double *value, double *gap, int *outcome, CpsError *err);

/* The same of cps_set_dissipation: velocities, and forces out. */
CpsStatus capstan_dissipation_many(const CpsSet *set, int64_t count, const double *velocity,
                                   double *force, double *value, double *gap, int *outcome,
                                   CpsError *err);

/* Asked by a step in each iteration. A twentieth of a second after the last time it asks Python,
 * which then runs its handlers of signals. */
typedef struct CapstanWatch {
    int64_t asked_at; /* [ns] of the monotonic clock */
    int stopped;
} CapstanWatch;

void capstan_watch_begin(CapstanWatch *watch);
CpsStatus capstan_watch_evolution(CapstanWatch *watch, CpsEvolution *evolution, CpsError *err);
bool capstan_watch_asked(void *watch);

/* Python: whether a handler of a signal has raised an exception. */
extern int capstan_python_asked(void *watch);

#endif
