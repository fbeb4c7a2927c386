/* SPDX-License-Identifier: BSD-3-Clause */
/* Sets to which ends of a line, or points, are held: rails, half-spaces, balls, discs and boxes,
 * and any bounded set in conic form. A set K does a force r on the end at x in K, and is perfect:
 * r.(y - x) >= 0 for all y in K. */
#ifndef CAPSTAN_CHECKER_SETS_H
#define CAPSTAN_CHECKER_SETS_H

#include "record.h"

/* Memory for what a file has; none of a line without such ends. All return 0, or -1 and the reason
 * in the log. */
int sets_create(const Source *source, const char *line, Record *record, FILE *log);
int sets_read(const Source *source, const char *line, size_t step, Record *record, FILE *log);
void sets_free(Record *record);
/* The conic form of the set of end e relative to its point, or NULL. */
const struct Conic *sets_form(const Record *r, int e);

/* [N] Add the reaction on node j to `sum`; and its size. */
Real sets_add(const Record *r, size_t j, Real *sum);
/* [J] What small conic programs leave of the gaps of sets in conic form. */
double sets_rounding(const Record *r);
/* [J] sup over y in K of -r.(y - x) at node j; 0 where there is none. */
Real sets_gap(const Record *r, size_t j);

/* What a step contradicts, one sentence each. */
typedef void SetFind(void *user, const char *what, double said, double expected);
void sets_check(const Record *r, SetFind *find, void *user);

/* What the proof that a set is out of reach contradicts, coordinates being of the size `reach` [m].
 */
void sets_check_infeasible(const Source *source, const Record *r, double reach, SetFind *find,
                           void *user);
/* Do all sets let the line go along the proof for ever? */
bool sets_let(const Record *r);

/* The same of points; NULL where the file has none. *bad: -1, and the reason in the log. */
typedef struct PointSets PointSets;
PointSets *point_sets_open(const Source *source, int *bad, FILE *log);
int point_sets_read(const Source *source, size_t step, PointSets *sets, FILE *log);
void point_sets_free(PointSets *sets);
bool point_sets_has(const PointSets *sets, size_t k);
const struct Conic *point_sets_form(const PointSets *sets, size_t k);
/* Add the reaction on point k to `sum` [N]. */
void point_sets_add(const PointSets *sets, size_t k, Real *sum);
/* What a step contradicts at point k, which is at x and has lines of a `length` [m]: is it in its
 * set, which bears along its normals there? */
void point_sets_check(const PointSets *sets, size_t k, const double *x, double length,
                      SetFind *find, void *user);

#endif
