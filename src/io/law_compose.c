/* SPDX-License-Identifier: BSD-3-Clause */
/* Expressions of laws (see law_build.h): words that compose friction laws, and the terms of resistance laws. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/status.h"
#include "io/keys.h"
#include "io/law_build.h"

CpsStatus cpsi_law_check_map(const CpsiLawBuild *b, const CpsiYaml *node, int count, int components,
                             const char *which) {
    if (count == components) return CPS_OK;
    const CpsiYaml *map = cpsi_yaml_child(node, "map");
    return cpsi_fail_at(b->file.err, CPS_ERR_INPUT, b->file.name, map->line, map->column,
                        "'map': found %d %s, but its set has %d components: expected %d %s", count, which, components,
                        components, which);
}

/* ---- friction laws ---- */

static CpsStatus compose_coulomb(CpsiLawBuild *b, const CpsiYaml *node, CpsLaw **out) {
    static const char *const KEY[] = {"friction", "load", NULL};
    const CpsiYaml *child[2];
    CpsError found;
    double friction, load;
    CpsStatus status = cpsi_law_keys(&b->file, node, "'coulomb'", KEY, child);
    if (status == CPS_OK) status = cpsi_law_number(&b->file, child[0], "'friction'", 0, false, &friction);
    if (status == CPS_OK) status = cpsi_law_number(&b->file, child[1], "'load'", 0, false, &load);
    return status != CPS_OK ? status : CPSI_PLACED(b, node, cps_law_coulomb(friction, load, out, &found));
}

static CpsStatus compose_unit_load(CpsiLawBuild *b, const CpsiYaml *node, CpsLaw **out) {
    static const char *const KEY[] = {"load", "of", NULL};
    const CpsiYaml *child[2];
    CpsError found;
    double load;
    CpsSet *unit = NULL;
    CpsStatus status = cpsi_law_keys(&b->file, node, "'unit_load'", KEY, child);
    if (status == CPS_OK) status = cpsi_law_number(&b->file, child[0], "'load'", 0, false, &load);
    if (status == CPS_OK) status = cpsi_law_build_set(b, child[1], &unit);
    if (status == CPS_OK) status = CPSI_PLACED(b, node, cps_law_unit_load(unit, load, out, &found));
    cps_set_release(unit);
    return status;
}

static void destroy_laws(CpsLaw **law, int count) {
    while (count > 0) cps_law_destroy(law[--count]);
}

static CpsStatus compose_product(CpsiLawBuild *b, const CpsiYaml *node, CpsLaw **out) {
    CpsError found;
    if (node->kind != CPSI_YAML_SEQUENCE || node->count < 1)
        return cpsi_law_wrong(&b->file, node, "'product'", "a list of laws, as in [{interval: 60}, {disc: 500}]");
    CpsLaw **part = CPSI_POOL_TAKE(b->file.pool, node->count, CpsLaw *);
    if (!part) return cpsi_law_no_memory(&b->file);
    CpsStatus status = CPS_OK;
    int count = 0;
    for (const CpsiYaml *item = node->child; item && status == CPS_OK; item = item->next) {
        status = cpsi_law_build_law(b, item, &part[count]);
        if (status == CPS_OK) count++;
    }
    if (status == CPS_OK)
        status = CPSI_PLACED(b, node, cps_law_product(count, (const CpsLaw *const *)part, out, &found));
    destroy_laws(part, count);
    return status;
}

static CpsStatus compose_preimage(CpsiLawBuild *b, const CpsiYaml *node, CpsLaw **out) {
    static const char *const KEY[] = {"map", "of", NULL};
    const CpsiYaml *child[2];
    CpsError found;
    int rows, columns;
    double *map;
    CpsLaw *law = NULL;
    CpsComposition composition;
    CpsStatus status = cpsi_law_keys(&b->file, node, "'preimage'", KEY, child);
    if (status == CPS_OK) status = cpsi_law_matrix(&b->file, child[0], "'map'", &rows, &columns, &map);
    if (status == CPS_OK) status = cpsi_law_build_law(b, child[1], &law);
    if (status == CPS_OK) status = cpsi_law_check_map(b, node, rows, cps_law_space(law), "rows");
    if (status == CPS_OK) status = CPSI_PLACED(b, node, cps_law_preimage(columns, map, law, &composition, out, &found));
    cps_law_destroy(law);
    if (status != CPS_OK) return status;
    if (!b->has_preimage || composition > b->composition)
        b->composition = composition, b->composition_line = node->line;
    b->has_preimage = true;
    return CPS_OK;
}

/* one contact of a list: {map: B, of: law} */
static CpsStatus compose_contact(CpsiLawBuild *b, const CpsiYaml *node, const double **map, int *columns,
                                 CpsLaw **law) {
    static const char *const KEY[] = {"map", "of", NULL};
    const CpsiYaml *child[2];
    int rows, width;
    double *matrix;
    CpsStatus status = cpsi_law_keys(&b->file, node, "contact", KEY, child);
    if (status == CPS_OK) status = cpsi_law_matrix(&b->file, child[0], "'map'", &rows, &width, &matrix);
    if (status == CPS_OK) status = cpsi_law_build_law(b, child[1], law);
    if (status != CPS_OK) return status;
    *map = matrix;
    status = cpsi_law_check_map(b, node, rows, cps_law_space(*law), "rows");
    if (status == CPS_OK && *columns > 0 && width != *columns) {
        char expected[80];
        snprintf(expected, sizeof expected, "rows of %d, as in the first contact: all act on one body", *columns);
        status = cpsi_law_wrong(&b->file, child[0], "'map'", expected);
    }
    *columns = width;
    if (status == CPS_OK) return CPS_OK;
    cps_law_destroy(*law);
    *law = NULL;
    return status;
}

static CpsStatus compose_contacts(CpsiLawBuild *b, const CpsiYaml *node, CpsLaw **out) {
    CpsError found;
    if (node->kind != CPSI_YAML_SEQUENCE || node->count < 1)
        return cpsi_law_wrong(&b->file, node, "'contacts'",
                              "a list of contacts, as in [{map: [[1, 0]], of: {interval: 5}}]");
    CpsLaw **law = CPSI_POOL_TAKE(b->file.pool, node->count, CpsLaw *);
    const double **map = CPSI_POOL_TAKE(b->file.pool, node->count, const double *);
    if (!law || !map) return cpsi_law_no_memory(&b->file);
    CpsStatus status = CPS_OK;
    int count = 0, n = 0;
    for (const CpsiYaml *item = node->child; item && status == CPS_OK; item = item->next) {
        status = compose_contact(b, item, &map[count], &n, &law[count]);
        if (status == CPS_OK) count++;
    }
    if (status == CPS_OK)
        status = CPSI_PLACED(b, node, cps_law_contacts(n, count, (const CpsLaw *const *)law, map, out, &found));
    destroy_laws(law, count);
    return status;
}

CpsStatus cpsi_law_build_word(CpsiLawBuild *b, const CpsiYaml *node, CpsLaw **law) {
    static const struct {
        const char *name;
        CpsStatus (*compose)(CpsiLawBuild *b, const CpsiYaml *node, CpsLaw **out);
    } WORD[] = {{"coulomb", compose_coulomb},
                {"unit_load", compose_unit_load},
                {"product", compose_product},
                {"preimage", compose_preimage},
                {"contacts", compose_contacts}};
    for (size_t i = 0; i < sizeof WORD / sizeof WORD[0]; i++)
        if (strcmp(node->key, WORD[i].name) == 0) return WORD[i].compose(b, node, law);
    return CPS_OK;
}

CpsStatus cpsi_law_build_law(CpsiLawBuild *b, const CpsiYaml *node, CpsLaw **out) {
    CpsError found;
    CpsStatus status = CPS_OK;
    *out = NULL;
    if (node->kind == CPSI_YAML_MAPPING && node->count == 1) status = cpsi_law_build_word(b, node->child, out);
    if (status != CPS_OK || *out) return status;

    /* every other word is a set, which must hold 0 */
    CpsSet *set = NULL;
    status = cpsi_law_build_set(b, node, &set);
    if (status == CPS_OK) status = CPSI_PLACED(b, node->child, cps_law_friction(set, out, &found));
    cps_set_release(set);
    return status;
}

/* ---- terms of resistance laws ---- */

static CpsStatus term_dry(CpsiLawBuild *b, const CpsiYaml *node, CpsResistance **out) {
    CpsError found;
    CpsLaw *law = NULL;
    CpsStatus status = cpsi_law_build_law(b, node, &law);
    if (status == CPS_OK) status = CPSI_PLACED(b, node, cps_resistance_dry(law, out, &found));
    cps_law_destroy(law);
    return status;
}

static CpsStatus term_viscous(CpsiLawBuild *b, const CpsiYaml *node, CpsResistance **out) {
    CpsError found;
    int rows, columns;
    double *matrix;
    const CpsStatus status = cpsi_law_matrix(&b->file, node, "'viscous'", &rows, &columns, &matrix);
    if (status != CPS_OK) return status;
    if (rows != columns) return cpsi_law_wrong(&b->file, node, "'viscous'", "a square matrix");
    return CPSI_PLACED(b, node, cps_resistance_viscous(rows, matrix, out, &found));
}

static CpsStatus term_power(CpsiLawBuild *b, const CpsiYaml *node, CpsResistance **out) {
    static const char *const KEY[] = {"degree", "factor", "of", NULL};
    const CpsiYaml *child[3];
    CpsError found;
    double degree, factor;
    CpsLaw *law = NULL;
    CpsStatus status = cpsi_law_keys(&b->file, node, "'power'", KEY, child);
    if (status == CPS_OK) status = cpsi_law_number(&b->file, child[0], "'degree'", -INFINITY, false, &degree);
    if (status == CPS_OK) status = cpsi_law_number(&b->file, child[1], "'factor'", -INFINITY, false, &factor);
    if (status == CPS_OK) status = cpsi_law_build_law(b, child[2], &law);
    if (status == CPS_OK) status = CPSI_PLACED(b, node, cps_resistance_power(law, degree, factor, out, &found));
    cps_law_destroy(law);
    return status;
}

/* {points: [[speed, factor], ...], of: law} */
static CpsStatus term_table(CpsiLawBuild *b, const CpsiYaml *node, CpsResistance **out) {
    static const char *const KEY[] = {"points", "of", NULL};
    const CpsiYaml *child[2];
    CpsError found;
    int rows, columns;
    double *point;
    CpsLaw *law = NULL;
    CpsStatus status = cpsi_law_keys(&b->file, node, "'table'", KEY, child);
    if (status == CPS_OK) status = cpsi_law_matrix(&b->file, child[0], "'points'", &rows, &columns, &point);
    if (status != CPS_OK) return status;
    if (columns != 2) return cpsi_law_wrong(&b->file, child[0]->child, "'points'", "[speed, factor]");
    double *speed = CPSI_POOL_TAKE(b->file.pool, 2 * (size_t)rows, double);
    if (!speed) return cpsi_law_no_memory(&b->file);
    for (int i = 0; i < rows; i++) speed[i] = point[2 * i], speed[rows + i] = point[2 * i + 1];
    status = cpsi_law_build_law(b, child[1], &law);
    if (status == CPS_OK)
        status = CPSI_PLACED(b, node, cps_resistance_table(law, rows, speed, speed + rows, out, &found));
    cps_law_destroy(law);
    return status;
}

static CpsStatus build_term(CpsiLawBuild *b, const CpsiYaml *node, CpsResistance **out) {
    static const struct {
        const char *name;
        CpsStatus (*build)(CpsiLawBuild *b, const CpsiYaml *node, CpsResistance **out);
    } TERM[] = {{"dry", term_dry}, {"viscous", term_viscous}, {"power", term_power}, {"table", term_table}};
    if (node->kind != CPSI_YAML_MAPPING || node->count != 1)
        return cpsi_law_wrong(&b->file, node, "term", "one of dry, viscous, power, table, as in {dry: {disc: 500}}");
    CpsiSuggestion suggestion = {.word = node->child->key};
    for (size_t i = 0; i < sizeof TERM / sizeof TERM[0]; i++) {
        if (strcmp(node->child->key, TERM[i].name) == 0) return TERM[i].build(b, node->child, out);
        cpsi_suggest(&suggestion, TERM[i].name);
    }
    return cpsi_fail_at(b->file.err, CPS_ERR_INPUT, b->file.name, node->child->line, node->child->column,
                        "unknown term '%.64s', expected one of: dry, viscous, power, table%s%s%s", node->child->key,
                        suggestion.best ? "; did you mean '" : "", suggestion.best ? suggestion.best : "",
                        suggestion.best ? "'?" : "");
}

CpsStatus cpsi_law_build_resistance(CpsiLawBuild *b, const CpsiYaml *node, CpsResistance **out) {
    CpsError found;
    if (node->kind != CPSI_YAML_SEQUENCE || node->count < 1)
        return cpsi_law_wrong(&b->file, node, "'resistance'", "a list of terms, as in [{dry: {disc: 500}}]");
    CpsResistance **part = CPSI_POOL_TAKE(b->file.pool, node->count, CpsResistance *);
    if (!part) return cpsi_law_no_memory(&b->file);
    CpsStatus status = CPS_OK;
    int count = 0;
    for (const CpsiYaml *item = node->child; item && status == CPS_OK; item = item->next) {
        status = build_term(b, item, &part[count]);
        if (status == CPS_OK) count++;
    }
    if (status == CPS_OK)
        status = CPSI_PLACED(b, node, cps_resistance_sum(count, (const CpsResistance *const *)part, out, &found));
    while (count > 0) cps_resistance_destroy(part[--count]);
    return status;
}
