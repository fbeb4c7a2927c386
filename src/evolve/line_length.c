/* SPDX-License-Identifier: BSD-3-Clause */
/* Giving a line another length (capstan/pretension.h). */
#include "capstan/pretension.h"

#include "evolve/ranges.h"

/* What changes: natural lengths between `from` and `to` by this factor, and those behind by the
 * same distance. */
typedef struct Change {
    double from, to, factor; /* [m], [m], [-] */
} Change;

static double moved(const Change *change, double arc) {
    const double inside = fmin(fmax(arc, change->from), change->to) - change->from;
    return arc + inside * (change->factor - 1);
}

/* Where the section, or the line, begins and ends. */
static Change change_of(const CpsLine *line, int section, double length) {
    Change change = {.to = line->length};
    if (section >= 0) {
        change.from = 0;
        for (int k = 0; k < section; k++) change.from += line->section[k].length;
        change.to = change.from + line->section[section].length;
    }
    change.factor = length / (change.to - change.from);
    return change;
}

void cps_line_resize(CpsLine *line, int section, double length, const CpsLineArrays *arrays) {
    const Change change = change_of(line, section, length);
    double at = 0;
    for (int e = 0; line->element_length && e < line->element_count; e++) {
        const double l = line->element_length[e], middle = at + 0.5 * l;
        const bool inside = middle > change.from && middle < change.to;
        at += l;
        arrays->element_length[e] = inside ? l * change.factor : l;
    }
    if (line->element_length) line->element_length = arrays->element_length;
    for (int k = 0; k < line->section_count; k++) {
        arrays->section[k] = line->section[k];
        if (section < 0) arrays->section[k].length *= change.factor;
        if (section == k) arrays->section[k].length = length;
    }
    if (line->section_count > 0) line->section = arrays->section;
    for (int k = 0; k < line->point_weight_count; k++) {
        arrays->point_weight[k] = line->point_weight[k];
        arrays->point_weight[k].arc_length = moved(&change, line->point_weight[k].arc_length);
    }
    if (line->point_weight_count > 0) line->point_weight = arrays->point_weight;
    for (int k = 0; k < line->zone_count; k++) {
        const CpsFrictionZone zone = line->zone[k];
        arrays->zone[k] =
            (CpsFrictionZone){moved(&change, zone.from), moved(&change, zone.to), zone.factor};
    }
    if (line->zone_count > 0) line->zone = arrays->zone;
    /* the sum of its sections, where it has some */
    line->length = length;
    if (section < 0) return;
    line->length = 0;
    for (int k = 0; k < line->section_count; k++) line->length += line->section[k].length;
}
