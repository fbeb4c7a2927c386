/* SPDX-License-Identifier: BSD-3-Clause */
/* Where an obstacle has taken what the slip of a line is measured from. */
#ifndef CAPSTAN_CHECKER_CARRIED_H
#define CAPSTAN_CHECKER_CARRIED_H

#include "record.h"

/* Note in a record where its nodes were before; the two steps before it, NULL: not in the file. */
void carried_begin(Record *r, const Record *before, const Record *older);

/* Of the point at the share t of the way from node i to the next; t = 0: of the node. `turn`: of
 * the obstacle about its own axis, which does not take it along unless `about_own`. */
void carried_point(const Record *r, const Surface *on, Real turn, bool about_own, size_t i, Real t,
                   Real *out);

#endif
