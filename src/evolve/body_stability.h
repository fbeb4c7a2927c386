/* SPDX-License-Identifier: BSD-3-Clause */
/* Are the bodies of a group stable in their poses (docs/theory.md 6e)? */
#ifndef CAPSTAN_SRC_EVOLVE_BODY_STABILITY_H
#define CAPSTAN_SRC_EVOLVE_BODY_STABILITY_H

#include "evolve/trial.h"

/* Say of each body in its report whether it is stable, after cpsi_add_followers, whose coupling is
 * lost. */
void cpsi_judge_stability(CpsiBalance *balance);

#endif
