/* SPDX-License-Identifier: BSD-3-Clause */
/* The motion of lines, points and bodies in a step, summed. */
#include <math.h>

#include "evolve/state.h"

static void add_motion(const CpsMotionLedger *ledger, CpsMotionLedger *sum) {
    sum->kinetic += ledger->kinetic;
    sum->impact += ledger->impact;
    sum->scheme += ledger->scheme;
    sum->settling += ledger->settling;
    sum->damping += ledger->damping;
    sum->drag += ledger->drag;
    sum->added += ledger->added;
    sum->waves += ledger->waves;
    sum->turnover += ledger->turnover;
}

void cps_ledgers_add(const CpsLedger *ledger, const CpsMotionLedger *motion, CpsLedger *sum,
                     CpsMotionLedger *motion_sum) {
    sum->elastic += ledger->elastic;
    sum->gravity += ledger->gravity;
    sum->ends += ledger->ends;
    sum->obstacles += ledger->obstacles;
    sum->winches += ledger->winches;
    sum->loads += ledger->loads;
    sum->dissipated += ledger->dissipated;
    sum->imbalance += ledger->imbalance;
    add_motion(motion, motion_sum);
}

/* [J] Sizes of the entries of a line's ledger that are not in the turnover of its motion. That of a
 * line with inertia has all of them, if it moved or came to rest, and is 0 otherwise; that of
 * others has none. */
static double left_out(const CpsiLine *line) {
    const CpsLedger *ledger = &line->report.ledger;
    if (line->has_inertia && line->inertia.ledger.turnover > 0) return 0;
    return fabs(ledger->ends) + fabs(ledger->obstacles) + fabs(ledger->loads) +
           fabs(ledger->winches) + fabs(ledger->elastic) + fabs(ledger->gravity) +
           fabs(ledger->dissipated);
}

CpsStepMotion cps_evolution_motion(const CpsEvolution *evolution) {
    CpsStepMotion sum = {0};
    for (int i = 0; i < cps_evolution_line_count(evolution); i++) {
        const CpsLineMotion motion = cps_evolution_line_motion(evolution, i);
        add_motion(&motion.ledger, &sum.ledger);
        sum.kinetic += motion.kinetic;
        sum.ledger.turnover += left_out(&evolution->line[i]);
        if (!motion.is_moving) continue;
        sum.landed += motion.landed;
        sum.changed += motion.changed;
        sum.snatched += motion.snatched;
        if (!(motion.position_bound <= sum.position_bound))
            sum.position_bound = motion.position_bound;
    }
    for (int i = 0; i < cps_evolution_point_count(evolution); i++) {
        const CpsPointMotion motion = cps_evolution_point_motion(evolution, i);
        add_motion(&motion.ledger, &sum.ledger);
        sum.kinetic += motion.kinetic;
        sum.landed += motion.landed;
    }
    for (int i = 0; i < cps_evolution_body_count(evolution); i++) {
        const CpsBodyMotion motion = cps_evolution_body_motion(evolution, i);
        add_motion(&motion.ledger, &sum.ledger);
        sum.kinetic += motion.kinetic;
    }
    return sum;
}
