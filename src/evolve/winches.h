/* SPDX-License-Identifier: BSD-3-Clause */
/* Winches of a scene, and what stages pay out (capstan/winch.h). */
#ifndef CAPSTAN_SRC_EVOLVE_WINCHES_H
#define CAPSTAN_SRC_EVOLVE_WINCHES_H

#include "evolve/state.h"

/* Check the winches of a line whose length, elements and kinds of ends have been checked. */
CpsStatus cpsi_winches_check(const CpsLine *line, CpsError *err);

/* Check what a stage pays out, but for how much is there. */
CpsStatus cpsi_pay_outs_check(const CpsScene *scene, const CpsStage *stage, const char *what,
                              CpsError *err);
/* ... and in the whole history, how much is there. */
CpsStatus cpsi_pay_outs_check_history(const CpsScene *scene, CpsError *err);
/* ... and of a stage that begins, how much is there now. */
CpsStatus cpsi_pay_outs_check_now(const CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                                  const char *what, CpsError *err);

/* What a step pays out. */
void cpsi_pay_outs_plan(CpsEvolution *evolution, const CpsiEvolutionStage *stage);

/* Is what is on the drums of a line possible? */
bool cpsi_drums_are_sound(const CpsiLine *line, const double stored[2]);

#endif
