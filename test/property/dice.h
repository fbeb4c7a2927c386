/* SPDX-License-Identifier: BSD-3-Clause */
/* The random numbers of a test program, which sets `state` from a seed. */
#ifndef CAPSTAN_PROPERTY_DICE_H
#define CAPSTAN_PROPERTY_DICE_H

#include <math.h>
#include <stdbool.h>

#include "splitmix.h"

static uint64_t state;

static inline double uniform(double low, double high) { return splitmix(&state, low, high); }
static inline int whole(int low, int high) { return (int)floor(uniform(low, high + 1)); }
static inline bool chance(double share) { return uniform(0, 1) < share; }

#endif
