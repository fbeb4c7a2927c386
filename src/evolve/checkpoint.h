/* SPDX-License-Identifier: BSD-3-Clause */
/* Saving and loading an evolution between two steps (cps_evolution_save, cps_evolution_load in
 * capstan/evolve.h). */
#ifndef CAPSTAN_SRC_EVOLVE_CHECKPOINT_H
#define CAPSTAN_SRC_EVOLVE_CHECKPOINT_H

#include "evolve/state.h"

/* A hash of the constant data of an evolution but its history, which in all likelihood differs
 * between scenes. */
uint64_t cpsi_evolution_fingerprint(const CpsEvolution *evolution);

/* Write the hash of each stage (state.h), which saving a state then reads in constant time. */
void cpsi_evolution_hash_stages(CpsEvolution *evolution);

/* The state of one line, as it is part of that of the evolution. */
size_t cpsi_line_state_size(const CpsiLine *line);
void cpsi_line_keep(const CpsiLine *line, void *state);
void cpsi_line_restore(CpsiLine *line, const void *state);

/* Save the state as it is, also after a move that found no equilibrium; and restore a state that
 * this evolution itself has saved. */
void cpsi_evolution_keep(const CpsEvolution *evolution, void *state);
void cpsi_evolution_restore(CpsEvolution *evolution, const void *state);

#endif
