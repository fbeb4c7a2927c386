/* SPDX-License-Identifier: BSD-3-Clause */
/* The nodes of a line that are held: ends, and nodes between them that something has grasped
 * (capstan/grasp.h). They divide the line into spans. */
#ifndef CAPSTAN_SRC_CABLE_HELD_H
#define CAPSTAN_SRC_CABLE_HELD_H

#include "cable/line.h"

/* |distance - L| <= CPSI_TAUT L: an inextensible line is pulled straight, and its tension has no
 * upper bound. */
#define CPSI_TAUT 1e-12
/* The forces of such a line are computed for a line longer by this share. */
#define CPSI_TAUT_SLACK 1e-9

/* Is no node of the line held? */
bool cpsi_line_is_loose(const CpsiLine *line);

/* [m] Where the held node j is to be. */
Vec3 cpsi_line_held_place(const CpsiLine *line, int j);

/* Put the held nodes where they are to be, in the positions x (n, 3). */
void cpsi_line_put_held(const CpsiLine *line, double *x);

/* The first held node from j on; n: there is none. */
int cpsi_line_next_held(const CpsiLine *line, int j);

/* [m] Natural length from node i to node j. */
double cpsi_line_length_between(const CpsiLine *line, int i, int j);

/* Part of the line between two nodes that are held, next to each other. */
typedef struct CpsiSpan {
    int from, to;
    double length, distance; /* [m] natural length, and distance of the places of its ends */
} CpsiSpan;

/* The next span that begins at node j or beyond, j = 0 at first and then `to` of the last one.
 * False: there is none. */
bool cpsi_line_next_span(const CpsiLine *line, int j, CpsiSpan *span);

/* Is the line inextensible and the span pulled exactly straight? */
bool cpsi_line_is_span_taut(const CpsiLine *line, const CpsiSpan *span);

#endif
