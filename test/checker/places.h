/* SPDX-License-Identifier: BSD-3-Clause */
/* Obstacles that are shifted: where they are after a step, and what their reactions work. */
#ifndef CAPSTAN_CHECKER_PLACES_H
#define CAPSTAN_CHECKER_PLACES_H

#include "record.h"

/* Memory for the places of a source, which has just read its obstacles. Both return 0, or -1 after
 * one sentence on log. */
int places_open(Source *source, FILE *log);
/* Put the obstacles of the source where they are at the end of a step, by the shifts on file from
 * their start; the places on file must be these. */
int places_at(const Source *source, size_t step, FILE *log);
void places_close(Source *source);

/* [J] The work of the reactions in a step of one part, of which `before` is the step before or
 * NULL: on what the shifts move where the nodes are then, the mean of before and after; where the
 * line comes to rest that after, for before there was no equilibrium. */
Real places_work(const Source *source, const Record *r, const Record *before);

/* The reaction that contact c of node j had in the step before, 0 if it was none: it may have been
 * another contact of the node, of which the third is that of the element before it, at its end. Of
 * several contacts with one mesh the largest goes with the largest friction bound, and so on: they
 * may have followed the mesh to other faces. */
double places_reaction_on(const Record *before, const Record *r, size_t j, size_t c);

#endif
