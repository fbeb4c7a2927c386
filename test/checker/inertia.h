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
/* The energy of inertia, |x - x* - k v*|^2 K/2 with K = m/k^2, and its part of the gap: it takes
 * what the other forces leave at a node that is not held, by r^2/(2 K). */
typedef struct Inertia {
    Real energy, gap;        /* [J] */
    Real force[3], taken[3]; /* [N] at the position, and as it is in balance */
} Inertia;
/* ... of node j, on which the others leave `pull`; it becomes what is left then, 0 where the node
 * is not held. False in a step that is not one in time. */
bool inertia_terms(const Record *r, size_t j, bool held, Real *pull, Inertia *out);

/* [N] What rounding of its places leaves of the force of inertia at end e. */
double inertia_rounding(const Record *r, int e);

/* The part of the vector v across the normals of the contacts at which node j bears by more than
 * `faint` [N], up to two, which may have any angle; what gives stops no node. */
void inertia_across(const Source *source, const Record *r, size_t j, double faint, Real *v);

/* What a step in time contradicts, one sentence each; `before` and `older` are the two steps before
 * it, NULL where there are none. */
typedef void InertiaFind(void *user, const char *what, double said, double expected);
/* Whether the times of all steps are sums of their lengths. */
void inertia_times(const Source *source, InertiaFind *find, void *user);
void inertia_check(const Source *source, const Record *r, const Record *before, const Record *older,
                   InertiaFind *find, void *user);

#endif
