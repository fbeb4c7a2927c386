/* SPDX-License-Identifier: BSD-3-Clause */
/* Sections and point weights (sections.h). */
#include "evolve/sections.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/status.h"
#include "cable/two_stiffnesses.h"
#include "evolve/ranges.h"
#include "evolve/stiffness_table.h"

/* A section ends, and a weight hangs, at a node that is so near, per length of the line. */
static const double AT_NODE = 1e-9;

bool cpsi_has_sections(const CpsLine *def) {
    return def->winch[CPS_END_A].is_there || def->winch[CPS_END_B].is_there ||
           def->section_count > 0 || def->point_weight_count > 0 || cpsi_has_dynamic_stiffness(def);
}

/* The table of a section, or of a line of one make; no rows: there is none. */
typedef struct StiffnessTable {
    int count;
    const CpsStiffnessRow *row;
} StiffnessTable;

/* The dynamic stiffness of a section, or of a line of one make; NULL: it has none. */
static const CpsDynamicStiffness *dynamic_of(const CpsLine *def, int section) {
    if (def->section_count == 0) return def->has_dynamic_stiffness ? &def->dynamic_stiffness : NULL;
    const CpsSection *of = &def->section[section];
    return of->has_dynamic_stiffness ? &of->dynamic_stiffness : NULL;
}

bool cpsi_has_dynamic_stiffness(const CpsLine *def) {
    bool found = def->section_count == 0 && dynamic_of(def, 0);
    for (int k = 0; k < def->section_count; k++) found = found || dynamic_of(def, k);
    return found;
}

static StiffnessTable table_of(const CpsLine *def, int section) {
    if (def->section_count == 0)
        return (StiffnessTable){def->stiffness_row_count, def->stiffness_row};
    return (StiffnessTable){def->section[section].stiffness_row_count,
                            def->section[section].stiffness_row};
}

/* ... of the stiffness that holds: the static one where there is no other. */
static StiffnessTable table_in(const CpsLine *def, int section, bool is_dynamic) {
    const CpsDynamicStiffness *fast = is_dynamic ? dynamic_of(def, section) : NULL;
    return fast ? (StiffnessTable){fast->row_count, fast->row} : table_of(def, section);
}

/* [N] EA without tension. */
static double stiffness_of(const CpsLine *def, int section) {
    const StiffnessTable table = table_of(def, section);
    if (table.count > 0) return cpsi_stiffness_table_first(table.row);
    return def->section_count > 0 ? def->section[section].stiffness : def->stiffness;
}

bool cpsi_is_elastic(const CpsLine *def) { return isfinite(stiffness_of(def, 0)); }

bool cpsi_has_breaking_load(const CpsLine *def) {
    bool found = def->section_count == 0 && def->has_breaking_load;
    for (int k = 0; k < def->section_count; k++) found = found || def->section[k].has_breaking_load;
    return found;
}

bool cpsi_has_break_at(const CpsLine *def) {
    bool found = def->section_count == 0 && def->has_break_at;
    for (int k = 0; k < def->section_count; k++) found = found || def->section[k].has_break_at;
    return found;
}

static double compliance_of(double stiffness) { return isinf(stiffness) ? 0 : 1 / stiffness; }

double cpsi_mean_compliance(const CpsLine *def) {
    if (def->section_count == 0) return compliance_of(stiffness_of(def, 0));
    double sum = 0;
    for (int k = 0; k < def->section_count; k++)
        sum += def->section[k].length * compliance_of(stiffness_of(def, k));
    return sum / def->length;
}

double cpsi_mean_weight(const CpsLine *def) {
    if (!cpsi_has_sections(def)) return def->weight;
    double sum = def->section_count > 0 ? 0 : def->length * def->weight;
    for (int k = 0; k < def->section_count; k++)
        sum += def->section[k].length * def->section[k].weight;
    for (int k = 0; k < def->point_weight_count; k++) sum += fabs(def->point_weight[k].weight);
    return sum / def->length;
}

/* ---- check ---- */

static CpsStatus fail(CpsError *err, const char *key, int index, const CpsLine *def,
                      const char *found) {
    char place[64];
    if (index < 0)
        return cpsi_fail_inside(err,
                                cpsi_fail(err, CPS_ERR_ARGUMENT, "line '%s': %s %s", def->name, key,
                                          found),
                                "%s", key);
    snprintf(place, sizeof place, "%s[%d]", key, index + 1);
    return cpsi_fail_inside(err,
                            cpsi_fail(err, CPS_ERR_ARGUMENT, "line '%s': %s: number %d %s",
                                      def->name, key, index + 1, found),
                            "%s", place);
}

static bool is_stiffness(double stiffness) {
    return cpsi_is_positive(stiffness) || stiffness == INFINITY;
}

/* A node of the line, and its arc length [m]. */
typedef struct Walk {
    int node;
    double arc;
} Walk;

/* Move on to the node at `at` [m] or the first one behind it. Is it there? */
static bool walk_to(const CpsLine *def, double at, Walk *walk) {
    const double near = AT_NODE * def->length;
    while (walk->node < def->element_count && walk->arc < at - near)
        walk->arc += cpsi_element_length(def, walk->node++);
    return fabs(walk->arc - at) <= near;
}

/* Check the stiffness of section k, or of a line of one make. */
static CpsStatus check_stiffness(const CpsLine *def, int k, CpsError *err) {
    const bool whole = def->section_count == 0;
    const char *key = whole ? "stiffness" : "sections";
    const StiffnessTable table = table_of(def, k);
    char fault[200], found[240];
    if (table.count != 0) {
        if (!cpsi_stiffness_table_fault(table.row, table.count, fault, sizeof fault)) return CPS_OK;
        snprintf(found, sizeof found, "%s %s", whole ? "as a table" : "has a table that", fault);
        return fail(err, key, whole ? -1 : k, def, found);
    }
    if (is_stiffness(stiffness_of(def, k))) return CPS_OK;
    if (whole)
        snprintf(found, sizeof found,
                 "is %g N, expected a positive number, or infinity for an inextensible line",
                 def->stiffness);
    else
        snprintf(found, sizeof found,
                 "has the stiffness %g N, expected a positive number, or infinity where all "
                 "sections are inextensible",
                 def->section[k].stiffness);
    return fail(err, key, whole ? -1 : k, def, found);
}

/* Check the dynamic stiffness of section k, or of a line of one make. */
static CpsStatus check_dynamic(const CpsLine *def, int k, CpsError *err) {
    const bool whole = def->section_count == 0;
    const char *key = whole ? "dynamic_stiffness" : "sections",
               *has = whole ? "" : "has a dynamic stiffness that ";
    const CpsDynamicStiffness *fast = dynamic_of(def, k);
    const StiffnessTable slow = table_of(def, k);
    char fault[200], found[280];
    if (!fast) return CPS_OK;
    if (fast->row_count != 0) {
        if (cpsi_stiffness_table_fault(fast->row, fast->row_count, fault, sizeof fault)) {
            snprintf(found, sizeof found, "%s %s", whole ? "as a table" : has, fault);
            return fail(err, key, whole ? -1 : k, def, found);
        }
    } else if (!cpsi_is_positive(fast->stiffness)) {
        snprintf(found, sizeof found, "%sis %g N, expected a positive finite number", has,
                 fast->stiffness);
        return fail(err, key, whole ? -1 : k, def, found);
    }
    if (!isfinite(stiffness_of(def, k))) {
        snprintf(found, sizeof found, "%sstands beside an inextensible one: give a finite one",
                 has);
        return fail(err, key, whole ? -1 : k, def, found);
    }
    double at, strain[2];
    if (!cpsi_stiffness_is_softer(stiffness_of(def, k), slow.row, slow.count, fast, &at, strain))
        return CPS_OK;
    snprintf(found, sizeof found,
             "%sis softer than the static one at %g N, with the strain %g there instead of %g: "
             "expected one that is nowhere softer",
             has, at, strain[1], strain[0]);
    return fail(err, key, whole ? -1 : k, def, found);
}

static CpsStatus check_section(const CpsLine *def, int k, CpsError *err) {
    const CpsSection *section = &def->section[k];
    char found[160];
    if (!cpsi_is_positive(section->length)) {
        snprintf(found, sizeof found, "is %g m long, expected a positive finite number",
                 section->length);
        return fail(err, "sections", k, def, found);
    }
    if (!cpsi_is_not_negative(section->weight)) {
        snprintf(found, sizeof found, "has the weight %g N/m, expected a finite number >= 0",
                 section->weight);
        return fail(err, "sections", k, def, found);
    }
    CpsStatus status = check_stiffness(def, k, err);
    if (status == CPS_OK) status = check_dynamic(def, k, err);
    if (status != CPS_OK) return status;
    if (section->has_breaking_load && !cpsi_is_positive(section->breaking_load)) {
        snprintf(found, sizeof found, "has the breaking load %g N, expected a positive number",
                 section->breaking_load);
        return fail(err, "sections", k, def, found);
    }
    if (section->has_break_at && !cpsi_is_positive(section->break_at)) {
        snprintf(found, sizeof found, "has break_at %g N, expected a positive number",
                 section->break_at);
        return fail(err, "sections", k, def, found);
    }
    if (isfinite(stiffness_of(def, k)) != cpsi_is_elastic(def))
        return fail(err, "sections", k, def,
                    "is inextensible or elastic, those before it are not: give all sections a "
                    "finite stiffness, or none");
    return CPS_OK;
}

static CpsStatus check_sections(const CpsLine *def, CpsError *err) {
    double at = 0;
    Walk walk = {0};
    char found[200];
    for (int k = 0; k < def->section_count; k++) {
        const CpsStatus status = check_section(def, k, err);
        if (status != CPS_OK) return status;
        const int first = walk.node;
        at += def->section[k].length;
        if (walk_to(def, at, &walk) && walk.node > first) continue;
        snprintf(found, sizeof found,
                 "ends at %.12g m, where no node is (the next one lies at "
                 "%.12g m): let elements end there",
                 at, walk.arc);
        return fail(err, "sections", k, def, found);
    }
    if (def->section_count == 0 || fabs(at - def->length) <= AT_NODE * def->length) return CPS_OK;
    snprintf(found, sizeof found, "are %.12g m long together, but length is %.12g m", at,
             def->length);
    return fail(err, "sections", -1, def, found);
}

static CpsStatus check_point_weights(const CpsLine *def, CpsError *err) {
    Walk walk = {0};
    char found[200];
    for (int k = 0; k < def->point_weight_count; k++) {
        const CpsPointWeight *point = &def->point_weight[k];
        if (!cpsi_is_usable(point->weight)) {
            snprintf(found, sizeof found, "weighs %g N, expected a finite number", point->weight);
            return fail(err, "point_weights", k, def, found);
        }
        if (k > 0 && point->arc_length < point[-1].arc_length) {
            snprintf(found, sizeof found,
                     "is at %.12g m, the one before it at %.12g m: give them in order from A to B",
                     point->arc_length, point[-1].arc_length);
            return fail(err, "point_weights", k, def, found);
        }
        if (walk_to(def, point->arc_length, &walk) && walk.node > 0 &&
            walk.node < def->element_count)
            continue;
        snprintf(found, sizeof found,
                 "is at %.12g m, expected a node between the ends (the next one lies at %.12g m): "
                 "let elements end there",
                 point->arc_length, walk.arc);
        return fail(err, "point_weights", k, def, found);
    }
    return CPS_OK;
}

CpsStatus cpsi_sections_check(const CpsScene *scene, const CpsLine *def, CpsError *err) {
    char found[160];
    if (def->section_count < 0 || (def->section_count > 0 && !def->section))
        return fail(err, "sections", -1, def, "are a negative number, or NULL");
    if (def->point_weight_count < 0 || (def->point_weight_count > 0 && !def->point_weight))
        return fail(err, "point_weights", -1, def, "are a negative number, or NULL");
    if (def->section_count == 0 && !cpsi_is_not_negative(def->weight)) {
        snprintf(found, sizeof found, "is %g N/m, expected a finite number >= 0", def->weight);
        return fail(err, "weight", -1, def, found);
    }
    CpsStatus status = def->section_count == 0 ? check_stiffness(def, 0, err) : CPS_OK;
    if (status == CPS_OK && def->section_count == 0) status = check_dynamic(def, 0, err);
    if (status != CPS_OK) return status;
    if (def->section_count == 0 && def->has_breaking_load &&
        !cpsi_is_positive(def->breaking_load)) {
        snprintf(found, sizeof found, "is %g N, expected a positive finite number",
                 def->breaking_load);
        return fail(err, "breaking_load", -1, def, found);
    }
    if (def->section_count == 0 && def->has_break_at && !cpsi_is_positive(def->break_at)) {
        snprintf(found, sizeof found, "is %g N, expected a positive finite number", def->break_at);
        return fail(err, "break_at", -1, def, found);
    }
    status = check_sections(def, err);
    if (status == CPS_OK) status = check_point_weights(def, err);
    if (status != CPS_OK) return status;
    const double weight = cpsi_mean_weight(def);
    if (!(weight > 0) || cpsi_is_direction(scene->gravity)) return CPS_OK;
    snprintf(found, sizeof found,
             "is %g N/m, but gravity is zero and has no direction: give the "
             "scene a gravity",
             weight);
    return fail(err, "weight", -1, def, found);
}

/* ---- fill ---- */

/* What a section has, or a line of one make. */
typedef struct Make {
    double weight, compliance, breaking_load, break_at;
} Make;

static Make make_of(const CpsLine *def, int section) {
    if (def->section_count == 0)
        return (Make){def->weight, compliance_of(stiffness_of(def, 0)),
                      def->has_breaking_load ? def->breaking_load : INFINITY,
                      def->has_break_at ? def->break_at : INFINITY};
    const CpsSection *of = &def->section[section];
    return (Make){of->weight, compliance_of(stiffness_of(def, section)),
                  of->has_breaking_load ? of->breaking_load : INFINITY,
                  of->has_break_at ? of->break_at : INFINITY};
}

/* Where sections end along a line: the section of the elements asked for, from A to B. */
typedef struct Along {
    int section;
    double end; /* [m] of it */
} Along;

static int section_at(const CpsLine *def, double middle, Along *at) {
    if (at->section == 0 && at->end == 0)
        at->end = def->section_count > 0 ? def->section[0].length : INFINITY;
    while (middle > at->end && at->section + 1 < def->section_count)
        at->end += def->section[++at->section].length;
    return at->section;
}

/* The springs of the next element by this table; returns their number. */
static int fill_springs(const CpsiElasticity *to, StiffnessTable table, int first, int e) {
    if (table.count == 0) return 0;
    const int count = cpsi_stiffness_table_springs(table.row, table.count, &to->spring_start[first],
                                                   &to->spring_stiffness[first]);
    for (int i = 0; i < count; i++) to->spring_element[first + i] = e;
    return count;
}

int cpsi_spring_count(const CpsLine *def, bool is_dynamic) {
    int count = 0;
    double from = 0;
    Along at = {0};
    for (int e = 0; e < def->element_count; e++) {
        const double l = cpsi_element_length(def, e);
        const StiffnessTable table =
            table_in(def, section_at(def, from + 0.5 * l, &at), is_dynamic);
        if (table.count > 0)
            count += cpsi_stiffness_table_springs(table.row, table.count, NULL, NULL);
        from += l;
    }
    return count;
}

/* How the elements of a line with two stiffnesses stretch by one of them. */
static void fill_elasticity(CpsiLine *line, const CpsLine *def, bool is_dynamic) {
    CpsiElasticity *to = &line->two.elasticity[is_dynamic ? CPSI_DYNAMIC : CPSI_STATIC];
    Along at = {0};
    int springs = 0;
    for (int e = 0; e + 1 < line->n; e++) {
        const int k = section_at(def, line->arc_length[e] + 0.5 * line->natural_length[e], &at);
        const StiffnessTable table = table_in(def, k, is_dynamic);
        const CpsDynamicStiffness *fast = is_dynamic ? dynamic_of(def, k) : NULL;
        const double stiffness = table.count > 0 ? cpsi_stiffness_table_first(table.row)
                                 : fast          ? fast->stiffness
                                                 : stiffness_of(def, k);
        to->compliance_factor[e] = 1 / stiffness / line->compliance;
        to->spring_at[e] = springs;
        springs += fill_springs(to, table, springs, e);
        to->spring_at[e + 1] = springs;
    }
}

static void fill_elements(CpsiLine *line, const CpsLine *def, double weight) {
    Along at = {0};
    int springs = 0;
    for (int e = 0; e + 1 < line->n; e++) {
        const double middle = line->arc_length[e] + 0.5 * line->element_length[e];
        const int k = section_at(def, middle, &at);
        const Make make = make_of(def, k);
        if (line->spring_count > 0) {
            line->spring_at[e] = springs;
            const CpsiElasticity own = {.spring_element = line->spring_element,
                                        .spring_start = line->spring_start,
                                        .spring_stiffness = line->spring_stiffness};
            springs += fill_springs(&own, table_of(def, k), springs, e);
            line->spring_at[e + 1] = springs;
        }
        if (line->has_breaking_load) line->breaking_load[e] = make.breaking_load;
        if (line->has_break_at) line->break_at[e] = make.break_at;
        if (!line->has_sections) continue;
        line->weight_factor[e] = weight > 0 ? make.weight / weight : 1;
        line->compliance_factor[e] =
            def->section_count > 0 && line->compliance > 0 ? make.compliance / line->compliance : 1;
    }
}

void cpsi_sections_fill(CpsiLine *line, const CpsLine *def) {
    const double weight = cpsi_mean_weight(def);
    fill_elements(line, def, weight);
    if (!line->has_sections) return;
    if (line->two.exists) {
        fill_elasticity(line, def, false);
        fill_elasticity(line, def, true);
        cpsi_line_set_stiffness(line);
    }
    for (int j = 0; j < line->n; j++) {
        double sum = 0;
        if (j > 0) sum += 0.5 * line->element_length[j - 1] * line->weight_factor[j - 1];
        if (j + 1 < line->n) sum += 0.5 * line->element_length[j] * line->weight_factor[j];
        line->weight_length[j] = sum;
    }
    if (!(weight > 0)) return;
    Walk walk = {0};
    for (int k = 0; k < def->point_weight_count; k++) {
        walk_to(def, def->point_weight[k].arc_length, &walk);
        line->weight_length[walk.node] += def->point_weight[k].weight / weight;
    }
}
