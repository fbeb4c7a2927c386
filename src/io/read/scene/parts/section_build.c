/* SPDX-License-Identifier: BSD-3-Clause */
/* Sections and weights (section_build.h). */
#include "io/read/scene/parts/section_build.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/math.h"

/* A type's weight in water: that of its mass less that of the water that it displaces. `place` is
 * the mapping that gives the mass. */
static CpsStatus submerged(const CpsiMaterials *m, const CpsiYaml *place, double mass,
                           double diameter, double *weight) {
    *weight = (mass - m->water * 0.25 * CPSI_PI * diameter * diameter) * m->gravity;
    if (*weight >= 0) return CPS_OK;
    return cpsi_document_fail(m->d, CPS_ERR_INPUT, cpsi_yaml_child(place, "diameter"),
                              "'diameter': found %g m, with which %g kg/m float (%g N/m): expected "
                              "a line that sinks; give buoys as 'point_weights'",
                              diameter, mass, *weight);
}

double cpsi_moving_mass(double inertia, double mass) {
    if (!isnan(inertia)) return inertia;
    return isnan(mass) ? 0 : mass;
}

CpsStatus cpsi_line_weight_build(const CpsiMaterials *m, const CpsiLineValues *values,
                                 CpsLine *line) {
    line->inertia = cpsi_moving_mass(values->inertia, values->mass);
    if (isnan(values->mass)) return CPS_OK;
    return submerged(m, values->node, values->mass, values->diameter, &line->weight);
}

CpsStatus cpsi_stiffness_build(const CpsiMaterials *m, const CpsiStiffnessValues *values,
                               int *count, const CpsStiffnessRow **row) {
    *count = 0;
    *row = NULL;
    if (!values->node) return CPS_OK;
    const int rows = values->strain.columns;
    if (values->tension.columns != rows)
        return cpsi_document_fail(m->d, CPS_ERR_INPUT, cpsi_yaml_child(values->node, "tension"),
                                  "'tension': found %d numbers, expected as many as 'strain' has, "
                                  "%d",
                                  values->tension.columns, rows);
    CpsStiffnessRow *made = CPSI_POOL_TAKE(m->pool, rows, CpsStiffnessRow);
    if (!made) return cpsi_document_no_memory(m->d);
    for (int k = 0; k < rows; k++)
        made[k] = (CpsStiffnessRow){values->strain.x[k], values->tension.x[k]};
    *count = rows;
    *row = made;
    return CPS_OK;
}

CpsStatus cpsi_dynamic_stiffness_build(const CpsiMaterials *m, const CpsiDynamicValues *values,
                                       bool *has, CpsDynamicStiffness *out) {
    *has = values->table.node || !isnan(values->stiffness);
    *out = (CpsDynamicStiffness){.stiffness = isnan(values->stiffness) ? 0 : values->stiffness};
    return cpsi_stiffness_build(m, &values->table, &out->row_count, &out->row);
}

/* ---- elements ---- */

/* The sum of `count` lengths, the longest 1, that fall by equal factors to 1/ratio. */
static double sum_of(double count, double ratio) {
    const double fall = log(ratio) / (count - 1);
    return count > 1 && fall > 0 ? -expm1(-fall * count) / -expm1(-fall) : count;
}

double cpsi_graded_count(double length, double count, double most, const CpsiGradeValues *grade) {
    if (!isnan(count)) return count;
    /* lengths that are a whole number of elements to rounding get that number */
    const double want = length / most * (1 - 1e-12);
    /* far beyond the limit the factors do not matter */
    if (!grade->node || !(want < 1e12)) return fmax(1, ceil(want));
    const double halves = grade->towards == CPSI_TOWARDS_BOTH ? 2 : 1;
    double low = 0, high = fmax(1, ceil(want / halves));
    while (halves * sum_of(high, grade->ratio) < want) {
        low = high;
        high *= 2;
    }
    while (high - low > 1) {
        const double middle = floor(0.5 * (low + high));
        if (halves * sum_of(middle, grade->ratio) < want)
            low = middle;
        else
            high = middle;
    }
    return halves * high;
}

/* ln of the length of element i of `count` over the longest one, in units of ln ratio, from -1. */
static double depth_of(int i, int count, int towards) {
    const int from_end = towards == CPSI_TOWARDS_A ? i : count - 1 - i;
    if (towards != CPSI_TOWARDS_BOTH) return count > 1 ? (double)from_end / (count - 1) - 1 : 0;
    const int near = i < count - 1 - i ? i : count - 1 - i, middle = (count - 1) / 2;
    return middle > 0 ? (double)near / middle - 1 : 0;
}

void cpsi_graded_fill(double length, int count, const CpsiGradeValues *grade, double *out) {
    double sum = 0;
    for (int i = 0; i < count; i++) {
        out[i] = grade->node ? exp(log(grade->ratio) * depth_of(i, count, grade->towards)) : 1;
        sum += out[i];
    }
    for (int i = 0; i < count; i++) out[i] = grade->node ? out[i] * (length / sum) : length / count;
}

/* ---- sections ---- */

static double count_of(const CpsiSectionValues *section) {
    return cpsi_graded_count(section->length, section->count, section->element_length,
                             &section->grade);
}

double cpsi_section_elements(const CpsiList *sections) {
    const CpsiSectionValues *section = sections->item;
    double count = 0;
    for (int k = 0; k < sections->count; k++) count += count_of(&section[k]);
    return count;
}

static int by_name(const void *a, const void *b) {
    const CpsiTypeValues *const *left = a, *const *right = b;
    return strcmp((*left)->node->key, (*right)->node->key);
}

CpsStatus cpsi_materials_sort(CpsiMaterials *m, const CpsiList *types) {
    const CpsiTypeValues *type = types->item, **sorted;
    if (types->count == 0) return CPS_OK;
    m->type = sorted = CPSI_POOL_TAKE(m->pool, types->count, const CpsiTypeValues *);
    if (!sorted) return cpsi_document_no_memory(m->d);
    m->type_count = types->count;
    for (int k = 0; k < types->count; k++) sorted[k] = &type[k];
    qsort(sorted, (size_t)types->count, sizeof *sorted, by_name);
    return CPS_OK;
}

static const CpsiTypeValues *find_type(const CpsiMaterials *m, const char *name) {
    int low = 0;
    for (int high = m->type_count; low < high;) {
        const int middle = low + (high - low) / 2, order = strcmp(m->type[middle]->node->key, name);
        if (order == 0) return m->type[middle];
        if (order < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return NULL;
}

static CpsStatus build_section(const CpsiMaterials *m, const CpsiSectionValues *values,
                               const CpsiTypeValues **type, CpsSection *section) {
    *type = find_type(m, values->type);
    if (!*type)
        return cpsi_document_fail(m->d, CPS_ERR_INPUT, cpsi_yaml_child(values->node, "type"),
                                  "'type': found '%.64s', expected the name of one of the %d types "
                                  "of the scene",
                                  values->type, m->type_count);
    *section = (CpsSection){.type = cpsi_pool_text(m->pool, values->type, strlen(values->type)),
                            .length = values->length,
                            .weight = (*type)->weight,
                            .inertia = cpsi_moving_mass((*type)->inertia, (*type)->mass),
                            .stiffness = (*type)->stiffness,
                            .has_breaking_load = !isnan((*type)->breaking_load),
                            .has_break_at = !isnan((*type)->break_at)};
    if (section->has_breaking_load) section->breaking_load = (*type)->breaking_load;
    if (section->has_break_at) section->break_at = (*type)->break_at;
    if (!section->type) return cpsi_document_no_memory(m->d);
    CpsStatus status = cpsi_stiffness_build(m, &(*type)->table, &section->stiffness_row_count,
                                            &section->stiffness_row);
    if (status == CPS_OK)
        status = cpsi_dynamic_stiffness_build(m, &(*type)->dynamic, &section->has_dynamic_stiffness,
                                              &section->dynamic_stiffness);
    if (status != CPS_OK) return status;
    if (isnan((*type)->mass)) return CPS_OK;
    return submerged(m, (*type)->node, (*type)->mass, (*type)->diameter, &section->weight);
}

/* The zone of a section whose type has a friction of its own. */
static CpsStatus add_zone(const CpsiMaterials *m, const CpsiLineValues *values,
                          const CpsiTypeValues *type, double from, double to, CpsFrictionZone *zone,
                          CpsLine *line) {
    if (type->friction == 1) return CPS_OK;
    if (values->zones.count > 0)
        return cpsi_document_fail(m->d, CPS_ERR_INPUT,
                                  cpsi_yaml_child(values->node, "friction_zones"),
                                  "'friction_zones': they do not go with the type '%.64s', which "
                                  "has a friction of its own",
                                  type->node->key);
    zone[line->zone_count++] = (CpsFrictionZone){from, to, type->friction};
    return CPS_OK;
}

CpsStatus cpsi_sections_build(const CpsiMaterials *m, const CpsiLineValues *values, CpsLine *line) {
    const CpsiSectionValues *from = values->sections.item;
    const int count = values->sections.count;
    CpsSection *section = CPSI_POOL_TAKE(m->pool, count, CpsSection);
    CpsFrictionZone *zone = CPSI_POOL_TAKE(m->pool, count, CpsFrictionZone);
    double *length = CPSI_POOL_TAKE(m->pool, line->element_count, double);
    if (!section || !zone || !length) return cpsi_document_no_memory(m->d);
    line->section = section;
    line->section_count = count;
    line->element_length = length;
    line->length = 0;
    if (values->zones.count == 0) line->zone = zone;
    for (int k = 0; k < count; k++) {
        const CpsiTypeValues *type;
        const double start = line->length, elements = count_of(&from[k]);
        CpsStatus status = build_section(m, &from[k], &type, &section[k]);
        line->length += from[k].length;
        if (status == CPS_OK) status = add_zone(m, values, type, start, line->length, zone, line);
        if (status != CPS_OK) return status;
        cpsi_graded_fill(from[k].length, (int)elements, &from[k].grade, length);
        length += (int)elements;
    }
    return CPS_OK;
}

/* ---- point weights ---- */

double cpsi_weight_in_water(const CpsiMaterials *m, double mass, double volume, double weight) {
    return isnan(mass) ? weight : (mass - m->water * volume) * m->gravity;
}

double cpsi_displaced_weight(const CpsiMaterials *m, double volume) {
    return m->water * volume * m->gravity;
}

CpsStatus cpsi_point_weights_build(const CpsiMaterials *m, const CpsiList *points, CpsLine *line) {
    const CpsiPointWeightValues *values = points->item;
    if (points->count == 0) return CPS_OK;
    CpsPointWeight *point = CPSI_POOL_TAKE(m->pool, points->count, CpsPointWeight);
    if (!point) return cpsi_document_no_memory(m->d);
    for (int k = 0; k < points->count; k++)
        point[k] =
            (CpsPointWeight){.arc_length = values[k].at,
                             .weight = cpsi_weight_in_water(m, values[k].mass, values[k].volume,
                                                            values[k].weight),
                             .inertia = cpsi_moving_mass(values[k].inertia, values[k].mass)};
    line->point_weight = point;
    line->point_weight_count = points->count;
    return CPS_OK;
}
