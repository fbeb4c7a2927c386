/* SPDX-License-Identifier: BSD-3-Clause */
/* Acceleration of the rounds in which a group of lines and free points is solved on the tangent
 * planes of curved obstacles, or of several ones (first_guess.h): points and nodes together, as the
 * rounds of one line are (cable/anderson.h). */
#ifndef CAPSTAN_SRC_EVOLVE_POINT_ROUNDS_H
#define CAPSTAN_SRC_EVOLVE_POINT_ROUNDS_H

#include "evolve/trial.h"

/* The next round is to start from where the last one has led points and nodes, or from where
 * several that converge are leading them; `turned` [rad] is by how much the last one has turned
 * axes, infinite for the first. */
void cpsi_point_rounds_accelerate(CpsiBalance *balance, double turned);

#endif
