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
    static const CpsiKey ANY = {.type = CPSI_NUMBER, .low = -INFINITY};
    CpsiLawValue value = {.node = node};
    const CpsStatus status = cpsi_law_value(&r->build.file, node, &ANY, what, &value);
    if (status == CPS_OK) *out = value.x[0];
    return status;
}

CpsStatus cpsi_drive_rows(CpsiDriveRead *r, const CpsiYaml *node, const char *what, int columns, int least, int *rows,
                          const double **out) {
    static const CpsiKey ANY = {.type = CPSI_MATRIX, .low = -INFINITY};
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
    const CpsiKey key = {.type = CPSI_VECTOR, .low = -INFINITY, .most = count};
    char expected[60];
    CpsiLawValue value = {.node = node};
    snprintf(expected, sizeof expected, "a list of %d number%s", count, count == 1 ? "" : "s");
    if (node->kind != CPSI_YAML_SEQUENCE || node->count != count) return cpsi_drive_wrong(r, node, what, expected);
    const CpsStatus status = cpsi_law_value(&r->build.file, node, &key, what, &value);
    if (status == CPS_OK) memcpy(out, value.x, (size_t)count * sizeof *out);
    return status;
}

/* what stands under a word of law files, as a word of its own that is not made */
static CpsStatus read_word(CpsiDriveRead *r, const CpsiYaml *node, const char *name, CpsiValue type,
                           CpsiLawValue value[CPSI_LAW_MOST_KEYS]) {
    const CpsiLawWord word = {.name = name, .key = {{.type = type, .low = -INFINITY}}};
    return cpsi_law_read_values(&r->build, node, &word, name, value);
}

CpsStatus cpsi_drive_law(CpsiDriveRead *r, const CpsiYaml *node, CpsLaw **out) {
    CpsiLawValue value[CPSI_LAW_MOST_KEYS] = {{.node = NULL}};
    const CpsStatus status = read_word(r, node, "law", CPSI_LAW, value);
    if (status == CPS_OK) *out = value[0].law[0], value[0].law[0] = NULL;
    cpsi_law_release(value);
    return status;
}

CpsStatus cpsi_drive_resistance(CpsiDriveRead *r, const CpsiYaml *node, CpsResistance **out) {
    CpsError found;
    CpsiLawValue value[CPSI_LAW_MOST_KEYS] = {{.node = NULL}};
    CpsStatus status = read_word(r, node, "resistance", CPSI_TERMS, value);
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

/* one value, to where its row says */
static CpsStatus read_value(CpsiDriveRead *r, const CpsiYaml *node, const CpsiKey *key, void *out) {
    char what[80];
    snprintf(what, sizeof what, "'%s'", key->name);
    if (key->type >= CPSI_VECTOR) return memcpy(out, &node, sizeof node), CPS_OK;
    if (key->type == CPSI_FLAG) return read_flag(r, node, what, out);
    if (key->type == CPSI_POINT) return cpsi_drive_point(r, node, what, key->most, out);
    CpsiLawValue value = {.node = node};
    const CpsStatus status = cpsi_law_value(&r->build.file, node, key, what, &value);
    if (status != CPS_OK) return status;
    if (key->type == CPSI_TEXT)
        memcpy(out, &value.text, sizeof value.text);
    else if (key->type == CPSI_INTEGER)
        *(int *)out = (int)value.x[0];
    else
        *(double *)out = value.x[0];
    return CPS_OK;
}

CpsStatus cpsi_drive_fields(CpsiDriveRead *r, const CpsiYaml *node, CpsiDriveMapping mapping, void *out) {
    const CpsiDriveWord *word = cpsi_drive_word(mapping);
    const int count = cpsi_drive_word_count(word);
    const CpsiYaml *child[CPSI_DRIVE_MOST_KEYS] = {NULL};
    CpsStatus status = cpsi_law_keys(&r->build.file, node, word->name, word->key, count, child);
    for (int i = 0; i < count && status == CPS_OK; i++)
        if (child[i]) status = read_value(r, child[i], &word->key[i], (char *)out + word->key[i].offset);
    return status;
}
