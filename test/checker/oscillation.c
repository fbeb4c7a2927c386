/* SPDX-License-Identifier: BSD-3-Clause */
/* Oscillations (oscillation.h). */
#include "oscillation.h"

#include <math.h>
#include <stdbool.h>

void oscillation(const CpsStage *stage, CpsSwayOf of, int owner, int end, int part, double out[6],
                 double noise[6]) {
    for (int k = 0; k < 6; k++) out[k] = noise[k] = 0;
    for (int i = 0; i < stage->sway_count; i++) {
        const CpsSway *sway = &stage->sway[i];
        const bool same = sway->of == of && sway->owner == owner;
        if (!same || (of == CPS_SWAY_OF_END && sway->end != end)) continue;
        const double turns = stage->duration * part / stage->step_count / sway->period,
                     angle = 2 * acos(-1) * turns;
        for (int k = 0; k < 6; k++) {
            const double sine = sway->sine[k], cosine = sway->cosine[k];
            out[k] += sine * sin(angle) + cosine * (1 - cos(angle));
            noise[k] += 1e-14 * (1 + turns) * (fabs(sine) + 2 * fabs(cosine));
        }
    }
}
