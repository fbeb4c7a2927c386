/* SPDX-License-Identifier: BSD-3-Clause */
/* Oscillations (oscillation.h). */
#include "oscillation.h"

#include <math.h>
#include <stdbool.h>

/* The value of the cubic through the rows at the ends of an interval, by Neville's scheme for its
 * parabolas: the one through the row before the interval, that through the row behind it, and their
 * mean by the share of the interval that has passed, which has the slopes of both. At an end there
 * is one parabola, and of two rows a line. */
static long double through(const double *row, int first, int count, int column, long double t) {
    long double p[3];
    for (int i = 0; i < count; i++) p[i] = row[7 * (first + i) + column];
    for (int m = 1; m < count; m++)
        for (int i = 0; i + m < count; i++) {
            const long double a = row[7 * (first + i)], b = row[7 * (first + i + m)];
            p[i] = ((t - a) * p[i + 1] + (b - t) * p[i]) / (b - a);
        }
    return p[0];
}

static void series(const CpsSway *sway, double time, double out[6], double noise[6]) {
    const double *row = sway->row;
    const int last = sway->row_count - 1;
    int at = 0;
    while (at + 1 < last && row[7 * (at + 1)] <= time) at++;
    const long double from = row[7 * at], to = row[7 * (at + 1)], t = time > to ? to : time,
                      share = (t - from) / (to - from);
    for (int k = 0; k < 6; k++) {
        long double value;
        if (last == 1) {
            value = through(row, 0, 2, 1 + k, t);
        } else {
            const int low = at > 0 ? at - 1 : 0, high = at + 2 <= last ? at : last - 2;
            value = (1 - share) * through(row, low, 3, 1 + k, t) +
                    share * through(row, high, 3, 1 + k, t);
        }
        out[k] += (double)value;
        for (int i = at > 0 ? at - 1 : 0; i <= at + 2 && i <= last; i++)
            noise[k] += 1e-14 * fabs(row[7 * i + 1 + k]);
        /* the time of the step is known to its rounding, within the interval */
        noise[k] += 1e-14 * fabs(time) / (double)(to - from) *
                    fabs(row[7 * (at + 1) + 1 + k] - row[7 * at + 1 + k]);
    }
}

void oscillation(const CpsStage *stage, CpsSwayOf of, int owner, int end, double time,
                 double out[6], double noise[6]) {
    for (int k = 0; k < 6; k++) out[k] = noise[k] = 0;
    for (int i = 0; i < stage->sway_count; i++) {
        const CpsSway *sway = &stage->sway[i];
        const bool same = sway->of == of && sway->owner == owner;
        if (!same || (of == CPS_SWAY_OF_END && sway->end != end)) continue;
        if (sway->row_count > 0) {
            series(sway, time, out, noise);
            continue;
        }
        const double turns = time / sway->period, angle = 2 * acos(-1) * turns;
        for (int k = 0; k < 6; k++) {
            const double sine = sway->sine[k], cosine = sway->cosine[k];
            out[k] += sine * sin(angle) + cosine * (1 - cos(angle));
            noise[k] += 1e-14 * (1 + turns) * (fabs(sine) + 2 * fabs(cosine));
        }
    }
}
