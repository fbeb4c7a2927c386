/* SPDX-License-Identifier: BSD-3-Clause */
/* Reading mappings by their fields (see drive_fields.h). */
#include "io/read/drive_fields.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "io/schema/keys.h"

CpsStatus cpsi_drive_wrong(CpsiDriveRead *r, const CpsiYaml *node, const char *what, const char *expected) {
    return cpsi_law_wrong(&r->build.file, node, what, expected);
}

CpsStatus cpsi_drive_place(CpsiDriveRead *r, const CpsiYaml *node, const CpsError *found) {
    return cpsi_law_place(&r->build.file, node, found);
}

CpsStatus cpsi_drive_no_memory(CpsiDriveRead *r) { return cpsi_law_no_memory(&r->build.file); }

/* ---- values ---- */

CpsStatus cpsi_drive_number(CpsiDriveRead *r, const CpsiYaml *node, const char *what, double *out) {
    static const CpsiLawKey ANY = {.type = CPSI_LAW_NUMBER, .low = -INFINITY};
    CpsiLawValue value = {.node = node};
    const CpsStatus status = cpsi_law_value(&r->build.file, node, &ANY, what, &value);
    if (status == CPS_OK) *out = value.x[0];
    return status;
}

CpsStatus cpsi_drive_rows(CpsiDriveRead *r, const CpsiYaml *node, const char *what, int columns, int least, int *rows,
                          const double **out) {
    static const CpsiLawKey ANY = {.type = CPSI_LAW_MATRIX, .low = -INFINITY};
    char expected[100];
    CpsiLawValue value = {.node = node};
    snprintf(expected, sizeof expected, "a list of at least %d rows of %d number%s", least, columns,
             columns == 1 ? "" : "s");
    if (node->kind != CPSI_YAML_SEQUENCE || node->count < least) return cpsi_drive_wrong(r, node, what, expected);
    const CpsStatus status = cpsi_law_value(&r->build.file, node, &ANY, what, &value);
    if (status != CPS_OK) return status;
    if (value.columns != columns) return cpsi_drive_wrong(r, node->child, what, expected);
    *rows = value.rows, *out = value.x;
    return CPS_OK;
}

CpsStatus cpsi_drive_point(CpsiDriveRead *r, const CpsiYaml *node, const char *what, int count, double *out) {
    const CpsiLawKey key = {.type = CPSI_LAW_VECTOR, .low = -INFINITY, .most = count};
    char expected[60];
    CpsiLawValue value = {.node = node};
    snprintf(expected, sizeof expected, "a list of %d number%s", count, count == 1 ? "" : "s");
    if (node->kind != CPSI_YAML_SEQUENCE || node->count != count) return cpsi_drive_wrong(r, node, what, expected);
    const CpsStatus status = cpsi_law_value(&r->build.file, node, &key, what, &value);
    if (status == CPS_OK) memcpy(out, value.x, (size_t)count * sizeof *out);
    return status;
}

/* what stands under a word of law files, as a word of its own that is not made */
static CpsStatus read_word(CpsiDriveRead *r, const CpsiYaml *node, const char *name, CpsiLawType type,
                           CpsiLawValue value[CPSI_LAW_MOST_KEYS]) {
    const CpsiLawWord word = {.name = name, .key = {{.type = type, .low = -INFINITY}}};
    return cpsi_law_read_values(&r->build, node, &word, name, value);
}

CpsStatus cpsi_drive_law(CpsiDriveRead *r, const CpsiYaml *node, CpsLaw **out) {
    CpsiLawValue value[CPSI_LAW_MOST_KEYS] = {{.node = NULL}};
    const CpsStatus status = read_word(r, node, "law", CPSI_LAW_LAW, value);
    if (status == CPS_OK) *out = value[0].law[0], value[0].law[0] = NULL;
    cpsi_law_release(value);
    return status;
}

CpsStatus cpsi_drive_resistance(CpsiDriveRead *r, const CpsiYaml *node, CpsResistance **out) {
    CpsError found;
    CpsiLawValue value[CPSI_LAW_MOST_KEYS] = {{.node = NULL}};
    CpsStatus status = read_word(r, node, "resistance", CPSI_LAW_TERMS, value);
    if (status == CPS_OK &&
        cps_resistance_sum(value[0].count, (const CpsResistance *const *)value[0].term, out, &found) != CPS_OK)
        status = cpsi_drive_place(r, node, &found);
    cpsi_law_release(value);
    return status;
}

static CpsStatus read_flag(CpsiDriveRead *r, const CpsiYaml *node, const char *what, bool *out) {
    const bool plain = node->kind == CPSI_YAML_SCALAR && node->plain;
    if (plain && strcmp(node->text, "true") == 0) return *out = true, CPS_OK;
    if (plain && strcmp(node->text, "false") == 0) return *out = false, CPS_OK;
    return cpsi_drive_wrong(r, node, what, "true or false");
}

static CpsStatus read_field(CpsiDriveRead *r, const CpsiYaml *node, const CpsiField *f, const char *what, void *out) {
    if (f->kind >= CPSI_FIELD_MAPPING) return memcpy(out, &node, sizeof node), CPS_OK;
    if (f->kind == CPSI_FIELD_FLAG) return read_flag(r, node, what, out);
    if (f->kind == CPSI_FIELD_POINT) return cpsi_drive_point(r, node, what, f->most, out);
    const bool text = f->kind == CPSI_FIELD_TEXT, whole = f->kind == CPSI_FIELD_COUNT;
    const CpsiLawKey key = {.type = text    ? CPSI_LAW_TEXT
                                    : whole ? CPSI_LAW_COUNT
                                            : CPSI_LAW_NUMBER,
                            .low = f->low,
                            .open = f->open,
                            .most = text ? 255 : f->most};
    CpsiLawValue value = {.node = node};
    const CpsStatus status = cpsi_law_value(&r->build.file, node, &key, what, &value);
    if (status != CPS_OK) return status;
    if (text)
        memcpy(out, &value.text, sizeof value.text);
    else if (whole)
        *(int *)out = (int)value.x[0];
    else
        *(double *)out = value.x[0];
    return CPS_OK;
}

/* ---- mappings ---- */

static const char *list_fields(int count, const CpsiField *field, char *text, size_t size) {
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; i < count && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s%s", i ? ", " : "", field[i].name);
    return text;
}

static CpsStatus unknown_field(CpsiDriveRead *r, const CpsiYaml *node, const char *what, int count,
                               const CpsiField *field) {
    const CpsiLawFile *f = &r->build.file;
    CpsiSuggestion suggestion = {.word = node->key};
    char list[300];
    for (int i = 0; i < count; i++) cpsi_suggest(&suggestion, field[i].name);
    if (suggestion.best)
        return cpsi_fail_at(f->err, CPS_ERR_INPUT, f->name, node->line, node->column,
                            "%s: unknown key '%.64s'; did you mean '%s'?", what, node->key, suggestion.best);
    return cpsi_fail_at(f->err, CPS_ERR_INPUT, f->name, node->line, node->column,
                        "%s: unknown key '%.64s', expected one of: %s", what, node->key,
                        list_fields(count, field, list, sizeof list));
}

CpsStatus cpsi_drive_fields(CpsiDriveRead *r, const CpsiYaml *node, CpsiDriveMapping mapping, void *const *out) {
    const CpsiDriveWord *word = cpsi_drive_word(mapping);
    const CpsiField *field = word->field;
    const char *what = word->name;
    const int count = cpsi_drive_word_count(word);
    const CpsiLawFile *f = &r->build.file;
    char list[300], text[360];
    unsigned given = 0;
    if (node->kind != CPSI_YAML_MAPPING) {
        snprintf(text, sizeof text, "a mapping with keys of: %s", list_fields(count, field, list, sizeof list));
        return cpsi_drive_wrong(r, node, what, text);
    }
    for (const CpsiYaml *child = node->child; child; child = child->next) {
        int i = 0;
        while (i < count && strcmp(child->key, field[i].name) != 0) i++;
        if (i == count) return unknown_field(r, child, what, count, field);
        snprintf(text, sizeof text, "'%s'", field[i].name);
        const CpsStatus status = read_field(r, child, &field[i], text, out[i]);
        if (status != CPS_OK) return status;
        given |= 1u << i;
    }
    for (int i = 0; i < count; i++)
        if (field[i].required && !(given >> i & 1))
            return cpsi_fail_at(f->err, CPS_ERR_INPUT, f->name, node->line, node->column, "%s: '%s' is missing: %s",
                                what, field[i].name, field[i].help);
    return CPS_OK;
}
