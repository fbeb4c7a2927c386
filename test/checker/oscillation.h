/* SPDX-License-Identifier: BSD-3-Clause */
/* What the oscillations of a stage add to what it imposes, from their definition (motion.h). */
#ifndef CAPSTAN_CHECKER_OSCILLATION_H
#define CAPSTAN_CHECKER_OSCILLATION_H

#include "capstan/scene.h"

/* The sum over the oscillations of an end, point or body `time` [s] after the stage began, and to
 * how much each component is known, as angles are known to their rounding. */
void oscillation(const CpsStage *stage, CpsSwayOf of, int owner, int end, double time,
                 double out[6], double noise[6]);

#endif
