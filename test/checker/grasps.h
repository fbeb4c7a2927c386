/* SPDX-License-Identifier: BSD-3-Clause */
/* Nodes between the ends that are held or pulled, of a record. */
#ifndef CAPSTAN_CHECKER_GRASPS_H
#define CAPSTAN_CHECKER_GRASPS_H

#include <stdbool.h>
#include <stdio.h>

#include "record.h"

/* Those of a step; a line whose history grasps no node has none. Returns 0, or -1 after one
 * sentence on log. */
int grasps_read(const Source *source, const char *line, size_t step, Record *record, FILE *log);

/* Is node j held, as an end or between them? Where it is to be then. */
bool node_is_held(const Record *record, size_t j);
const double *node_place(const Record *record, size_t j);

/* [N] Take the force on a node that is pulled, and not held, off its load. */
void node_load(const Record *record, size_t j, Real *load);

/* [N] The largest difference of a force in the file from what balances its node. */
double grasps_force_error(const Record *record);

/* [J] The work of the grasps in a step, the mean of the force before and after times the way. The
 * nodes of the bits of `at_once` that are let go are without what held them from the beginning. */
Real grasps_work(const Record *record, const Record *before, unsigned at_once);

/* The span between two held nodes, next to each other, whose ends are farthest apart beyond its
 * length. False: there is none. */
typedef struct Span {
    size_t from, to;
    double length, distance; /* [m] */
} Span;
bool longest_span(const Record *record, Span *span);

#endif
