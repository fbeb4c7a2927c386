/* SPDX-License-Identifier: BSD-3-Clause */
/* Values of a law file (see set_value.h). */
#include "io/read/set_value.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "io/schema/keys.h"

CpsStatus cpsi_law_wrong(const CpsiLawFile *f, const CpsiYaml *node, const char *what, const char *expected) {
    return cpsi_key_wrong(f->name, node, what, expected, f->err);
}

CpsStatus cpsi_law_no_memory(const CpsiLawFile *f) {
    return cpsi_fail_at(f->err, CPS_ERR_MEMORY, f->name, 0, 0, "out of memory while reading the law");
}

static CpsStatus too_many(const CpsiLawFile *f, const CpsiYaml *node, const char *what, int found, int most) {
    return cpsi_fail_at(f->err, CPS_ERR_LIMIT, f->name, node->line, node->column, "%s: found %d numbers, at most %d",
                        what, found, most);
}

/* ---- numbers ---- */

/* of the key's range */
static CpsStatus number(const CpsiLawFile *f, const CpsiYaml *node, const CpsiKey *key, const char *what,
                        double *out) {
    char expected[80] = "a finite number, at most 1e100";
    double x = NAN;
    const bool plain = node->kind == CPSI_YAML_SCALAR && node->plain && cpsi_yaml_number(node->text, &x);
    if (plain && fabs(x) <= CPSI_LARGEST && (key->open ? x > key->low : x >= key->low)) {
        *out = x;
        return CPS_OK;
    }
    if (key->low > -CPSI_LARGEST)
        snprintf(expected, sizeof expected, "a finite number %s %g", key->open ? "greater than" : "of at least",
                 key->low);
    return cpsi_law_wrong(f, node, what, expected);
}

/* a list, into out (node->count) */
static CpsStatus numbers(const CpsiLawFile *f, const CpsiYaml *node, const CpsiKey *key, const char *what,
                         double *out) {
    CpsStatus status = CPS_OK;
    for (const CpsiYaml *x = node->child; x && status == CPS_OK; x = x->next) status = number(f, x, key, what, out++);
    return status;
}

static CpsStatus read_count(const CpsiLawFile *f, const CpsiYaml *node, const CpsiKey *key, const char *what,
                            double *out) {
    char expected[80];
    double x = NAN;
    const bool plain = node->kind == CPSI_YAML_SCALAR && node->plain && cpsi_yaml_number(node->text, &x);
    if (plain && x >= 1 && x <= key->high && x == floor(x)) {
        *out = x;
        return CPS_OK;
    }
    snprintf(expected, sizeof expected, key->high > 1 ? "a whole number from 1 to %.0f" : "%.0f", key->high);
    return cpsi_law_wrong(f, node, what, expected);
}

/* room for the value's numbers */
static CpsStatus read_room(const CpsiLawFile *f, CpsiLawValue *value, int rows, int columns) {
    value->rows = rows, value->columns = columns;
    value->x = CPSI_POOL_TAKE(f->pool, (size_t)rows * (size_t)columns, double);
    return value->x ? CPS_OK : cpsi_law_no_memory(f);
}

/* ---- lists of numbers ---- */

static CpsStatus read_vector(const CpsiLawFile *f, const CpsiYaml *node, const CpsiKey *key, const char *what,
                             CpsiLawValue *value) {
    if (node->kind != CPSI_YAML_SEQUENCE || node->count < 1)
        return cpsi_law_wrong(f, node, what, "a list of numbers, as in [1, 2]");
    if (node->count > key->most) return too_many(f, node, what, node->count, key->most);
    const CpsStatus status = read_room(f, value, 1, node->count);
    return status ? status : numbers(f, node, key, what, value->x);
}

/* rows, equally long */
static CpsStatus read_matrix(const CpsiLawFile *f, const CpsiYaml *node, const CpsiKey *key, const char *what,
                             CpsiLawValue *value) {
    static const char EXPECTED[] = "rows of numbers, all equally long, as in [[1, 0], [0, 1]]";
    if (node->kind != CPSI_YAML_SEQUENCE || node->count < 1 || node->child->kind != CPSI_YAML_SEQUENCE)
        return cpsi_law_wrong(f, node, what, EXPECTED);
    const int columns = node->child->count;
    for (const CpsiYaml *row = node->child; row; row = row->next)
        if (columns < 1 || row->kind != CPSI_YAML_SEQUENCE || row->count != columns)
            return cpsi_law_wrong(f, row, what, EXPECTED);
    if (columns > CPSI_LAW_MOST_COMPONENTS) return too_many(f, node->child, what, columns, CPSI_LAW_MOST_COMPONENTS);
    if (node->count > CPS_SET_MAX_ITEMS)
        return cpsi_fail_at(f->err, CPS_ERR_LIMIT, f->name, node->line, node->column, "%s: found %d rows, at most %d",
                            what, node->count, CPS_SET_MAX_ITEMS);
    if (key->type == CPSI_SQUARE && columns != node->count) return cpsi_law_wrong(f, node, what, "a square matrix");
    if (key->type == CPSI_ENDS_OF_SEGMENT && node->count != 2) return cpsi_law_wrong(f, node, what, "its two ends");
    CpsStatus status = read_room(f, value, node->count, columns);
    double *x = value->x;
    for (const CpsiYaml *row = node->child; row && status == CPS_OK; row = row->next, x += columns)
        status = numbers(f, row, key, what, x);
    return status;
}

/* [[x, y], ..] */
static CpsStatus read_pairs(const CpsiLawFile *f, const CpsiYaml *node, const CpsiKey *key, const char *what,
                            CpsiLawValue *value) {
    CpsiLawValue given = {.node = node};
    CpsStatus status = read_matrix(f, node, key, what, &given);
    if (status == CPS_OK && given.columns != 2)
        return cpsi_law_wrong(f, node->child, what, "pairs, as in [[0, 1], [2, 1.5]]");
    if (status == CPS_OK) status = read_room(f, value, given.rows, 2);
    for (int i = 0; status == CPS_OK && i < given.rows; i++)
        value->x[i] = given.x[2 * i], value->x[given.rows + i] = given.x[2 * i + 1];
    return status;
}

/* An end of a side: without end on its own side only. */
static CpsStatus end_of_side(const CpsiLawFile *f, const CpsiYaml *node, const CpsiKey *key, const char *what, double side,
                             double *out) {
    double x = NAN;
    const bool plain = node->kind == CPSI_YAML_SCALAR && node->plain && cpsi_yaml_number(node->text, &x);
    if (!plain || x != side) return number(f, node, key, what, out);
    *out = side;
    return CPS_OK;
}

/* b for [-b, b], or [low, high] */
static CpsStatus read_side(const CpsiLawFile *f, const CpsiYaml *node, const CpsiKey *key, const char *what,
                           double *low, double *high) {
    static const CpsiKey HALF = {.low = 0};
    if (node->kind == CPSI_YAML_SCALAR) {
        const CpsStatus status = end_of_side(f, node, &HALF, what, INFINITY, high);
        *low = -*high;
        return status;
    }
    if (node->kind != CPSI_YAML_SEQUENCE || node->count != 2)
        return cpsi_law_wrong(f, node, what, "a number b for -b .. b, or two, as in [-1, 2]");
    const CpsStatus status = end_of_side(f, node->child, key, what, -INFINITY, low);
    return status ? status : end_of_side(f, node->child->next, key, what, INFINITY, high);
}

static CpsStatus read_sides(const CpsiLawFile *f, const CpsiYaml *node, const CpsiKey *key, const char *what,
                            CpsiLawValue *value) {
    if (node->kind != CPSI_YAML_SEQUENCE || node->count < 1)
        return cpsi_law_wrong(f, node, what, "half widths, as in [300, 100], or sides, as in [[-1, 2], [0, 5]]");
    const int n = node->count;
    if (n > CPSI_LAW_MOST_COMPONENTS) return too_many(f, node, what, n, CPSI_LAW_MOST_COMPONENTS);
    CpsStatus status = read_room(f, value, 2, n);
    int i = 0;
    for (const CpsiYaml *side = node->child; side && status == CPS_OK; side = side->next, i++)
        status = read_side(f, side, key, what, &value->x[i], &value->x[n + i]);
    return status;
}

CpsStatus cpsi_law_value(const CpsiLawFile *f, const CpsiYaml *node, const CpsiKey *key, const char *what,
                         CpsiLawValue *value) {
    CpsStatus status = CPS_OK;
    switch (key->type) {
    case CPSI_TEXT:
        if (node->kind != CPSI_YAML_SCALAR || strlen(node->text) > (size_t)key->most)
            return cpsi_law_wrong(f, node, what, "a text of at most 255 bytes");
        value->text = node->text;
        return CPS_OK;
    case CPSI_INTEGER:
        status = read_room(f, value, 1, 1);
        return status ? status : read_count(f, node, key, what, value->x);
    case CPSI_NUMBER:
        status = read_room(f, value, 1, 1);
        return status ? status : number(f, node, key, what, value->x);
    case CPSI_VECTOR:
        return read_vector(f, node, key, what, value);
    case CPSI_PAIRS:
        return read_pairs(f, node, key, what, value);
    case CPSI_SIDE:
        status = read_room(f, value, 2, 1);
        return status ? status : read_side(f, node, key, what, &value->x[0], &value->x[1]);
    case CPSI_SIDES:
        return read_sides(f, node, key, what, value);
    default:
        return read_matrix(f, node, key, what, value);
    }
}

/* ---- keys ---- */

CpsStatus cpsi_law_keys(const CpsiLawFile *f, const CpsiYaml *node, const char *what, const CpsiKey *key, int count,
                        const CpsiYaml **child) {
    char list[300], expected[340];
    if (node->kind != CPSI_YAML_MAPPING) {
        snprintf(expected, sizeof expected, "a mapping with %s", cpsi_key_list(key, count, list, sizeof list));
        return cpsi_law_wrong(f, node, what, expected);
    }
    for (const CpsiYaml *value = node->child; value; value = value->next) {
        int i = 0;
        while (i < count && strcmp(value->key, key[i].name) != 0) i++;
        if (i == count) return cpsi_key_unknown(f->name, value, what, key, count, f->err);
        child[i] = value;
    }
    for (int i = 0; i < count; i++)
        if (!child[i] && key[i].need == CPSI_REQUIRED) return cpsi_key_missing(f->name, node, what, &key[i], f->err);
    return CPS_OK;
}
