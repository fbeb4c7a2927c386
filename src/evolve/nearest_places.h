/* SPDX-License-Identifier: BSD-3-Clause */
/* Of all places of free points at which the forces balance, those nearest to where the step began.
 */
#ifndef CAPSTAN_SRC_EVOLVE_NEAREST_PLACES_H
#define CAPSTAN_SRC_EVOLVE_NEAREST_PLACES_H

#include "evolve/trial.h"

/* Move from the answer that the search has found to the nearest one, where there are others; then
 * the lines at the points that had a choice report it. */
void cpsi_take_nearest_places(CpsiBalance *balance);

#endif
