/* SPDX-License-Identifier: BSD-3-Clause */
/* Velocities that a stage or move of one step in time gives to what it holds (capstan/motion.h).
 *
 * In a step the velocity of anything is (x - x*)/k. Of an end, point or body with a given velocity
 * x* is not that of the scheme but the place from which this velocity leads to where it is held, so
 * that all that reads the velocity of a step reads the given one. */
#ifndef CAPSTAN_SRC_EVOLVE_VELOCITIES_H
#define CAPSTAN_SRC_EVOLVE_VELOCITIES_H

#include "evolve/state.h"

/* Check those of a stage or move, whose changes have been checked. */
CpsStatus cpsi_velocities_check(const CpsScene *scene, const CpsStage *stage, const char *what,
                                CpsError *err);

/* Set those of a step, whose places have been planned. */
void cpsi_velocities_plan(CpsEvolution *evolution, const CpsiEvolutionStage *stage);

/* Add those of a stage to its hash; without any nothing is added. */
void cpsi_velocities_hash(uint64_t *hash, const CpsiEvolutionStage *stage);

#endif
