/* SPDX-License-Identifier: BSD-3-Clause */
/* Obstacles that are shifted. */
#ifndef CAPSTAN_SRC_EVOLVE_SHIFTS_H
#define CAPSTAN_SRC_EVOLVE_SHIFTS_H

#include "evolve/state.h"

/* Check what a stage shifts; `what` is the subject of a message. Returns CPS_OK, CPS_ERR_ARGUMENT
 * or CPS_ERR_LIMIT. */
CpsStatus cpsi_stage_shifts_check(const CpsScene *scene, const CpsStage *stage, const char *what,
                                  CpsError *err);

/* Check that no end or node that is held, on its straight path in a stage, meets an obstacle that
 * may move, as that goes straight on its own. Returns CPS_OK or CPS_ERR_ARGUMENT. */
CpsStatus cpsi_shifts_check(const CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                            const char *what, CpsError *err);

#endif
