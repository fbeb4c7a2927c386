/* SPDX-License-Identifier: BSD-3-Clause */
/* The ledger of a body in a step in time (body_ledger.h).
 *
 * Forces do their work at their values after the step on the way of the place at which they act:
 * lines at their points, weight and buoyancy at their centres. The water's stiffness gives what its
 * energy falls by. The given load and what holds the body act on its displacement and on the vector
 * of its rotation; so would what nothing balances. */
#include "body_ledger.h"

#include <math.h>

/* Rounding of places counts by this part of them among sizes of works. */
static const Real PLACES = 1e-4L;

/* By the product of the second with the conjugate of the first. */
void body_turn(const double p[FOUR], const double q[FOUR], Real out[3]) {
    const Real w = (Real)p[0] * q[0] + (Real)p[1] * q[1] + (Real)p[2] * q[2] + (Real)p[3] * q[3];
    Real sine = 0;
    for (int i = 0; i < 3; i++) {
        const int k = (i + 1) % 3, l = (i + 2) % 3;
        out[i] = (Real)p[0] * q[1 + i] - (Real)q[0] * p[1 + i] +
                 ((Real)q[1 + l] * p[1 + k] - (Real)q[1 + k] * p[1 + l]);
        sine += out[i] * out[i];
    }
    sine = sqrtl(sine);
    const Real sign = w < 0 ? -1 : 1,
               by = sine > 0 ? sign * 2 * atan2l(sine, sign * w) / sine : 2 * sign;
    for (int i = 0; i < 3; i++) out[i] *= by;
}

/* The work of a force on a place of the body. */
static Real on_place(const BodyLedger *of, const Real force[3], const Vector place, double *sizes) {
    Real from[3], to[3], work = 0;
    body_place(of->before->position, of->before->rotation, place, from);
    body_place(of->now->position, of->now->rotation, place, to);
    for (int a = 0; a < 3; a++) {
        work += force[a] * (to[a] - from[a]);
        *sizes += (double)(fabsl(force[a]) * (fabsl(to[a] - from[a]) + PLACES * fabsl(to[a])));
    }
    return work;
}

/* The energy of the water's stiffness in a pose. */
static Real water_energy(const BodyData *data, const BodyState *at) {
    Real q[SIX], sum = 0;
    for (int i = 0; i < 3; i++) q[i] = (Real)at->position[i] - data->start_position[i];
    body_turn(data->start_rotation, at->rotation, &q[3]);
    for (int i = 0; i < SIX; i++)
        for (int k = 0; k < SIX; k++) sum += 0.5L * q[i] * data->hydrostatics[SIX * i + k] * q[k];
    return sum;
}

Real body_ledger_work(const BodyLedger *of, double *sizes) {
    const BodyData *data = &of->bodies->data[of->k];
    Real force[3], own[SIX], t[3], work = 0;
    for (size_t i = 0; i < of->source->lines; i++)
        for (int e = 0; e < 2; e++) {
            const int p = of->line[i].end_point[e];
            if (p < 0 || of->bodies->of_point[p] != (int)of->k) continue;
            for (int a = 0; a < 3; a++) force[a] = -(Real)of->line[i].end_force[e][a];
            work += on_place(of, force, of->bodies->place[p], sizes);
        }
    for (int a = 0; a < 3; a++) force[a] = (Real)data->weight * of->gravity[a];
    work += on_place(of, force, data->centre_of_gravity, sizes);
    for (int a = 0; a < 3; a++) force[a] = -(Real)data->buoyancy * of->gravity[a];
    work += on_place(of, force, data->centre_of_buoyancy, sizes);
    const Real stored[2] = {water_energy(data, of->before), water_energy(data, of->now)};
    work += stored[0] - stored[1];
    *sizes += (double)(fabsl(stored[0]) + fabsl(stored[1]));
    body_load(data, of->now->position, of->now->rotation, of->gravity, own);
    body_turn(of->before->rotation, of->now->rotation, t);
    for (int i = 0; i < SIX; i++) {
        const Real way = i < 3 ? (Real)of->now->position[i] - of->before->position[i] : t[i - 3],
                   given = of->now->load[i] - own[i];
        work += (given + of->now->support[i] - of->now->residual[i]) * way;
        *sizes += (double)((fabsl(given) + fabs(of->now->support[i])) * fabsl(way));
        /* the given load is what is left of the whole one */
        *sizes += (fabs(of->now->load[i]) + (double)fabsl(own[i])) * (double)fabsl(way);
    }
    return work;
}
