/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/follow.h: motion and loads in time that a program gives, by a function of time and state.
 *
 *     static bool sway(void *user, double time, const CpsEvolution *evolution, CpsStage *step) {
 *         CpsChange *change = user;
 *         change->to.value[0] = 5 * sin(time);
 *         step->change = change;
 *         step->change_count = 1;
 *         return true;
 *     }
 *     ...
 *     cps_evolution_follow(evolution, 60, 1200, sway, &change, &err); */
#ifndef CAPSTAN_FOLLOW_H
#define CAPSTAN_FOLLOW_H

#include "capstan/evolve.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a step in time imposes: places of held ends, points and bodies, loads of free ones, shifts
 * and turns of obstacles, at its end, as in a move. What is not set stays as it is.
 *
 *   time       [s] at the end of the step, since the history began
 *   evolution  where the step begins: its views, reports and motions may be asked for, and nothing
 *              else; so what the function makes of the state is by one step late
 *   step       a default stage, to be filled; what it points to lasts until the next call. Its
 *              duration and step_count are not read.
 *
 * False: no more steps. */
typedef bool CpsFollowFunction(void *user, double time, const CpsEvolution *evolution,
                               CpsStage *step);

/* Take up to `step_count` >= 1 equal moves in time of `duration` [s] > 0 in all. Ends early, with
 * CPS_OK, where the function says so and after a step without an equilibrium. Returns
 * CPS_ERR_ARGUMENT for wrong numbers or a NULL evolution or function, and what cps_evolution_move
 * does for what it refuses, after the steps before that. */
CPS_API CpsStatus cps_evolution_follow(CpsEvolution *evolution, double duration, int step_count,
                                       CpsFollowFunction *function, void *user, CpsError *err);

#ifdef __cplusplus
}
#endif
#endif
