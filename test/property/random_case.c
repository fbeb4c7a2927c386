/* SPDX-License-Identifier: BSD-3-Clause */
/* The stream of random numbers of the case at hand, and the message of its last call. */
#include "random_case.h"

uint64_t state, seed;
CpsError err;
