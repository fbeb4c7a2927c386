/* SPDX-License-Identifier: BSD-3-Clause */
/* Points where lines meet, recomputed from a file (docs/results.md, docs/theory.md 6d). */
#ifndef CAPSTAN_CHECKER_POINTS_H
#define CAPSTAN_CHECKER_POINTS_H

#include "record.h"

/* Called with one sentence for each finding; `name` is that of the point. */
typedef void PointFinding(void *user, const char *name, size_t step, const char *sentence);

/* Check the points of all steps: the forces of the lines' ends, the balance, contact and friction,
 * and what is claimed of them. `certified(outcome)`: does a line of this outcome claim to be
 * certified? Returns 0, or -1 after one sentence on log. */
int points_check(const Source *source, bool (*certified)(int outcome), PointFinding *find,
                 void *user, FILE *log);

/* [N] With what a balance at the ends of a line may be compared: the largest force in an elastic
 * line, the loads of an inextensible one, whose tension may have no bound. */
double acts_in_line(const Record *line);
/* [N] What rounding of the places of nodes leaves of its tensions. */
double rounding_in_line(const Record *line);

#endif
