/* SPDX-License-Identifier: BSD-3-Clause */
/* The energy of a history in time, summed over its steps. */
#ifndef CAPSTAN_CLI_RUN_ENERGY_H
#define CAPSTAN_CLI_RUN_ENERGY_H

#include <stdio.h>

#include "capstan/evolve.h"

typedef struct Energy {
    CpsLedger sum;
    CpsMotionLedger motion;
    bool in_time; /* a step had a duration */
} Energy;

void energy_note_step(Energy *energy, const CpsEvolution *evolution);

/* What went in, where it went, and what the entries, each of which has a formula of its own, leave
 * over; nothing of a history that is not in time. */
void energy_print(const Energy *energy, FILE *out);

#endif
