/* SPDX-License-Identifier: BSD-3-Clause */
/* Events of a step in time (events.h). */
#include "events.h"

#include <math.h>

#include "grasps.h"
#include "inertia.h"
#include "loads.h"

/* An element is slack, and a contact slides, beyond this share of a length: of the element, and of
 * the line, to which places are known. */
static const double NOTHING = 1e-9;

static bool is_slack(const Record *r, size_t i) {
    Real square = 0;
    for (int a = 0; a < 3; a++) {
        const Real d = (Real)r->position[i + 1][a] - r->position[i][a];
        square += d * d;
    }
    return sqrtl(square) < (1 - NOTHING) * (Real)r->element_length[i];
}

static bool slides(const Record *r, size_t c, double length) {
    const double *u = r->slip[c];
    return sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]) > NOTHING * length;
}

static void add_energies(const Record *r, Events *sum) {
    sum->imbalance += fabs(r->ledger[LEDGER_IMBALANCE]);
    sum->turnover += fabs(r->dissipated) + fabs(r->loads ? r->loads->ledger : 0);
    for (int k = 0; k < LEDGER_ENTRIES; k++)
        sum->turnover += k == LEDGER_IMBALANCE ? 0 : fabs(r->ledger[k]);
    for (int k = 0; k < TIME_ENTRIES; k++)
        sum->turnover += k == TIME_KINETIC ? 0 : fabs(r->time_entry[k]);
}

void events_add(const Record *r, const Record *before, Events *sum) {
    if (!in_time(r) || r->outcome > OUTCOME_TAUT) return;
    double length = 0;
    for (size_t i = 0; i < r->elements; i++) length += r->element_length[i];
    sum->steps++;
    add_energies(r, sum);
    for (size_t c = 0; c < r->contacts * r->nodes; c++) {
        if (node_is_held(r, c % r->nodes) || !(r->reaction[c] > 0)) continue;
        if (!(before->reaction[c] > 0))
            sum->landed++;
        else if (in_time(before))
            sum->changed += slides(r, c, length) != slides(before, c, length);
    }
    for (size_t i = 0; i < r->elements; i++)
        sum->snatched += is_slack(before, i) && !is_slack(r, i);
}
