/* SPDX-License-Identifier: BSD-3-Clause */
/* Steps in time: the inertia of the nodes, derived anew from positions, velocities and the time of
 * the file, its scheme, and the ledger with kinetic energy. */
#ifndef CAPSTAN_CHECKER_INERTIA_H
#define CAPSTAN_CHECKER_INERTIA_H

#include "record.h"

/* Memory for what a file with steps in time has of a line; none of other files. */
int inertia_create(const Source *source, const char *line, Record *record, FILE *log);
int inertia_read(const Source *source, const char *line, size_t step, Record *record, FILE *log);
void inertia_free(Record *record);

/* Is the step one in time? */
bool in_time(const Record *r);

/* [N] Add the force of inertia on node j, -m (v - v*)/k with v = (x - x*)/k, in a step in time. */
void inertia_add(const Record *r, size_t j, Real *sum);
/* [N/m] m/k^2. */
Real inertia_stiffness(const Record *r, size_t j);

/* What a step in time contradicts, one sentence each; `before` and `older` are the two steps before
 * it, NULL where there are none. */
typedef void InertiaFind(void *user, const char *what, double said, double expected);
void inertia_check(const Source *source, const Record *r, const Record *before, const Record *older,
                   InertiaFind *find, void *user);

#endif
