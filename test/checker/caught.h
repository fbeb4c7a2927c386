/* SPDX-License-Identifier: BSD-3-Clause */
/* Whether an inextensible line cannot follow its ends because it lies between a ball and a plane.
 */
#ifndef CAPSTAN_CHECKER_CAUGHT_H
#define CAPSTAN_CHECKER_CAUGHT_H

#include "record.h"

/* What contradicts the claim that no motion of the line from record->reference takes its ends
 * straight to their places, or NULL; then *missing is by how much [m] the line is too short there
 * to go between ball and plane. */
const char *caught_contradiction(const Source *source, const Record *record, double *missing);

#endif
