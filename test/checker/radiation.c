/* SPDX-License-Identifier: BSD-3-Clause */
/* Radiation (radiation.h), in long double.
 *
 * The integral of K(s) u(t - s) is summed piece by piece into the past, each by the mean of the
 * values at its two ends: from t to the last multiple of the spacing before it, and from there on
 * from multiple to multiple, until K has ended, where its value is 0, or the history begins. */
#include "radiation.h"

#include <math.h>
#include <stdlib.h>

/* Times are one that differ by this share of the spacing. */
static const Real SAME = 1e-9L;

RadiationMoment radiation_moment(double time, const double rotation[FOUR], const double *velocity,
                                 const double *rate) {
    RadiationMoment out = {.time = time};
    Real m[3][3];
    body_matrix(rotation, m);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) { /* by the transpose */
            out.u[i] += m[k][i] * velocity[k];
            out.u[3 + i] += m[k][i] * rate[k];
        }
    return out;
}

int radiation_note(RadiationPast *past, RadiationMoment moment) {
    if (past->count == past->room) {
        const size_t room = 2 * past->room + 100;
        RadiationMoment *larger = realloc(past->moment, room * sizeof *larger);
        if (!larger) return -1;
        past->moment = larger;
        past->room = room;
    }
    past->moment[past->count++] = moment;
    return 0;
}

int radiation_rest(RadiationPast *past, double time) {
    past->count = 0;
    return radiation_note(past, (RadiationMoment){.time = time});
}

/* u at a time, between the moments on its sides; 0 before the first one. */
static void velocity_at(const RadiationPast *past, const RadiationMoment *now, Real time, Real g,
                        Real u[SIX]) {
    const RadiationMoment *after = now;
    for (int i = 0; i < SIX; i++) u[i] = 0;
    for (size_t k = past->count; k-- > 0;) {
        const RadiationMoment *before = &past->moment[k];
        if (time >= before->time - SAME * g) {
            const Real part = (time - before->time) / ((Real)after->time - before->time),
                       share = part < 0   ? 0
                               : part > 1 ? 1
                                          : part;
            for (int i = 0; i < SIX; i++) u[i] = (1 - share) * before->u[i] + share * after->u[i];
            return;
        }
        after = before;
    }
}

/* K(s) u */
static void value_at(const CpsBody *body, Real s, Real g, const Real u[SIX], Real out[SIX]) {
    const Real at = s / g;
    const int rows = body->radiation_count;
    for (int i = 0; i < SIX; i++) out[i] = 0;
    if (at > rows - 1 + SAME) return;
    int row = (int)at;
    if (row > rows - 2) row = rows - 2;
    const double *low = body->radiation[row].kernel, *high = body->radiation[row + 1].kernel;
    for (int i = 0; i < SIX; i++)
        for (int k = 0; k < SIX; k++)
            out[i] += ((row + 1 - at) * low[SIX * i + k] + (at - row) * high[SIX * i + k]) * u[k];
}

void radiation_force(const CpsBody *body, const RadiationPast *past, RadiationMoment now,
                     Real out[SIX], double sizes[2]) {
    const int rows = body->radiation_count;
    for (int i = 0; i < SIX; i++) out[i] = 0;
    if (rows == 0) return;
    const Real g = (Real)body->radiation[rows - 1].time / (rows - 1);
    Real near = now.time, value[SIX];
    value_at(body, 0, g, now.u, value);
    for (Real j = ceill(near / g - SAME) - 1; j >= 0 && near > now.time - rows * g; j--) {
        const Real far = j * g;
        Real u[SIX], other[SIX];
        velocity_at(past, &now, far, g, u);
        value_at(body, now.time - far, g, u, other);
        for (int i = 0; i < SIX; i++) {
            out[i] -= (near - far) / 2 * (value[i] + other[i]);
            sizes[i / 3] += (double)((near - far) * (fabsl(value[i]) + fabsl(other[i])));
            value[i] = other[i];
        }
        near = far;
    }
}
