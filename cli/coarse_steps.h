/* SPDX-License-Identifier: BSD-3-Clause */
/* Entries in time whose steps are too long for what they impose: such motions are not seen, or seen
 * as others. */
#ifndef CAPSTAN_CLI_COARSE_STEPS_H
#define CAPSTAN_CLI_COARSE_STEPS_H

#include "capstan/evolve.h"

/* Print a warning on standard error for each kind, of the entry that is the worst. */
void coarse_steps_warn(const CpsScene *scene);

#endif
