/* SPDX-License-Identifier: BSD-3-Clause */
/* The ledger of a step of all lines, points and bodies: that of the lines, which have been added
 * up, and what points and bodies add.
 *
 * In a quasi-static step that is their friction, and the work that their forces and the obstacles
 * under them do for it. In a step in time (docs/theory.md 9)
 *
 *     ends + obstacles + loads = energies of the lines
 *         + dissipated + kinetic + impact + scheme of points and bodies + imbalance,
 *
 * where `ends` is the work of what acts from outside: at ends of lines that are at no point, of
 * load, weight and water on points and bodies, and of what holds them. The work at ends that are at
 * points stays inside. So the imbalance has the work of what nothing balances at points and
 * bodies. */
#ifndef CAPSTAN_SRC_EVOLVE_STEP_LEDGER_H
#define CAPSTAN_SRC_EVOLVE_STEP_LEDGER_H

#include "evolve/state.h"

/* Find what quasi-static lines at points lose to the scheme in a step in time, once points and
 * bodies have been advanced: they pull with the force after the step, and take the work of the mean
 * of before and after. */
void cpsi_coupling_ledger(CpsEvolution *evolution);

/* Add points and bodies to the sum over the lines. */
void cpsi_step_ledger(const CpsEvolution *evolution, CpsStepReport *step);

#endif
