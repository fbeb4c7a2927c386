/* SPDX-License-Identifier: BSD-3-Clause */
/* The lengths of the steps of a stage: equal ones, or, where an error is asked for, such that no
 * step makes a larger one by itself.
 *
 * By the backward difference formula of second order (CpsiFormula) the place after a step of length
 * h is wrong by (k/3) h (h + h_{n-1}) times the second divided difference of the velocity; that is
 *
 *     (k/3) |v_{n+1} - v_n - w (v_n - v_{n-1})|,    and (k/2) |v_{n+1} - v_n| of an Euler step,
 *
 * from what the step has found, for each node, point and body (docs/theory.md 9). A step whose
 * largest estimate is above the error asked for, or that is not certified, is taken back, and a
 * shorter one is tried; the next one is as long as its estimate allows. */
#ifndef CAPSTAN_SRC_EVOLVE_PACE_H
#define CAPSTAN_SRC_EVOLVE_PACE_H

#include "evolve/state.h"

/* What the next step is of its stage; of a move that is no part of the history the whole. */
CpsiPortion cpsi_portion_next(const CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                              bool is_move);
/* [s] The length of the portion. */
double cpsi_portion_length(const CpsiEvolutionStage *stage, const CpsiPortion *portion);
/* Its part of a whole that changes evenly. */
double cpsi_portion_of(const CpsiEvolutionStage *stage, const CpsiPortion *portion, double whole);

/* The portion was taken: go on to the next one, perhaps of the next stage. */
void cpsi_portion_advance(CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                          const CpsiPortion *portion);

/* How many steps remain; of stages whose steps differ a guess, at least 1 of each. */
int cpsi_steps_left(const CpsEvolution *evolution);
/* ... and of the stage under way. */
int cpsi_steps_left_now(const CpsEvolution *evolution);

/* Is the step that was taken, of a stage with an error, to be taken back? Then *shorter is the
 * length of the next try; else that of the next step is set. */
bool cpsi_pace_rejects(CpsEvolution *evolution, const CpsiEvolutionStage *stage, double *shorter);

/* [m] What a step is wrong by at a place by its own estimate, from the velocities there before the
 * last step, now, and after the step; `euler`: of an Euler step, which does not read the first. */
Vec3 cpsi_step_error(const CpsiFormula *formula, bool euler, Vec3 before, Vec3 now, Vec3 next);

#endif
