/* SPDX-License-Identifier: BSD-3-Clause */
/* The ranges of tensions that a record claims, compared with those of rest.c. */
#ifndef CAPSTAN_CHECKER_RANGES_H
#define CAPSTAN_CHECKER_RANGES_H

#include "record.h"

/* What is wrong with the claimed range of end e (0: A, 1: B), in `text` of `size`; false: nothing.
 * `force`: the largest [N].
 *
 * Of an elastic line there is none; of others it holds the tension found, agrees with its own
 * bounds, and where the line is short, its friction isotropic, and its places leave no doubt about
 * what is taut and what slips, with the program of rest.h. */
bool range_is_wrong(const Source *source, const Record *record, int e, double force, char *text,
                    size_t size);

/* The share of the tension of an inextensible line to which its places tell it; 0: it is straight.
 */
double tension_told(const Record *record);

#endif
