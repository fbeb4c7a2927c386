/* SPDX-License-Identifier: BSD-3-Clause */
/* Whether an inextensible line is too short to reach round an obstacle. */
#ifndef CAPSTAN_CHECKER_REACH_H
#define CAPSTAN_CHECKER_REACH_H

#include "record.h"

/* What contradicts the claim that the line of the record does not reach round obstacle
 * record->proof_obstacle, or NULL; then *missing is by how much [m] and *off how far the proof
 * vector is from the direction in which the shortest path leaves end A. `statics`: the line comes
 * from no side. */
const char *reach_contradiction(const Source *source, const Record *record, bool statics,
                                double *missing, double *off);

#endif
