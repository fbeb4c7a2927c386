/* SPDX-License-Identifier: BSD-3-Clause */
/* The first-order force of waves on bodies (capstan/body.h, docs/theory.md 9). */
#ifndef CAPSTAN_SRC_EVOLVE_EXCITATION_H
#define CAPSTAN_SRC_EVOLVE_EXCITATION_H

#include "evolve/state.h"

/* Check that of all bodies; they and the waves have been checked. */
CpsStatus cpsi_excitation_check(const CpsScene *scene, CpsError *err);

/* [N, N m] Of each body and wave the force at the phase 0 of the wave at the place where the body
 * begins, and at pi/2, six components each. */
void cpsi_excitation_layout(CpsEvolution *evolution, CpsiArena *arena, const CpsScene *scene);
void cpsi_excitation_fill(CpsEvolution *evolution, const CpsScene *local);

/* Find what the waves do to the bodies at their time, which is that after the step under way;
 * nothing in a quasi-static one. */
void cpsi_excite_bodies(CpsEvolution *evolution);

#endif
