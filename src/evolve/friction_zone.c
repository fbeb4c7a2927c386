/* SPDX-License-Identifier: BSD-3-Clause */
/* The mean of a line's friction factor over the length that a node represents (friction_zone.h). */
#include "evolve/friction_zone.h"

#include <math.h>

double cpsi_zone_factor(const CpsLine *line, int *first, double low, double share) {
    const double high = low + share;
    while (*first < line->zone_count && line->zone[*first].to <= low) ++*first;
    double factor = 1;
    for (int k = *first; k < line->zone_count && line->zone[k].from < high; k++) {
        const CpsFrictionZone *zone = &line->zone[k];
        factor += (zone->factor - 1) * (fmin(high, zone->to) - fmax(low, zone->from)) / share;
    }
    return fmax(0, factor);
}
