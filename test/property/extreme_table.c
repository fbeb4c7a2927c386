/* SPDX-License-Identifier: BSD-3-Clause */
/* Velocities of a resistance law from a table of factors over the speed. */
#include <math.h>

#include "extreme_case.h"

/* h' through (0, y0), (1, y1), (2, y1), (3, y2) times a disc of radius r, alone or beside a dry
 * disc: at the force F the speeds with h' = |F|/r (less the dry one's). */
void try_table(void) {
    const double y0 = below(3), y1 = y0 + 1 + below(2), y2 = y1 + 1 + below(3),
                 r = pow(10, digit(2)), s = below(2) ? r * (1 + below(3)) : 0;
    const double speed[] = {0, 1, 2, 3}, factor[] = {y0, y1, y1, y2};
    const int where =
        below(6); /* in rest, at h'(0), between, on the flat piece, above it, at the end */
    const double slope[] = {0.5 * y0, y0, 0.5 * (y0 + y1), y1, 0.5 * (y1 + y2), y2},
                 low[] = {0, 0, 0.5, 1, 2.5, 3}, high[] = {0, 0, 0.5, 2, 2.5, INFINITY};
    if (where < 2 && y0 == 0 && s == 0 && where == 1) return; /* F = 0 twice */
    double u[2], force[2];
    unit_vector(2, u);
    CpsSet *disc = NULL, *dry = NULL, *velocities = NULL;
    need(cps_set_ball(2, NULL, r, &disc, &err), "disc");
    if (s > 0) need(cps_set_ball(2, NULL, s, &dry, &err), "dry");
    CpsLaw *law = law_of(disc), *rough = s > 0 ? law_of(dry) : NULL;
    CpsResistance *part[2] = {NULL, NULL}, *all = NULL;
    need(cps_resistance_table(law, 4, speed, factor, &part[0], &err), "table");
    if (s > 0) need(cps_resistance_dry(rough, &part[1], &err), "dry");
    need(cps_resistance_sum(s > 0 ? 2 : 1, (const CpsResistance *const *)part, &all, &err), "sum");
    for (int i = 0; i < 2; i++) force[i] = (slope[where] * r + s) * u[i];
    CpsSetAnswer answer;
    CpsSetExtent extent;
    need(cps_resistance_velocities(all, force, &velocities, &answer, &err), "velocities");
    same("outcome", answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    if (velocities) {
        need(cps_set_extent(velocities, (double[]){-u[0], -u[1]}, &extent, &err), "extent");
        near("least speed", r * extent.low, low[where], 1e-5); /* g = r |V| */
        if (isinf(high[where]))
            same("greatest speed", isinf(extent.high), 1);
        else
            near("greatest speed", r * extent.high, high[where], 1e-5);
    }
    cps_set_release(velocities);
    for (int i = 0; i < 2; i++) cps_resistance_release(part[i]);
    cps_resistance_release(all);
    cps_law_release(law);
    cps_law_release(rough);
}
