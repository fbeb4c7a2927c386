/* SPDX-License-Identifier: BSD-3-Clause */
/* Extremes of the quantities of a line over a history (evolve.h). */
#include "capstan/evolve.h"

static void add(CpsExtreme *extreme, double value, int step) {
    if (!extreme->has_values) {
        *extreme = (CpsExtreme){true, value, value, step, step};
        return;
    }
    if (value < extreme->least) {
        extreme->least = value;
        extreme->least_step = step;
    }
    if (value > extreme->greatest) {
        extreme->greatest = value;
        extreme->greatest_step = step;
    }
}

void cps_extremes_add(CpsExtremes *extremes, const CpsLineReport *report, int step) {
    if (!extremes || !report || !cps_outcome_is_certified(report->outcome)) return;
    for (int end = 0; end < 2; end++) {
        add(&extremes->tension[end], report->end[end].tension, step);
        add(&extremes->uplift[end], report->end[end].uplift, step);
        add(&extremes->angle[end], report->end[end].angle, step);
        add(&extremes->suspended[end], report->end[end].suspended, step);
        if (report->has_touchdown)
            for (int a = 0; a < 3; a++)
                add(&extremes->touchdown[end][a], report->end[end].touchdown[a], step);
    }
    add(&extremes->grounded, report->grounded, step);
    if (report->has_slipping) add(&extremes->slipping, report->slipping, step);
    add(&extremes->slack, report->slack, step);
    add(&extremes->sweep, report->sweep, step);
    if (report->has_utilisation) add(&extremes->utilisation, report->utilisation, step);
}
