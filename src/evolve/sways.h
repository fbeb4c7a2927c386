/* SPDX-License-Identifier: BSD-3-Clause */
/* Oscillations of what a stage in time imposes on ends, points and bodies (motion.h). */
#ifndef CAPSTAN_SRC_EVOLVE_SWAYS_H
#define CAPSTAN_SRC_EVOLVE_SWAYS_H

#include "capstan/scene.h"

/* Check the oscillations of a stage or move; its changes have been checked. */
CpsStatus cpsi_sways_check(const CpsScene *scene, const CpsStage *stage, const char *what,
                           CpsError *err);

/* The numbers in the rows of oscillations that are time series; and copy them, their rows to
 * `rows`, which has so many. */
size_t cpsi_sways_numbers(int count, const CpsSway *sway);
void cpsi_sways_copy(int count, const CpsSway *from, CpsSway *to, double *rows);

/* The number of oscillations of one move that `things` ends, points and bodies can have. */
int cpsi_sways_of_move(int things);

/* What the oscillations among `sway` of one owner have become `time` [s] after the stage began. */
void cpsi_sways_at(int count, const CpsSway *sway, CpsSwayOf of, int owner, int end, double time,
                   double out[6]);

#endif
