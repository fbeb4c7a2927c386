/* SPDX-License-Identifier: BSD-3-Clause */
/* Random scenes whose lines have sections, clumps and buoys. */
#include <math.h>

#include "random_scene_maker.h"

static double element_length(const CpsLine *line, int e) {
    return line->element_length ? line->element_length[e] : line->length / line->element_count;
}

/* One to four sections, which end at random nodes: lighter or heavier, softer or stiffer by up to a
 * factor of ten, a fifth of them without weight. An inextensible line stays so. */
static void add_sections(Maker *maker, CpsLine *line, CpsSection *section) {
    Random *random = &maker->random;
    int most = 1 + random_below(random, SCENE_SECTIONS_MOST), count = 0, first = 0;
    if (most > line->element_count) most = line->element_count;
    for (int k = 0; k < most; k++) {
        const int left = most - k - 1, space = line->element_count - first - left;
        const int last = k + 1 < most ? first + 1 + random_below(random, space) : first + space;
        CpsSection *own = &section[count++];
        *own = (CpsSection){.type = k % 2 ? "wire" : "chain"};
        for (int e = first; e < last; e++) own->length += element_length(line, e);
        own->weight = random_chance(random, 0.2) ? 0 : line->weight * random_decades(random, -1, 1);
        own->stiffness = line->stiffness * random_decades(random, -1, 1);
        first = last;
    }
    line->section = section;
    line->section_count = count;
}

/* Up to three weights at random nodes between the ends, from A to B, of up to a third of the line's
 * own; four in ten are buoys. */
static void add_point_weights(Maker *maker, CpsLine *line, CpsPointWeight *point) {
    Random *random = &maker->random;
    const int count =
        line->element_count > 1 ? random_below(random, SCENE_POINT_WEIGHTS_MOST + 1) : 0;
    int node = 1;
    for (int k = 0; k < count; k++) {
        node += random_below(random, line->element_count - node);
        point[k] = (CpsPointWeight){0};
        for (int e = 0; e < node; e++) point[k].arc_length += element_length(line, e);
        point[k].weight = line->weight * line->length * random_decades(random, -3, -0.5);
        if (random_chance(random, 0.4)) point[k].weight *= -1;
    }
    line->point_weight = point;
    line->point_weight_count = count;
}

void random_scene_add_sections(Maker *maker) {
    RandomScene *out = maker->out;
    for (int i = 0; i < out->scene.line_count; i++) {
        CpsLine *line = &out->line[i];
        if (!random_chance(&maker->random, 0.2)) add_sections(maker, line, out->section[i]);
        add_point_weights(maker, line, out->point_weight[i]);
    }
}

/* A table that begins with a stiffness of EA: its rows from a hundredth of the line's weight to ten
 * times that, or of EA where it weighs nothing, each up to ten times as steep as the one before or
 * on one slope with it. */
static int make_table(Random *random, double stiffness, double force, CpsStiffnessRow *row) {
    const int rows = 2 + random_below(random, SCENE_ROWS_MOST - 1);
    double tension = force * random_decades(random, -2, 0);
    row[0] = (CpsStiffnessRow){0, 0};
    for (int k = 1; k < rows; k++) {
        row[k] = (CpsStiffnessRow){row[k - 1].strain + (tension - row[k - 1].tension) / stiffness,
                                   tension};
        tension *= 1 + random_decades(random, -1, 0.5);
        if (!random_chance(random, 0.2)) stiffness *= random_decades(random, 0.001, 1);
    }
    return rows;
}

void random_scene_add_tables(Maker *maker) {
    Random *random = &maker->random;
    RandomScene *out = maker->out;
    for (int i = 0; i < out->scene.line_count; i++) {
        CpsLine *line = &out->line[i];
        const double weight = line->weight * line->length;
        for (int k = 0; k < (line->section_count > 0 ? line->section_count : 1); k++) {
            CpsSection *section = line->section_count > 0 ? &out->section[i][k] : NULL;
            const double stiffness = section ? section->stiffness : line->stiffness;
            if (isinf(stiffness) || random_chance(random, 0.2)) continue;
            const int rows = make_table(random, stiffness, weight > 0 ? weight : 0.01 * stiffness,
                                        out->row[i][k]);
            if (section) {
                section->stiffness = 0; /* is not read */
                section->stiffness_row_count = rows;
                section->stiffness_row = out->row[i][k];
            } else {
                line->stiffness_row_count = rows;
                line->stiffness_row = out->row[i][k];
            }
        }
    }
}
