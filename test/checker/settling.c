/* SPDX-License-Identifier: BSD-3-Clause */
/* What is brought to rest (settling.h).
 *
 * The energy that is lost is what there was, kinetic energy and stored, and what forces from
 * outside did on the way by their values after the step, less what is stored then and what friction
 * dissipates. */
#include "settling.h"

#include <math.h>

#include "damping.h"
#include "elongation.h"
#include "grasps.h"
#include "soft.h"

/* Rounding of places, per largest coordinate; of energies, per their sizes; and gaps. */
static const double PLACES = 1e-13, ENERGIES = 1e-9, GAPS = 10;

static Real strain_of(const Record *r, const Vector *x, size_t i) {
    Real square = 0;
    for (int a = 0; a < 3; a++)
        square += ((Real)x[i + 1][a] - x[i][a]) * ((Real)x[i + 1][a] - x[i][a]);
    return sqrtl(square) / r->element_length[i] - 1;
}

static double kept_by(const Record *before) {
    Real sum = 0;
    if (!before->damping) return 0;
    for (size_t i = 0; i < before->elements; i++) {
        const Real d = before->damping->elongation[i],
                   own = fmaxl(0, strain_of(before, (const Vector *)before->position, i));
        sum += before->element_length[i] * (d - own) * (d + own) /
               (2 * (Real)before->damping->compliance[i]);
    }
    return (double)sum;
}

void settling_begin(Record *r, const Record *before) {
    r->settles =
        before && r->mass && !in_time(r) && in_time(before) && before->outcome <= OUTCOME_TAUT;
    r->kept = r->settles ? kept_by(before) : 0;
}

static Real stored(const Record *r, const Vector *x, size_t i) {
    return r->compliance > 0
               ? r->element_length[i] * elongation_energy(r, i, fmaxl(0, strain_of(r, x, i)))
               : 0;
}

/* [J] Of loads and of what holds the ends, and what is stored less than before. */
static Real energy_had(const Source *source, const Record *r, const Record *before, Real *sizes) {
    Real sum = r->kept;
    for (size_t i = 0; i < r->elements; i++)
        sum += stored(r, (const Vector *)before->position, i) -
               stored(r, (const Vector *)r->position, i);
    for (size_t j = 0; j < r->nodes; j++) {
        if (!node_is_held(r, j)) sum -= soft_growth(source, r, j, before->position[j], 1);
        for (int a = 0; a < 3; a++) {
            const Real way = (Real)r->position[j][a] - before->position[j][a];
            Real force = r->load[j][a];
            for (int e = 0; e < 2; e++)
                if (j == (e ? r->elements : 0) && r->end_kind[e] == END_HELD)
                    force += r->end_force[e][a];
            sum += force * way;
            *sizes += fabsl(force * way);
        }
    }
    return sum;
}

static void compare(const char *what, double said, double expected, double noise, InertiaFind *find,
                    void *user) {
    if (!(fabs(said - expected) <= noise)) find(user, what, said, expected);
}

void settling_check(const Source *source, const Record *r, const Record *before, InertiaFind *find,
                    void *user) {
    if (!r->mass || !before || in_time(r)) return;
    const bool rests = r->settles;
    /* a static start keeps the velocity with which the history begins, and has done no work in time
     */
    const double had = before->time_entry[TIME_KINETIC];
    compare("growth of the kinetic energy", r->time_entry[TIME_GROWTH], -had, 0, find, user);
    for (int k = TIME_IMPACT; k < TIME_ENTRIES; k++)
        if (k != TIME_SETTLING)
            compare("energy of a motion in a quasi-static step", r->time_entry[k], 0, 0, find,
                    user);
    compare("kinetic energy", r->time_entry[TIME_KINETIC], 0, 0, find, user);
    if (!rests) compare("ledger_settling", r->time_entry[TIME_SETTLING], had, 0, find, user);
    if (!rests || r->substeps > 1 || r->grasps > 0 || r->outcome > OUTCOME_TAUT) return;
    double reach = 0;
    for (size_t j = 0; j < r->nodes; j++)
        for (int a = 0; a < 3; a++) reach = fmax(reach, fabs(r->position[j][a]));
    Real sizes = had;
    const Real lost =
        had + energy_had(source, r, before, &sizes) + r->ledger[LEDGER_OBSTACLES] - r->dissipated;
    for (int k = 0; k < LEDGER_ENTRIES; k++) sizes += fabs(r->ledger[k]);
    const double noise = ENERGIES * (double)sizes + GAPS * fabs(r->claim[CLAIM_GAP]) +
                         PLACES * reach * r->claim[CLAIM_LARGEST_FORCE] + 1e-300;
    compare("ledger_settling", r->time_entry[TIME_SETTLING], (double)lost, noise, find, user);
    compare("imbalance where a line comes to rest", r->ledger[LEDGER_IMBALANCE], 0, noise, find,
            user);
}
