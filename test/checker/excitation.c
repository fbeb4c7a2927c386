/* SPDX-License-Identifier: BSD-3-Clause */
/* The force of waves on bodies (excitation.h), as complex amplitudes that turn with -w t. */
#include "excitation.h"

#include <complex.h>
#include <math.h>

#include "sea.h"

static const Real TAU = 6.283185307179586476925286766559L;

/* amplitude exp(-i lead) of component j at a frequency, on the straight line between the rows for
 * the direction that enclose it. */
static long double complex transfer(const CpsBody *body, const CpsWave *wave, int j) {
    const Real frequency = 1 / (Real)wave->period;
    long double complex value[2] = {0, 0};
    Real at[2] = {-1, -1};
    for (int k = 0; k < body->excitation_count; k++) {
        const CpsExcitation *row = &body->excitation[k];
        const Real own = 1 / (Real)row->period;
        if (cosl(row->direction - (Real)wave->direction) < 1 - 1e-11L) continue;
        for (int side = 0; side < 2; side++) {
            const Real off = side ? own - frequency : frequency - own;
            const bool nearer =
                at[side] < 0 || off < (side ? at[1] - frequency : frequency - at[0]);
            if (off < -2e-9L * frequency || !nearer) continue;
            at[side] = own;
            value[side] = row->amplitude[j] * cexpl(-I * (Real)row->lead[j]);
        }
    }
    const Real share = at[1] > at[0] ? (frequency - at[0]) / (at[1] - at[0]) : 0;
    return value[0] + (share < 0 ? 0 : share > 1 ? 1 : share) * (value[1] - value[0]);
}

void excitation(const CpsScene *scene, int index, double time, double out[6], double noise[6]) {
    const CpsBody *body = &scene->body[index];
    const CpsWaves *waves = scene->current ? scene->current->waves : NULL;
    for (int j = 0; j < 6; j++) out[j] = noise[j] = 0;
    if (!waves || body->excitation_count == 0) return;
    const Real grown = time < waves->ramp ? (1 - cosl(TAU / 2 * time / waves->ramp)) / 2 : 1;
    for (int w = 0; w < waves->wave_count; w++) {
        const CpsWave *wave = &waves->wave[w];
        const Real frequency = TAU / wave->period,
                   k = sea_number(frequency, -(Real)scene->gravity[2], waves->depth),
                   way = body->position[0] * cosl(wave->direction) +
                         body->position[1] * sinl(wave->direction),
                   p = k * way - frequency * time + wave->phase;
        for (int j = 0; j < 6; j++) {
            const long double complex force = grown * wave->amplitude * transfer(body, wave, j);
            out[j] += (double)creall(force * cexpl(I * p));
            noise[j] += 1e-14 * (double)((2 + fabsl(k * way) + frequency * time) * cabsl(force));
        }
    }
}
