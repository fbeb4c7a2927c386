/* SPDX-License-Identifier: BSD-3-Clause */
/* Random numbers of a case (splitmix.h), and calls that must work, for the property tests of laws
 * and systems. */
#ifndef CAPSTAN_TEST_RANDOM_CASE_H
#define CAPSTAN_TEST_RANDOM_CASE_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "capstan/base.h"
#include "splitmix.h"

/* The stream, and the number of the case that messages give. */
extern uint64_t state, seed;

static inline double uniform(double low, double high) { return splitmix(&state, low, high); }

static inline int below(int bound) { return (int)uniform(0, bound); }

/* from -most to most */
static inline int digit(int most) { return below(2 * most + 1) - most; }

extern CpsError err;

static inline void need(CpsStatus status, const char *call) {
    if (status == CPS_OK) return;
    fprintf(stderr, "seed %llu: %s: %s\n", (unsigned long long)seed, call, err.message);
    exit(1);
}

#endif
