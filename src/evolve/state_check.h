/* SPDX-License-Identifier: BSD-3-Clause */
/* Is a state that has been loaded one that steps can have left? A state is trusted as little as a
 * scene. */
#ifndef CAPSTAN_SRC_EVOLVE_STATE_CHECK_H
#define CAPSTAN_SRC_EVOLVE_STATE_CHECK_H

#include "evolve/evolution.h"

/* Counters, indices, kinds and numbers of an evolution against their ranges: what is wrong, in
 * words, or NULL. */
const char *cpsi_state_fault(const CpsEvolution *evolution);

#endif
