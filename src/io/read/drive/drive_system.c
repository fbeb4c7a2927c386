/* SPDX-License-Identifier: BSD-3-Clause */
/* `system:` of a file of driven systems: named parameters, laws on sparse combinations of them,
 * constraints, drive and load. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "capstan/io.h"
#include "io/read/drive/drive_file.h"
#include "io/read/key_reader.h"

/* The known names, and the entries of the map being read. */
typedef struct Names {
    CpsiSetBuild *b;
    const CpsiDocument *d;
    int count;
    const char **name;
} Names;

typedef struct Map {
    int rows, count;
    CpsEntry *entry;
    const char **text; /* (rows) */
} Map;

/* ---- names ---- */

static CpsStatus find_name(const Names *names, const CpsiYaml *node, const char *written,
                           int *index) {
    for (*index = 0; *index < names->count; ++*index)
        if (strcmp(names->name[*index], written) == 0) return CPS_OK;
    CpsSuggestion suggestion = {.word = written};
    for (int i = 0; i < names->count; i++) cps_suggest(&suggestion, names->name[i]);
    if (suggestion.best)
        return cpsi_document_fail(names->d, CPS_ERR_INPUT, node,
                                  "unknown parameter '%.64s'; did you mean '%s'?", written,
                                  suggestion.best);
    return cpsi_document_fail(
        names->d, CPS_ERR_INPUT, node,
        "unknown parameter '%.64s', expected one of those listed in 'parameters'", written);
}

static CpsStatus read_names(Names *names, const CpsiYaml *node) {
    names->name = CPSI_POOL_TAKE(names->d->pool, node->count, const char *);
    if (!names->name) return cpsi_document_no_memory(names->d);
    for (const CpsiYaml *item = node->child; item; item = item->next) {
        for (int i = 0; i < names->count; i++)
            if (strcmp(names->name[i], item->text) == 0)
                return cpsi_document_fail(names->d, CPS_ERR_INPUT, item,
                                          "'parameters': '%.64s' is given twice", item->text);
        names->name[names->count++] = item->text;
    }
    return CPS_OK;
}

/* ---- combinations of parameters ---- */

/* "roll - 0.3 omega" */
static const char *combination_text(const Names *names, int count, const CpsEntry *entry) {
    char text[120] = "";
    size_t used = 0;
    for (int i = 0; i < count && used < sizeof text; i++) {
        const double x = entry[i].value;
        const char *sign = x < 0 ? (i ? " - " : "-") : i ? " + " : "";
        used += (size_t)snprintf(text + used, sizeof text - used, "%s", sign);
        if (used < sizeof text && fabs(x) != 1)
            used += (size_t)snprintf(text + used, sizeof text - used, "%.6g ", fabs(x));
        if (used < sizeof text)
            used += (size_t)snprintf(text + used, sizeof text - used, "%.40s",
                                     names->name[entry[i].column]);
    }
    return cpsi_pool_text(names->d->pool, text, strlen(text));
}

static CpsStatus read_combination(const Names *names, const CpsiYaml *node, const char *what,
                                  Map *map) {
    const int row = map->rows, first = map->count;
    CpsStatus status = CPS_OK;
    int column;
    if (node->kind == CPSI_YAML_SCALAR && *node->text) {
        status = find_name(names, node, node->text, &column);
        if (status == CPS_OK) map->entry[map->count++] = (CpsEntry){row, column, 1};
    } else if (node->kind == CPSI_YAML_MAPPING) {
        for (const CpsiYaml *term = node->child; term && status == CPS_OK; term = term->next) {
            double factor = 0;
            status = find_name(names, term, term->key, &column);
            if (status == CPS_OK) status = cpsi_read_number(names->d, term, what, &factor);
            if (status == CPS_OK) map->entry[map->count++] = (CpsEntry){row, column, factor};
        }
    } else {
        return cpsi_document_wrong(names->d, node, what,
                                   "a parameter, or a sum of them as in {roll: 1, omega: -0.3}");
    }
    if (status != CPS_OK) return status;
    map->text[row] = combination_text(names, map->count - first, map->entry + first);
    map->rows++;
    return map->text[row] ? CPS_OK : cpsi_document_no_memory(names->d);
}

/* a list of combinations, one row each */
static CpsStatus read_map(const Names *names, const CpsiYaml *node, const char *what, Map *map) {
    size_t entries = 0;
    for (const CpsiYaml *item = node->child; item; item = item->next)
        entries += item->kind == CPSI_YAML_MAPPING ? (size_t)item->count : 1;
    CpsiPool *pool = names->d->pool;
    *map = (Map){.entry = CPSI_POOL_TAKE(pool, entries + 1, CpsEntry),
                 .text = CPSI_POOL_TAKE(pool, node->count, const char *)};
    if (!map->entry || !map->text) return cpsi_document_no_memory(names->d);
    CpsStatus status = CPS_OK;
    for (const CpsiYaml *item = node->child; item && status == CPS_OK; item = item->next)
        status = read_combination(names, item, what, map);
    return status;
}

/* ---- laws ---- */

/* The law acts on the map's rows; there must be as many as it has components. */
static CpsStatus add_law(const Names *names, const CpsiSystemLawValues *values, const char *name,
                         const Map *map, CpsSystem *system) {
    CpsLaw *law = NULL;
    CpsResistance *terms = NULL;
    CpsError found;
    CpsStatus status = values->law ? cpsi_build_law(names->b, values->law, &law)
                                   : cpsi_build_resistance(names->b, values->resistance, &terms);
    const int space = status ? 0 : law ? cps_law_space(law) : cps_resistance_space(terms);
    if (status == CPS_OK && space != map->rows)
        status = cpsi_document_fail(
            names->d, CPS_ERR_INPUT, values->node,
            "law '%.64s': 'on' has %d row%s, expected %d, as many as its law has components", name,
            map->rows, map->rows == 1 ? "" : "s", space);
    if (status == CPS_OK &&
        (law ? cps_system_add_friction(system, name, law, map->count, map->entry, &found)
             : cps_system_add_resistance(system, name, terms, map->count, map->entry, &found)) !=
            CPS_OK)
        status = cpsi_document_place(names->d, values->node, &found);
    cps_law_release(law);
    cps_resistance_release(terms);
    return status;
}

static CpsStatus build_law(const Names *names, const CpsiSystemLawValues *values, int number,
                           CpsSystem *system) {
    char numbered[32];
    snprintf(numbered, sizeof numbered, "law %d", number + 1);
    const char *name = values->name ? values->name : numbered;
    for (int k = 0; k < number; k++)
        if (strcmp(cps_system_law_name(system, k), name) == 0)
            return cpsi_document_fail(names->d, CPS_ERR_INPUT, values->node,
                                      "law '%.64s' is there already; names tell laws apart", name);
    Map map;
    const CpsStatus status = read_map(names, values->on, "'on'", &map);
    return status ? status : add_law(names, values, name, &map, system);
}

static CpsStatus build_laws(const Names *names, const CpsiList *laws, CpsSystem *system) {
    const CpsiSystemLawValues *values = laws->item;
    CpsStatus status = CPS_OK;
    for (int i = 0; i < laws->count && status == CPS_OK; i++)
        status = build_law(names, &values[i], i, system);
    return status;
}

/* ---- the rest ---- */

static CpsStatus build_constraints(const Names *names, const CpsiYaml *node, CpsSystem *system) {
    Map map;
    CpsError found;
    CpsStatus status = read_map(names, node, "'constraints'", &map);
    if (status == CPS_OK &&
        cps_system_add_constraints(system, map.rows, map.count, map.entry, &found) != CPS_OK)
        status = cpsi_document_place(names->d, node, &found);
    return status;
}

static CpsStatus build_drive(const Names *names, const CpsiYaml *node, CpsDriveSystem *out) {
    Map map;
    CpsError found;
    CpsStatus status = read_map(names, node, "'drive'", &map);
    if (status == CPS_OK &&
        cps_system_set_drive(out->system, map.rows, map.count, map.entry, &found) != CPS_OK)
        status = cpsi_document_place(names->d, node, &found);
    if (status != CPS_OK) return status;
    out->driven_count = map.rows;
    out->drive = map.text;
    return CPS_OK;
}

static CpsStatus build_load(const Names *names, const CpsiYaml *node, CpsSystem *system) {
    CpsError found;
    double *load = CPSI_POOL_TAKE(names->d->pool, names->count, double);
    if (!load) return cpsi_document_no_memory(names->d);
    CpsStatus status = CPS_OK;
    for (const CpsiYaml *item = node->child; item && status == CPS_OK; item = item->next) {
        int i = 0;
        status = find_name(names, item, item->key, &i);
        if (status == CPS_OK) status = cpsi_read_number(names->d, item, "'load'", &load[i]);
    }
    if (status == CPS_OK && cps_system_set_load(system, load, &found) != CPS_OK)
        status = cpsi_document_place(names->d, node, &found);
    return status;
}

CpsStatus cpsi_build_system(CpsiSetBuild *b, const CpsiSystemValues *values, CpsDriveSystem *out) {
    const CpsiYaml *constraints = values->constraints, *drive = values->drive, *load = values->load;
    const CpsiNumberRows *asked = &values->velocity;
    Names names = {.b = b, .d = b->d};
    CpsError found;
    out->map_radius = values->map_radius;
    CpsStatus status = read_names(&names, values->parameters);
    if (status == CPS_OK && cps_system_create(names.count, &out->system, &found) != CPS_OK)
        status = cpsi_document_place(b->d, values->node, &found);
    if (status != CPS_OK) return status;
    out->parameter_count = names.count;
    out->parameter = names.name;
    status = build_laws(&names, &values->laws, out->system);
    if (status == CPS_OK && constraints)
        status = build_constraints(&names, constraints, out->system);
    if (status == CPS_OK && drive) status = build_drive(&names, drive, out);
    if (status == CPS_OK && load) status = build_load(&names, load, out->system);
    out->loaded = load != NULL;
    if (status != CPS_OK || !asked->node) return status;
    if (out->driven_count == 0)
        return cpsi_document_wrong(b->d, asked->node, "'velocity'",
                                   "none, since nothing is driven: add 'drive'");
    out->velocity_count = asked->rows;
    out->velocity = asked->x;
    return cpsi_expect_columns(b->d, asked, "'velocity'", out->driven_count);
}
