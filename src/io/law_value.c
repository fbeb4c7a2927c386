/* SPDX-License-Identifier: BSD-3-Clause */
/* Values of a law file (see law_value.h). */
#include "io/law_value.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "io/keys.h"

/* Beyond it squares would overflow, as in scenes. */
static const double LARGEST = 1e100;

CpsStatus cpsi_law_wrong(const CpsiLawFile *f, const CpsiYaml *node, const char *what, const char *expected) {
    char found[100];
    if (node->kind == CPSI_YAML_MAPPING)
        snprintf(found, sizeof found, "a mapping");
    else if (node->kind == CPSI_YAML_SEQUENCE)
        snprintf(found, sizeof found, "a list of %d", node->count);
    else if (!node->text[0])
        snprintf(found, sizeof found, "nothing");
    else
        snprintf(found, sizeof found, "'%.60s'%s", node->text, node->plain ? "" : " in quotes");
    return cpsi_fail_at(f->err, CPS_ERR_INPUT, f->name, node->line, node->column, "%s: found %s, expected %s", what,
                        found, expected);
}

CpsStatus cpsi_law_number(const CpsiLawFile *f, const CpsiYaml *node, const char *what, double least, bool open,
                          double *out) {
    char expected[80];
    double x = NAN;
    const bool number = node->kind == CPSI_YAML_SCALAR && node->plain && cpsi_yaml_number(node->text, &x);
    const bool within = fabs(x) <= LARGEST && (open ? x > least : x >= least);
    if (number && within) {
        *out = x;
        return CPS_OK;
    }
    if (least > -LARGEST)
        snprintf(expected, sizeof expected, "a finite number %s %g", open ? "greater than" : "of at least", least);
    else
        snprintf(expected, sizeof expected, "a finite number, at most 1e100");
    return cpsi_law_wrong(f, node, what, expected);
}

CpsStatus cpsi_law_count(const CpsiLawFile *f, const CpsiYaml *node, const char *what, int most, int *out) {
    char expected[80];
    double x = NAN;
    const bool number = node->kind == CPSI_YAML_SCALAR && node->plain && cpsi_yaml_number(node->text, &x);
    if (number && x >= 1 && x <= most && x == floor(x)) {
        *out = (int)x;
        return CPS_OK;
    }
    snprintf(expected, sizeof expected, "a whole number from 1 to %d", most);
    return cpsi_law_wrong(f, node, what, expected);
}

CpsStatus cpsi_law_no_memory(const CpsiLawFile *f) {
    return cpsi_fail_at(f->err, CPS_ERR_MEMORY, f->name, 0, 0, "out of memory while reading the law");
}

/* the numbers of a list into out (node->count) */
static CpsStatus numbers(const CpsiLawFile *f, const CpsiYaml *node, const char *what, double *out) {
    CpsStatus status = CPS_OK;
    for (const CpsiYaml *x = node->child; x && status == CPS_OK; x = x->next)
        status = cpsi_law_number(f, x, what, -INFINITY, false, out++);
    return status;
}

CpsStatus cpsi_law_vector(const CpsiLawFile *f, const CpsiYaml *node, const char *what, int *count, double **out) {
    if (node->kind != CPSI_YAML_SEQUENCE || node->count < 1)
        return cpsi_law_wrong(f, node, what, "a list of numbers, as in [1, 2]");
    *count = node->count;
    *out = CPSI_POOL_TAKE(f->pool, node->count, double);
    return *out ? numbers(f, node, what, *out) : cpsi_law_no_memory(f);
}

CpsStatus cpsi_law_matrix(const CpsiLawFile *f, const CpsiYaml *node, const char *what, int *rows, int *columns,
                          double **out) {
    static const char EXPECTED[] = "rows of numbers, all equally long, as in [[1, 0], [0, 1]]";
    if (node->kind != CPSI_YAML_SEQUENCE || node->count < 1 || node->child->kind != CPSI_YAML_SEQUENCE)
        return cpsi_law_wrong(f, node, what, EXPECTED);
    *rows = node->count, *columns = node->child->count;
    if (*columns < 1) return cpsi_law_wrong(f, node->child, what, EXPECTED);
    for (const CpsiYaml *row = node->child; row; row = row->next)
        if (row->kind != CPSI_YAML_SEQUENCE || row->count != *columns) return cpsi_law_wrong(f, row, what, EXPECTED);

    /* both counts are numbers of values in the file: their product is at most that number squared, checked below */
    size_t size;
    if (__builtin_mul_overflow((size_t)*rows, (size_t)*columns, &size)) return cpsi_law_no_memory(f);
    double *x = *out = CPSI_POOL_TAKE(f->pool, size, double);
    if (!x) return cpsi_law_no_memory(f);
    CpsStatus status = CPS_OK;
    for (const CpsiYaml *row = node->child; row && status == CPS_OK; row = row->next, x += *columns)
        status = numbers(f, row, what, x);
    return status;
}

/* ---- keys ---- */

static const char *bare(const char *key) { return key + (*key == '?'); }

static CpsStatus unknown_key(const CpsiLawFile *f, const CpsiYaml *node, const char *what, const char *const *key) {
    CpsiSuggestion suggestion = {.word = node->key};
    char list[200] = "";
    for (int i = 0; key[i]; i++) {
        cpsi_suggest(&suggestion, bare(key[i]));
        const size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "", bare(key[i]));
    }
    if (suggestion.best)
        return cpsi_fail_at(f->err, CPS_ERR_INPUT, f->name, node->line, node->column,
                            "%s: unknown key '%.64s'; did you mean '%s'?", what, node->key, suggestion.best);
    return cpsi_fail_at(f->err, CPS_ERR_INPUT, f->name, node->line, node->column,
                        "%s: unknown key '%.64s', expected a mapping with %s", what, node->key, list);
}

CpsStatus cpsi_law_keys(const CpsiLawFile *f, const CpsiYaml *node, const char *what, const char *const *key,
                        const CpsiYaml **child) {
    char expected[200] = "a mapping with ";
    for (int i = 0; key[i]; i++) {
        const size_t used = strlen(expected);
        snprintf(expected + used, sizeof expected - used, "%s%s", i ? ", " : "", bare(key[i]));
        child[i] = NULL;
    }
    if (node->kind != CPSI_YAML_MAPPING) return cpsi_law_wrong(f, node, what, expected);
    for (const CpsiYaml *value = node->child; value; value = value->next) {
        int i = 0;
        while (key[i] && strcmp(value->key, bare(key[i])) != 0) i++;
        if (!key[i]) return unknown_key(f, value, what, key);
        child[i] = value;
    }
    for (int i = 0; key[i]; i++)
        if (!child[i] && key[i][0] != '?')
            return cpsi_fail_at(f->err, CPS_ERR_INPUT, f->name, node->line, node->column, "%s: '%s' is missing", what,
                                key[i]);
    return CPS_OK;
}
