/* SPDX-License-Identifier: BSD-3-Clause */
/* Comparison of what a file says of a line with its scene (compare.h). */
#include "compare.h"
#include "damping.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elongation.h"

/* The section of element i, whose middle lies at `middle`; NULL without sections. */
static const CpsSection *section_at(const CpsLine *line, double middle) {
    const CpsSection *section = line->section;
    double end = 0;
    for (int k = 0; k < line->section_count; k++) {
        section = &line->section[k];
        end += section->length;
        if (middle < end) break;
    }
    return line->section_count > 0 ? section : NULL;
}

/* The rows of its table; 0: it has none. */
static int table_of(const CpsLine *line, const CpsSection *section, const CpsStiffnessRow **row) {
    *row = section ? section->stiffness_row : line->stiffness_row;
    return section ? section->stiffness_row_count : line->stiffness_row_count;
}

/* The dynamic stiffness there; NULL: there is none. */
static const CpsDynamicStiffness *dynamic_of(const CpsLine *line, const CpsSection *section) {
    const bool has = section ? section->has_dynamic_stiffness : line->has_dynamic_stiffness;
    if (!has) return NULL;
    return section ? &section->dynamic_stiffness : &line->dynamic_stiffness;
}

static bool has_dynamic(const CpsLine *line) {
    bool found = line->section_count == 0 && line->has_dynamic_stiffness;
    for (int k = 0; k < line->section_count; k++)
        found = found || line->section[k].has_dynamic_stiffness;
    return found;
}

static double softness(const CpsLine *line, const CpsSection *section) {
    const CpsStiffnessRow *row;
    if (table_of(line, section, &row) > 0) return row[1].strain / row[1].tension;
    const double stiffness = section ? section->stiffness : line->stiffness;
    return isinf(stiffness) ? 0 : 1 / stiffness;
}

/* [N] What the nodes weigh in the scene, (nodes): half of their elements, and what hangs there; and
 * the sum of the sizes of these terms. */
void node_weights(const CpsLine *line, const Record *r, double *weight, double *sizes) {
    double arc = r->arc_from;
    for (size_t j = 0; j < r->nodes; j++) weight[j] = sizes[j] = 0;
    for (size_t i = 0; i < r->elements; i++) {
        const double l = r->element_length[i];
        const CpsSection *section = section_at(line, arc + l / 2);
        const double half = l * (section ? section->weight : line->weight) / 2;
        weight[i] += half;
        weight[i + 1] += half;
        arc += l;
        for (int k = 0; k < line->point_weight_count; k++) {
            const CpsPointWeight *point = &line->point_weight[k];
            if (fabs(point->arc_length - arc) > 1e-8 * line->length) continue;
            if (i + 1 == r->elements && r->on_drum[1]) continue;
            weight[i + 1] += point->weight;
            sizes[i + 1] += fabs(point->weight);
        }
    }
    for (size_t j = 0; j < r->nodes; j++) sizes[j] = fmax(sizes[j], fabs(weight[j]));
}

/* [N/m] All weights over the length, buoys as if they hung: the unit of the file's weights. */
double mean_weight(const CpsLine *line) {
    double sum = line->section_count > 0 ? 0 : line->weight * line->length;
    for (int k = 0; k < line->section_count; k++)
        sum += line->section[k].weight * line->section[k].length;
    for (int k = 0; k < line->point_weight_count; k++) sum += fabs(line->point_weight[k].weight);
    return sum / line->length;
}

static void compare_weights(Compare *compare, const CpsLine *line, const Record *r) {
    const double mean = mean_weight(line);
    if (!(mean > 0)) return;
    double *own = calloc(2 * r->nodes, sizeof *own), *sizes = own + r->nodes;
    if (!own) {
        find(compare, "no memory for the weights of %s", line->name);
        return;
    }
    node_weights(line, r, own, sizes);
    for (size_t j = 0; j < r->nodes; j++) {
        if (fabs(r->weight_length[j] * mean - own[j]) <= COMPUTED * (sizes[j] + mean)) continue;
        find(compare, "weight_length of %s at node %zu is %.17g m, in the scene %.17g m",
             line->name, j, r->weight_length[j], own[j] / mean);
        break;
    }
    free(own);
}

/* Masses that move with the nodes: half of each element, and what hangs there. */
static void compare_masses(Compare *compare, const CpsLine *line, const Record *r) {
    double arc = 0, next = 0; /* [kg] of the half element before */
    for (size_t j = 0; j < r->nodes; j++) {
        double own = next, sizes;
        if (j < r->elements) {
            const double l = r->element_length[j];
            const CpsSection *section = section_at(line, arc + l / 2);
            next = l * (section ? section->inertia : line->inertia) / 2;
            own += next;
        }
        sizes = own;
        for (int k = 0; k < line->point_weight_count; k++) {
            const CpsPointWeight *point = &line->point_weight[k];
            if (fabs(point->arc_length - arc) <= 1e-8 * line->length) own += point->inertia;
        }
        if (!(fabs(r->mass[j] - own) <= COMPUTED * (sizes + own))) {
            find(compare, "node_mass of %s at node %zu is %.17g kg, in the scene %.17g kg",
                 line->name, j, r->mass[j], own);
            return;
        }
        if (j < r->elements) arc += r->element_length[j];
    }
}

/* Stiffness along the line, its damping, and whether its weights differ. */
static void compare_sections(Compare *compare, const CpsLine *line, const Record *r) {
    same_number(compare, "damping", line->name, r->damping ? r->damping->coefficient : 0,
                r->mass ? line->damping : 0);
    double arc = 0, mean = 0;
    for (size_t i = 0; i < r->elements; i++) {
        const double l = r->element_length[i],
                     given = softness(line, section_at(line, arc + l / 2));
        mean += l * given / line->length;
        arc += l;
        if (fabs(damping_compliance(r, i) - given) <= COMPUTED * given) continue;
        find(compare, "compliance of %s: %.17g in element %zu, in the scene %.17g", line->name,
             damping_compliance(r, i), i, given);
        return;
    }
    if (line->section_count == 0) mean = softness(line, NULL);
    const bool computed = line->section_count > 0 || line->stiffness_row_count > 0;
    if (!(fabs(r->compliance - mean) <= (computed ? COMPUTED * mean : 0)))
        find(compare, "compliance of %s is %.17g, in the scene %.17g", line->name, r->compliance,
             mean);
    const bool uniform =
        line->section_count == 0 && line->point_weight_count == 0 && !has_dynamic(line);
    if (r->drums) return; /* its weights are in every step */
    if (uniform != (r->weight_length == NULL))
        find(compare, "sections or point weights of %s", line->name);
    else if (!uniform)
        compare_weights(compare, line, r);
}

/* Do the springs of the file reach every row of the scene's tables, and the slope beyond? */
static void compare_tables(Compare *compare, const CpsLine *line, const Record *r) {
    double arc = 0;
    for (size_t i = 0; i < r->elements; i++) {
        const CpsStiffnessRow *row;
        const double l = r->element_length[i];
        const int rows = table_of(line, section_at(line, arc + l / 2), &row);
        arc += l;
        if (rows == 0 && r->spring_of && r->spring_of[i] < r->spring_of[i + 1])
            find(compare, "springs of %s in element %zu, in the scene none", line->name, i);
        for (int k = 1; k < rows + 1; k++) {
            const int last = rows - 1;
            const double by = k < rows ? 0 : row[last].strain,
                         slope = (row[last].tension - row[last - 1].tension) /
                                 (row[last].strain - row[last - 1].strain);
            const double strain = k < rows ? row[k].strain : row[last].strain + by,
                         given = k < rows ? row[k].tension : row[last].tension + slope * by,
                         found = (double)elongation_tension(r, i, strain);
            if (fabs(found - given) <= COMPUTED * given) continue;
            find(compare,
                 "tension of %s in element %zu at the strain %g: %.17g N, in the scene "
                 "%.17g N",
                 line->name, i, strain, found, given);
            return;
        }
    }
}

/* [N] The tension at a strain by the scene's dynamic stiffness, where it has none by its static
 * one. */
static double tension_given(const CpsLine *line, const CpsSection *section, double strain) {
    const CpsDynamicStiffness *fast = dynamic_of(line, section);
    const CpsStiffnessRow *row;
    int rows = table_of(line, section, &row);
    double stiffness = section ? section->stiffness : line->stiffness;
    if (fast) {
        rows = fast->row_count;
        row = fast->row;
        stiffness = fast->stiffness;
    }
    if (rows == 0) return stiffness * strain;
    int k = 1;
    while (k + 1 < rows && row[k].strain < strain) k++;
    const double share = (strain - row[k - 1].strain) / (row[k].strain - row[k - 1].strain);
    return row[k - 1].tension + share * (row[k].tension - row[k - 1].tension);
}

/* The dynamic stiffness of the file against the scene's, at strains from 0 to beyond its rows. */
static void compare_dynamic(Compare *compare, const CpsLine *line, const Record *r) {
    if (has_dynamic(line) != r->has_dynamic) {
        find(compare, "dynamic stiffness of %s", line->name);
        return;
    }
    if (!r->has_dynamic) return;
    Record fast = *r;
    elongation_use(&fast, true);
    fast.rest_strain = NULL;
    double arc = 0;
    for (size_t i = 0; i < r->elements; i++) {
        const CpsSection *section = section_at(line, arc + r->element_length[i] / 2);
        const CpsDynamicStiffness *given = dynamic_of(line, section);
        const CpsStiffnessRow *row;
        int rows = table_of(line, section, &row);
        arc += r->element_length[i];
        if (given) rows = given->row_count;
        if (given) row = given->row;
        for (int k = 1; k < rows + 2; k++) {
            const double last = rows > 0 ? row[rows - 1].strain : 0.1,
                         strain = k < rows ? row[k].strain : last * (1 + k - rows),
                         expected = tension_given(line, section, strain),
                         found = (double)elongation_tension(&fast, i, strain);
            if (fabs(found - expected) <= COMPUTED * expected) continue;
            find(compare,
                 "dynamic tension of %s in element %zu at the strain %g: %.17g N, in the scene "
                 "%.17g N",
                 line->name, i, strain, found, expected);
            return;
        }
    }
}

static void compare_breaking_load(Compare *compare, const CpsLine *line, const Record *r) {
    double arc = 0;
    bool any = line->section_count == 0 && line->has_breaking_load;
    for (int k = 0; k < line->section_count; k++) any = any || line->section[k].has_breaking_load;
    if (any != (r->breaking_load != NULL)) {
        find(compare, "breaking_load of %s", line->name);
        return;
    }
    if (!any) return;
    for (size_t i = 0; i < r->elements; i++) {
        const CpsSection *section = section_at(line, arc + r->element_length[i] / 2);
        const bool has = section ? section->has_breaking_load : line->has_breaking_load;
        const double load = section ? section->breaking_load : line->breaking_load;
        arc += r->element_length[i];
        if (r->breaking_load[i] == (has ? load : INFINITY)) continue;
        find(compare, "breaking_load of %s: %.17g in element %zu", line->name, r->breaking_load[i],
             i);
        return;
    }
}

static void compare_break_at(Compare *compare, const CpsLine *line, const Record *r) {
    double arc = 0;
    bool any = line->section_count == 0 && line->has_break_at;
    for (int k = 0; k < line->section_count; k++) any = any || line->section[k].has_break_at;
    if (any != (r->break_at != NULL)) {
        find(compare, "break_at of %s", line->name);
        return;
    }
    if (!any) return;
    for (size_t i = 0; i < r->elements; i++) {
        const CpsSection *section = section_at(line, arc + r->element_length[i] / 2);
        const bool has = section ? section->has_break_at : line->has_break_at;
        const double load = section ? section->break_at : line->break_at;
        arc += r->element_length[i];
        if (r->break_at[i] == (has ? load : INFINITY)) continue;
        find(compare, "break_at of %s: %.17g in element %zu", line->name, r->break_at[i], i);
        return;
    }
}

void compare_line(Compare *compare, const CpsLine *line, const Record *r) {
    if (r->elements != (size_t)line->element_count) {
        find(compare, "%zu elements of %s, in the scene %d", r->elements, line->name,
             line->element_count);
        return;
    }
    for (size_t i = 0; i < r->elements; i++) {
        const double given =
            line->element_length ? line->element_length[i] : line->length / line->element_count;
        if (fabs(r->element_length[i] - given) <= COPIED * given) continue;
        find(compare, "element_length of %s is %.17g, in the scene %.17g", line->name,
             r->element_length[i], given);
        return;
    }
    compare_sections(compare, line, r);
    if (r->mass) compare_masses(compare, line, r);
    compare_tables(compare, line, r);
    compare_dynamic(compare, line, r);
    compare_breaking_load(compare, line, r);
    compare_break_at(compare, line, r);
    /* what zones do is in the mean factors, which the reader has made of those in the file */
    double at = 0;
    for (size_t j = 0; j < r->nodes; j++) {
        const double before = j > 0 ? r->element_length[j - 1] : 0,
                     after = j < r->elements ? r->element_length[j] : 0;
        at += before;
        double sum = (before + after) / 2, most = 1;
        for (int k = 0; k < line->zone_count; k++) {
            const CpsFrictionZone *zone = &line->zone[k];
            const double common =
                fmin(at + after / 2, zone->to) - fmax(at - before / 2, zone->from);
            if (common > 0) {
                sum += (zone->factor - 1) * common;
                most = fmax(most, zone->factor);
            }
        }
        const double factor = sum / ((before + after) / 2), file = r->factor ? r->factor[j] : 1;
        if (fabs(file - factor) <= COMPUTED * most * line->length / (before + after)) continue;
        find(compare, "friction_zones of %s: factor %.17g at node %zu, in the scene %.17g",
             line->name, file, j, factor);
        return;
    }
}
