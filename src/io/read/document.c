/* SPDX-License-Identifier: BSD-3-Clause */
/* Bytes -> tree (yaml.h) -> the objects built from it (see document.h). */
#include "io/read/document.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "io/base/file/read_file.h"
#include "io/base/text/numbers.h"
#include "io/schema/keys.h"

/* marks limits that were initialised by their default function */
static const uint32_t LIMITS_COOKIE = 0x4c494d54;

CpsReadLimits cps_read_limits_default(void) {
    return (CpsReadLimits){.cookie = LIMITS_COOKIE,
                           .max_bytes = (size_t)64 << 20,
                           .max_depth = 64,
                           .max_elements = 10000000,
                           .max_pairs = 100000000,
                           .max_steps = 1000000};
}

static CpsStatus parse(CpsiDocument *d, CpsiFileKind kind) {
    static const char *const WHAT[] = {
        [CPSI_FILE_SCENE] = "scene", [CPSI_FILE_LAW] = "law", [CPSI_FILE_DRIVE] = "driven system"};
    char *bytes = NULL;
    size_t size = d->text ? strlen(d->text) : 0;
    CpsiYaml *root = NULL;
    CpsStatus status = CPS_OK;
    if (!d->text)
        status = cpsi_read_file(d->path, d->name, d->limits->max_bytes, &bytes, &size, d->err);
    else if (size > d->limits->max_bytes)
        status = cpsi_fail_at(d->err, CPS_ERR_LIMIT, d->name, 0, 0,
                              "is larger than %zu bytes, the limit", d->limits->max_bytes);
    if (status == CPS_OK && size == 0 && !d->text && strcmp(d->path, "-") == 0)
        status = cpsi_fail(d->err, CPS_ERR_INPUT,
                           "standard input is empty or closed: a %s begins with 'capstan: 1'",
                           WHAT[kind]);
    if (status == CPS_OK)
        status = cpsi_yaml_parse(d->name, WHAT[kind], d->text ? d->text : bytes, size,
                                 d->limits->max_depth, d->pool, &root, d->err);
    free(bytes);
    d->root = root;
    return status ? status : cpsi_file_expect(d->name, root, kind, d->err);
}

CpsStatus cpsi_document_read(const char *path, const char *text, const CpsReadLimits *limits,
                             CpsiFileKind kind, CpsiPool *pool,
                             CpsStatus (*build)(const CpsiDocument *document, void *out), void *out,
                             CpsError *err) {
    const CpsReadLimits defaults = cps_read_limits_default();
    if (!limits) limits = &defaults;
    if (limits->cookie != LIMITS_COOKIE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the limits were not made by cps_read_limits_default()");
    if (limits->max_depth < 1 || limits->max_elements < 1 || limits->max_pairs < 1 ||
        limits->max_steps < 1)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "limits are not positive: start from cps_read_limits_default()");
    CpsiNumbers numbers;
    if (!cpsi_numbers_begin(&numbers)) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    CpsiDocument document = {.path = path,
                             .name = !text && strcmp(path, "-") == 0 ? "standard input" : path,
                             .text = text,
                             .limits = limits,
                             .pool = pool,
                             .err = err};
    CpsStatus status = parse(&document, kind);
    if (status == CPS_OK) status = build(&document, out);
    cpsi_numbers_end(&numbers);
    return status;
}

CpsStatus cpsi_document_fail(const CpsiDocument *d, CpsStatus status, const CpsiYaml *node,
                             const char *format, ...) {
    char message[sizeof d->err->message];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    return cpsi_fail_at(d->err, status, d->name, node->line, node->column, "%s", message);
}

CpsStatus cpsi_document_wrong(const CpsiDocument *d, const CpsiYaml *node, const char *what,
                              const char *expected) {
    return cpsi_key_wrong(d->name, node, what, expected, d->err);
}

CpsStatus cpsi_document_place(const CpsiDocument *d, const CpsiYaml *node, const CpsError *found) {
    const CpsStatus status = found->status == CPS_ERR_ARGUMENT ? CPS_ERR_INPUT : found->status;
    const char *message = found->message;
    if (found->line > 0)
        return cpsi_fail_at(d->err, status, d->name, found->line, found->column, "%s", message);
    if (!node->key) return cpsi_document_fail(d, status, node, "%s", message);
    return cpsi_document_fail(d, status, node, "'%.64s': %s", node->key, message);
}

CpsStatus cpsi_document_table(const CpsiDocument *d, const CpsiYaml *node, const char *name,
                              const CpsiCsvColumn *column, int count, CpsiPool *pool,
                              CpsiCsvTable *out, const char **path) {
    if (!cpsi_is_beside(name))
        return cpsi_document_fail(
            d, CPS_ERR_INPUT, node,
            "'%.64s': found '%.64s', expected the name of a file beside this one, without '/'",
            node->key, name);
    *path = cpsi_path_beside(pool, d->name, name);
    if (!*path) return cpsi_document_no_memory(d);
    return cpsi_csv_read(*path, d->limits->max_bytes, column, count, pool, out, d->err);
}

CpsStatus cpsi_document_no_memory(const CpsiDocument *d) {
    return cpsi_fail_at(d->err, CPS_ERR_MEMORY, d->name, 0, 0,
                        "out of memory while reading the file");
}
