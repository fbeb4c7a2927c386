/* SPDX-License-Identifier: BSD-3-Clause */
/* Obstacles that turn or move under free points in steps in time (docs/theory.md 9). The reference
 * x* of a point is carried along by an obstacle for the span k of the scheme, the last share k/h of
 * the step; by one that turns, x_n and x_{n-1} are, and x* is made of these. What sticks goes with
 * it exactly. */
#ifndef CAPSTAN_SRC_EVOLVE_MOVING_GROUND_H
#define CAPSTAN_SRC_EVOLVE_MOVING_GROUND_H

#include "evolve/state.h"

/* Does an obstacle turn or move in the step? */
bool cpsi_ground_moves(const CpsEvolution *evolution);

/* Where obstacle k has taken what a point began at: x* in a step in time, else where it was. */
Vec3 cpsi_ground_carry(const CpsEvolution *evolution, const CpsiPoint *point, int k);

/* [m] The way in the whole step of obstacle k, where it comes to x; 0 of none, k < 0. */
Vec3 cpsi_ground_way(const CpsEvolution *evolution, int k, Vec3 x);
/* [m/s] The velocity along the normal, which a turn about the obstacle's own axis has not, of the
 * obstacle that a point touches after the step, at the point; 0 where it touches none. */
double cpsi_ground_rate(const CpsEvolution *evolution, const CpsiPoint *point);

/* Is a step in time too long for a free point, which it has found and where what bears on it had
 * taken it to `start`? What turns it round an obstacle by more than a quarter of a turn may have
 * taken either way, and what is round may have gone past it. */
bool cpsi_ground_outruns(const CpsEvolution *evolution, const CpsiPoint *point, Vec3 start);

#endif
