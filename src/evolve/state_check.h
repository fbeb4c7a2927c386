/* SPDX-License-Identifier: BSD-3-Clause */
/* The check of a loaded state: could steps have produced it? A state file is checked as strictly as
 * a scene. */
#ifndef CAPSTAN_SRC_EVOLVE_STATE_CHECK_H
#define CAPSTAN_SRC_EVOLVE_STATE_CHECK_H

#include "evolve/state.h"

/* Check counters, indices, kinds and numbers of an evolution against their ranges. Returns a
 * description of the fault, or NULL. */
const char *cpsi_state_fault(const CpsEvolution *evolution);

#endif
