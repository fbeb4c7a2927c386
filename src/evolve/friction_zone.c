/* SPDX-License-Identifier: BSD-3-Clause */
/* The mean of a line's friction factor over the length that a node represents (friction_zone.h). */
#include "evolve/friction_zone.h"

#include <math.h>

/* A mean below this, per largest factor, is 0: the parts of a node's length make up a whole but for
 * rounding. */
static const double ROUNDING = 1e-12;

double cpsi_zone_factor(const CpsLine *line, int *first, double low, double share) {
    const double high = low + share;
    while (*first < line->zone_count && line->zone[*first].to <= low) ++*first;
    double factor = 1, largest = 1;
    for (int k = *first; k < line->zone_count && line->zone[k].from < high; k++) {
        const CpsFrictionZone *zone = &line->zone[k];
        largest = fmax(largest, zone->factor);
        factor += (zone->factor - 1) * (fmin(high, zone->to) - fmax(low, zone->from)) / share;
    }
    return factor > ROUNDING * largest ? factor : 0;
}
