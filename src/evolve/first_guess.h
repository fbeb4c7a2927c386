/* SPDX-License-Identifier: BSD-3-Clause */
/* Where the search for the places of free points and bodies begins (balance.h). */
#ifndef CAPSTAN_SRC_EVOLVE_FIRST_GUESS_H
#define CAPSTAN_SRC_EVOLVE_FIRST_GUESS_H

#include "evolve/trial.h"

/* Where the points and bodies go on the tangent planes of the reference, the bodies in rounds about
 * the poses of the round before; false where that has no solution. `refined`: to the last digits,
 * and what sticks stays where it is. */
bool cpsi_guess_places(CpsiBalance *balance, bool refined);
/* Where the last step of the same stage leads. */
void cpsi_extrapolate_places(CpsiBalance *balance);

#endif
