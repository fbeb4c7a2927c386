/* SPDX-License-Identifier: BSD-3-Clause */
/* What the lines of a body oppose to its offset, and where it is with each of them missing. */
#ifndef CAPSTAN_CLI_OFFSET_OFFSET_RUN_H
#define CAPSTAN_CLI_OFFSET_OFFSET_RUN_H

#include "capstan/failure.h"
#include "capstan/offset.h"

/* Take all steps of the history of `scene`; false, with the outcome in *worst, where one is not
 * certified. Returns the evolution, which the caller destroys; NULL after an error or a signal. */
CpsEvolution *offset_begin(const CpsScene *scene, CpsOutcome *worst, CpsError *err);

/* Move the body from where it is after the history along a heading [degrees], to `to` [m] in
 * `steps` equal steps and back in as many; `place` takes 2 steps + 1 places, of which *count are
 * filled: an offset that cannot be reached is the last one of its way out, and the body goes back
 * from the one before. The evolution is as before afterwards. */
CpsStatus offset_curve(CpsEvolution *evolution, int body, double heading, double to, int steps,
                       CpsOffsetPlace *place, int *count, CpsError *err);

/* The body and the lines after the history of `scene`. */
void offset_case(const CpsScene *scene, const CpsEvolution *evolution, int body,
                 CpsOffsetCase *out);

#endif
