/* SPDX-License-Identifier: BSD-3-Clause */
/* `system:` of a file of driven systems: named parameters, laws on sparse combinations of them, constraints, drive and
 * load. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "io/read/drive_file.h"
#include "io/schema/keys.h"

/* The names known, and entries of the map being read. */
typedef struct Names {
    CpsiDriveRead *r;
    int count;
    const char **name;
} Names;

typedef struct Map {
    int rows, count;
    CpsEntry *entry;
    const char **text; /* (rows) */
} Map;

/* ---- names ---- */

static CpsStatus find_name(const Names *names, const CpsiYaml *node, const char *written, int *index) {
    const CpsiLawFile *f = &names->r->build.file;
    for (int i = 0; i < names->count; i++)
        if (strcmp(names->name[i], written) == 0) return *index = i, CPS_OK;
    CpsiSuggestion suggestion = {.word = written};
    for (int i = 0; i < names->count; i++) cpsi_suggest(&suggestion, names->name[i]);
    return cpsi_fail_at(f->err, CPS_ERR_INPUT, f->name, node->line, node->column,
                        suggestion.best ? "unknown parameter '%.64s'; did you mean '%s'?"
                                        : "unknown parameter '%.64s', expected one of those listed in 'parameters'",
                        written, suggestion.best);
}

static CpsStatus read_names(CpsiDriveRead *r, const CpsiYaml *node, Names *names) {
    static const char EXPECTED[] = "a list of names, as in [omega, side, roll]";
    const CpsiLawFile *f = &r->build.file;
    if (node->kind != CPSI_YAML_SEQUENCE || node->count < 1) return cpsi_drive_wrong(r, node, "'parameters'", EXPECTED);
    if (node->count > CPSI_DRIVE_MOST_PARAMETERS)
        return cpsi_fail_at(f->err, CPS_ERR_LIMIT, f->name, node->line, node->column,
                            "'parameters': found %d, at most %d", node->count, (int)CPSI_DRIVE_MOST_PARAMETERS);
    *names = (Names){.r = r, .name = CPSI_POOL_TAKE(f->pool, node->count, const char *)};
    if (!names->name) return cpsi_drive_no_memory(r);
    for (const CpsiYaml *item = node->child; item; item = item->next) {
        if (item->kind != CPSI_YAML_SCALAR || !*item->text) return cpsi_drive_wrong(r, item, "'parameters'", EXPECTED);
        for (int i = 0; i < names->count; i++)
            if (strcmp(names->name[i], item->text) == 0)
                return cpsi_fail_at(f->err, CPS_ERR_INPUT, f->name, item->line, item->column,
                                    "'parameters': '%.64s' is given twice", item->text);
        names->name[names->count++] = item->text;
    }
    return CPS_OK;
}

/* ---- combinations of parameters ---- */

static CpsStatus not_a_combination(const Names *names, const CpsiYaml *node, const char *what) {
    return cpsi_drive_wrong(names->r, node, what, "a parameter, or a sum of them as in {roll: 1, omega: -0.3}");
}

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
            used += (size_t)snprintf(text + used, sizeof text - used, "%.40s", names->name[entry[i].column]);
    }
    return cpsi_pool_text(names->r->build.file.pool, text, strlen(text));
}

static CpsStatus read_combination(const Names *names, const CpsiYaml *node, const char *what, Map *map) {
    const int row = map->rows, first = map->count;
    CpsStatus status = CPS_OK;
    int column = 0;
    if (node->kind == CPSI_YAML_SCALAR && *node->text) {
        status = find_name(names, node, node->text, &column);
        if (status == CPS_OK) map->entry[map->count++] = (CpsEntry){row, column, 1};
    } else if (node->kind == CPSI_YAML_MAPPING) {
        for (const CpsiYaml *term = node->child; term && status == CPS_OK; term = term->next) {
            double factor = 0;
            status = find_name(names, term, term->key, &column);
            if (status == CPS_OK) status = cpsi_drive_number(names->r, term, what, &factor);
            if (status == CPS_OK) map->entry[map->count++] = (CpsEntry){row, column, factor};
        }
    } else {
        return not_a_combination(names, node, what);
    }
    if (status != CPS_OK) return status;
    map->text[row] = combination_text(names, map->count - first, map->entry + first);
    map->rows++;
    return map->text[row] ? CPS_OK : cpsi_drive_no_memory(names->r);
}

/* a list of combinations, one row each */
static CpsStatus read_map(const Names *names, const CpsiYaml *node, const char *what, Map *map) {
    if (node->kind != CPSI_YAML_SEQUENCE || node->count < 1)
        return cpsi_drive_wrong(names->r, node, what, "a list of parameters, as in [side, {roll: 1, omega: -0.3}]");
    size_t entries = 0;
    for (const CpsiYaml *item = node->child; item; item = item->next)
        entries += item->kind == CPSI_YAML_MAPPING ? (size_t)item->count : 1;
    CpsiPool *pool = names->r->build.file.pool;
    *map = (Map){.entry = CPSI_POOL_TAKE(pool, entries + 1, CpsEntry),
                 .text = CPSI_POOL_TAKE(pool, node->count, const char *)};
    if (!map->entry || !map->text) return cpsi_drive_no_memory(names->r);
    CpsStatus status = CPS_OK;
    for (const CpsiYaml *item = node->child; item && status == CPS_OK; item = item->next)
        status = read_combination(names, item, what, map);
    return status;
}

/* ---- laws ---- */

static CpsStatus add_law(const Names *names, const CpsiYaml *node, const char *name, const Map *map,
                         const CpsiYaml *words, bool resistance, CpsSystem *system) {
    CpsLaw *law = NULL;
    CpsResistance *terms = NULL;
    CpsError found;
    const CpsiLawFile *f = &names->r->build.file;
    CpsStatus status =
        resistance ? cpsi_drive_resistance(names->r, words, &terms) : cpsi_drive_law(names->r, words, &law);
    const int space = status ? 0 : resistance ? cps_resistance_space(terms) : cps_law_space(law);
    if (status == CPS_OK && space != map->rows)
        status = cpsi_fail_at(f->err, CPS_ERR_INPUT, f->name, node->line, node->column,
                              "law '%.64s': 'on' has %d row%s, expected %d, as many as its law has components", name,
                              map->rows, map->rows == 1 ? "" : "s", space);
    if (status == CPS_OK &&
        (resistance ? cps_system_add_resistance(system, name, terms, map->count, map->entry, &found)
                    : cps_system_add_friction(system, name, law, map->count, map->entry, &found)) != CPS_OK)
        status = cpsi_drive_place(names->r, node, &found);
    cps_law_destroy(law);
    cps_resistance_destroy(terms);
    return status;
}

static CpsStatus read_law(const Names *names, const CpsiYaml *node, int number, CpsSystem *system) {
    char fallback[32];
    snprintf(fallback, sizeof fallback, "law %d", number + 1);
    CpsiLawKeys keys = {.name = fallback};
    CpsStatus status = cpsi_drive_fields(names->r, node, CPSI_DRIVE_LAW, &keys);
    const CpsiYaml *law = keys.law, *terms = keys.resistance;
    const char *name = keys.name;
    if (status == CPS_OK && !law == !terms)
        return cpsi_drive_wrong(names->r, node, "law", "exactly one of 'law' and 'resistance' in it");
    const CpsiLawFile *f = &names->r->build.file;
    for (int k = 0; k < number && status == CPS_OK; k++)
        if (strcmp(cps_system_law_name(system, k), name) == 0)
            status = cpsi_fail_at(f->err, CPS_ERR_INPUT, f->name, node->line, node->column,
                                  "law '%.64s' is there already; names tell laws apart", name);
    Map map;
    if (status == CPS_OK) status = read_map(names, keys.on, "'on'", &map);
    return status ? status : add_law(names, node, name, &map, law ? law : terms, terms != NULL, system);
}

static CpsStatus read_laws(const Names *names, const CpsiYaml *node, CpsSystem *system) {
    if (node->kind != CPSI_YAML_SEQUENCE || node->count < 1)
        return cpsi_drive_wrong(names->r, node, "'laws'", "a list of laws, as in [{on: [omega], law: {interval: 60}}]");
    CpsStatus status = CPS_OK;
    int number = 0;
    for (const CpsiYaml *item = node->child; item && status == CPS_OK; item = item->next)
        status = read_law(names, item, number++, system);
    return status;
}

/* ---- the rest ---- */

static CpsStatus read_constraints(const Names *names, const CpsiYaml *node, CpsSystem *system) {
    Map map;
    CpsError found;
    CpsStatus status = read_map(names, node, "'constraints'", &map);
    if (status == CPS_OK && cps_system_add_constraints(system, map.rows, map.count, map.entry, &found) != CPS_OK)
        status = cpsi_drive_place(names->r, node, &found);
    return status;
}

static CpsStatus read_drive(const Names *names, const CpsiYaml *node, CpsDriveSystem *out) {
    Map map;
    CpsError found;
    CpsStatus status = read_map(names, node, "'drive'", &map);
    if (status == CPS_OK && cps_system_set_drive(out->system, map.rows, map.count, map.entry, &found) != CPS_OK)
        status = cpsi_drive_place(names->r, node, &found);
    if (status == CPS_OK) out->driven = map.rows, out->drive = map.text;
    return status;
}

static CpsStatus read_load(const Names *names, const CpsiYaml *node, CpsSystem *system) {
    CpsError found;
    double *load = CPSI_POOL_TAKE(names->r->build.file.pool, names->count, double);
    if (!load) return cpsi_drive_no_memory(names->r);
    if (node->kind != CPSI_YAML_MAPPING)
        return cpsi_drive_wrong(names->r, node, "'load'", "forces by parameter, as in {roll: -5}");
    CpsStatus status = CPS_OK;
    for (const CpsiYaml *item = node->child; item && status == CPS_OK; item = item->next) {
        int i = 0;
        status = find_name(names, item, item->key, &i);
        if (status == CPS_OK) status = cpsi_drive_number(names->r, item, "'load'", &load[i]);
    }
    if (status == CPS_OK && cps_system_set_load(system, load, &found) != CPS_OK)
        status = cpsi_drive_place(names->r, node, &found);
    return status;
}

CpsStatus cpsi_drive_read_system(CpsiDriveRead *r, const CpsiYaml *node, CpsDriveSystem *out) {
    CpsiSystemKeys keys = {.map_radius = 1};
    Names names;
    CpsError found;
    CpsStatus status = cpsi_drive_fields(r, node, CPSI_DRIVE_SYSTEM, &keys);
    out->map_radius = keys.map_radius;
    const CpsiYaml *constraints = keys.constraints, *drive = keys.drive, *load = keys.load, *asked = keys.velocity;
    if (status == CPS_OK) status = read_names(r, keys.parameters, &names);
    if (status == CPS_OK && cps_system_create(names.count, &out->system, &found) != CPS_OK)
        status = cpsi_drive_place(r, node, &found);
    if (status == CPS_OK) out->parameters = names.count, out->parameter = names.name;
    if (status == CPS_OK) status = read_laws(&names, keys.laws, out->system);
    if (status == CPS_OK && constraints) status = read_constraints(&names, constraints, out->system);
    if (status == CPS_OK && drive) status = read_drive(&names, drive, out);
    if (status == CPS_OK && load) status = read_load(&names, load, out->system);
    out->loaded = load != NULL;
    if (status == CPS_OK && asked && out->driven == 0)
        return cpsi_drive_wrong(r, asked, "'velocity'", "none, since nothing is driven: add 'drive'");
    if (status == CPS_OK && asked)
        status = cpsi_drive_rows(r, asked, "'velocity'", out->driven, 1, &out->velocity_count, &out->velocity);
    return status;
}
