/* SPDX-License-Identifier: BSD-3-Clause */
/* From YAML to a tree, by the events of libfyaml (see yaml.h). There is no recursion, but a stack
 * of open collections. */
#include "io/base/yaml/yaml.h"

#include <errno.h>
#include <libfyaml.h>
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "io/base/text/escape.h"
#include "io/base/yaml/yaml_lines.h"

/* Limits for the values of a file and the bytes of one scalar: far more than a file needs, and few
 * enough for the memory. */
enum { MAX_VALUES = 4000000, MAX_SCALAR = 65536 };

typedef struct OpenCollection { /* a collection that is not closed yet */
    CpsiYaml *node, *last;      /* last child so far */
    const char *key;            /* mapping: a key whose value has not been read yet */
    int line, column;           /* of that key */
} OpenCollection;

typedef struct Parse {
    const char *file, *what;
    const char *bytes; /* (size) of the file */
    size_t size;
    CpsiPool *pool;
    CpsError *err;
    OpenCollection *open; /* (max_depth) */
    int depth, max_depth, values, documents;
    int line, column; /* of the last event that has a position */
    CpsiYaml *root;
} Parse;

CpsStatus cpsi_fail_at(CpsError *err, CpsStatus status, const char *file, int line, int column,
                       const char *format, ...) {
    char message[sizeof err->message];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    /* the end of a truncated text may divide a character */
    for (char *c = message; *c;) {
        const size_t length = cpsi_utf8_length(c);
        if (length == 0) *c = '?';
        c += length ? length : 1;
    }
    cpsi_fail(err, status, "%s", message);
    if (err) {
        snprintf(err->file, sizeof err->file, "%s", file);
        err->line = line;
        err->column = column;
    }
    return status;
}

const CpsiYaml *cpsi_yaml_child(const CpsiYaml *node, const char *key) {
    if (!node || node->kind != CPSI_YAML_MAPPING) return NULL;
    for (const CpsiYaml *child = node->child; child; child = child->next)
        if (strcmp(child->key, key) == 0) return child;
    return NULL;
}

/* The child that the first part of a path names, and the length of that part. A key may itself
 * contain dots. */
static const CpsiYaml *first_step(const CpsiYaml *node, const char *place, size_t *length) {
    const CpsiYaml *best = NULL;
    *length = 0;
    if (*place == '[') {
        int number = atoi(place + 1);
        *length = strcspn(place, "]") + 1;
        for (best = node->child; best && --number > 0;) best = best->next;
        return best;
    }
    for (const CpsiYaml *child = node->child; child && child->key; child = child->next) {
        const size_t n = strlen(child->key);
        if (n > *length && strncmp(place, child->key, n) == 0 && strchr(".[", place[n])) {
            best = child;
            *length = n;
        }
    }
    return best;
}

const CpsiYaml *cpsi_yaml_at(const CpsiYaml *root, const char *place) {
    const CpsiYaml *node = root;
    while (*place) {
        size_t length;
        const CpsiYaml *next = first_step(node, place, &length);
        if (!next) break;
        node = next;
        place += length;
        place += *place == '.';
    }
    return node;
}

/* ---- numbers ---- */

static const char *skip_digits(const char *s) { return s + strspn(s, "0123456789"); }

/* Read the number that the text is; false if it is too large for a double, or so small that it
 * would be 0. */
static bool in_range(const char *text, double *number) {
    errno = 0;
    *number = strtod(text, NULL);
    return errno != ERANGE || (isfinite(*number) && *number != 0);
}

bool cpsi_yaml_number(const char *text, double *number) {
    static const char HEX[] = "0123456789abcdefABCDEF", OCTAL[] = "01234567";
    if (text[0] == '0' && text[1] == 'x') {
        return text[2] && !text[2 + strspn(text + 2, HEX)] && in_range(text, number);
    }
    if (text[0] == '0' && text[1] == 'o') {
        errno = 0;
        *number = (double)strtoull(text + 2, NULL, 8);
        return text[2] && !text[2 + strspn(text + 2, OCTAL)] && errno != ERANGE;
    }
    if (strcmp(text, ".nan") == 0 || strcmp(text, ".NaN") == 0 || strcmp(text, ".NAN") == 0) {
        *number = strtod("nan", NULL);
        return true;
    }
    const char *s = text + (*text == '-' || *text == '+');
    if (strcmp(s, ".inf") == 0 || strcmp(s, ".Inf") == 0 || strcmp(s, ".INF") == 0) {
        *number = strtod(*text == '-' ? "-inf" : "inf", NULL);
        return true;
    }

    /* digits [. digits] [e digits], or . digits [e digits] */
    const char *after = skip_digits(s);
    bool digits = after > s;
    if (*after == '.') {
        s = after + 1;
        after = skip_digits(s);
        digits |= after > s;
    }
    if (!digits) return false;
    if (*after == 'e' || *after == 'E') {
        s = after + 1 + (after[1] == '-' || after[1] == '+');
        after = skip_digits(s);
        if (after == s) return false;
    }
    return !*after && in_range(text, number);
}

/* ---- characters ---- */

/* C0, delete and C1 control characters: U+0000..1F, 7F..9F. */
static bool is_control(const char *text) {
    const unsigned char *s = (const unsigned char *)text;
    return s[0] < 0x20 || s[0] == 0x7f || (s[0] == 0xc2 && s[1] < 0xa0);
}

/* bytes[size] is a zero byte */
static CpsStatus check_characters(const Parse *p, const char *bytes, size_t size) {
    int line = 1, column = 1;
    for (const char *s = bytes; s < bytes + size;) {
        const bool space = *s == '\t' || *s == '\n' || *s == '\r';
        if (is_control(s) && !space)
            return cpsi_fail_at(
                p->err, CPS_ERR_INPUT, p->file, line, column,
                "found a control character (byte 0x%02x): remove it (is this a text file?)",
                (unsigned)(unsigned char)*s);
        const size_t length = cpsi_utf8_length(s);
        if (length == 0)
            return cpsi_fail_at(p->err, CPS_ERR_INPUT, p->file, line, column,
                                "found byte 0x%02x, which is not UTF-8: save the file as UTF-8",
                                (unsigned)(unsigned char)*s);
        if (*s == '\n' && line < INT_MAX) {
            line++;
            column = 1;
        } else if (column < INT_MAX) {
            column++;
        }
        s += length;
    }
    return CPS_OK;
}

/* ---- events ---- */

static CpsStatus out_of_memory(const Parse *p) {
    return cpsi_fail_at(p->err, CPS_ERR_MEMORY, p->file, 0, 0, "out of memory while reading the %s",
                        p->what);
}

/* Are there two apostrophes in a row in a text in single quotes, where each is written twice?
 * libfyaml 0.7.12 takes them for three, and loses what is behind them. */
static bool has_two_apostrophes(const Parse *p, struct fy_token *token) {
    const struct fy_mark *start = fy_token_start_mark(token), *end = fy_token_end_mark(token);
    if (fy_token_scalar_style(token) != FYSS_SINGLE_QUOTED || !start || !end) return false;
    for (size_t i = start->input_pos; i + 4 <= end->input_pos && i + 4 <= p->size; i++)
        if (memcmp(p->bytes + i, "''''", 4) == 0) return true;
    return false;
}

/* A copy of the text of a scalar; NULL after an error. When memory does not suffice libfyaml
 * returns an empty text. */
static const char *scalar_text(Parse *p, struct fy_event *event, int line, int column,
                               CpsStatus *status) {
    if (has_two_apostrophes(p, event->scalar.value)) {
        *status = cpsi_fail_at(p->err, CPS_ERR_INPUT, p->file, line, column,
                               "found two apostrophes in a row in single quotes: write the text in "
                               "double quotes");
        return NULL;
    }
    size_t n = 0;
    const char *text = fy_token_get_text(event->scalar.value, &n);
    const struct fy_mark *start = fy_token_start_mark(event->scalar.value);
    const struct fy_mark *end = fy_token_end_mark(event->scalar.value);
    const size_t extent = start && end ? end->input_pos - start->input_pos : 0;
    const bool block = fy_token_scalar_style(event->scalar.value) >= FYSS_LITERAL;
    char *copy = NULL;
    *status = CPS_OK;
    if (n > MAX_SCALAR)
        *status = cpsi_fail_at(p->err, CPS_ERR_LIMIT, p->file, line, column,
                               "a text of %zu bytes, the limit is %d", n, (int)MAX_SCALAR);
    else if (!text || (n == 0 && extent > 0 && !block) ||
             !(copy = cpsi_pool_text(p->pool, text, n)))
        *status = out_of_memory(p);

    /* line breaks may be folded or escaped, control characters escaped: none may be in the
     * result */
    for (size_t i = 0; *status == CPS_OK && i < n;) {
        const size_t length = is_control(copy + i) ? 0 : cpsi_utf8_length(copy + i);
        if (length == 0)
            *status = cpsi_fail_at(p->err, CPS_ERR_INPUT, p->file, line, column,
                                   "found a text with a line break, a tab or a control character: "
                                   "write it on one line, without");
        i += length;
    }
    return *status == CPS_OK ? copy : NULL;
}

/* A new value below the innermost open collection, or the root. */
static CpsStatus add_value(Parse *p, CpsiYaml value, CpsiYaml **added) {
    if (++p->values > MAX_VALUES)
        return cpsi_fail_at(p->err, CPS_ERR_LIMIT, p->file, value.line, value.column,
                            "more than %d values in the file", (int)MAX_VALUES);
    CpsiYaml *node = CPSI_POOL_TAKE(p->pool, 1, CpsiYaml);
    if (!node) return out_of_memory(p);
    if (p->depth == 0) {
        p->root = node;
    } else {
        OpenCollection *parent = &p->open[p->depth - 1];
        if (parent->node->kind == CPSI_YAML_MAPPING) {
            value.key = parent->key;
            value.line = parent->line;
            value.column = parent->column;
        }
        parent->key = NULL;
        if (parent->last)
            parent->last->next = node;
        else
            parent->node->child = node;
        parent->last = node;
        parent->node->count++;
    }
    *node = value;
    *added = node;
    return CPS_OK;
}

static int by_key_then_place(const void *left, const void *right) {
    const CpsiYaml *a = *(CpsiYaml *const *)left, *b = *(CpsiYaml *const *)right;
    const int order = strcmp(a->key, b->key);
    if (order != 0) return order;
    return a->line != b->line ? (a->line < b->line ? -1 : 1)
                              : (a->column > b->column) - (a->column < b->column);
}

static CpsStatus check_duplicates(const Parse *p, const CpsiYaml *mapping) {
    if (mapping->count < 2) return CPS_OK;
    const CpsiYaml **sorted = malloc((size_t)mapping->count * sizeof *sorted);
    if (!sorted) return out_of_memory(p);
    size_t n = 0;
    for (const CpsiYaml *child = mapping->child; child; child = child->next) sorted[n++] = child;
    qsort(sorted, n, sizeof *sorted, by_key_then_place);
    CpsStatus status = CPS_OK;
    for (size_t i = 1; i < n && status == CPS_OK; i++)
        if (strcmp(sorted[i - 1]->key, sorted[i]->key) == 0)
            status =
                cpsi_fail_at(p->err, CPS_ERR_INPUT, p->file, sorted[i]->line, sorted[i]->column,
                             "key '%.64s' is given twice, first in line %d: keep one",
                             sorted[i]->key, sorted[i - 1]->line);
    free(sorted);
    return status;
}

static CpsStatus refuse(const Parse *p, int line, int column, const char *found) {
    return cpsi_fail_at(p->err, CPS_ERR_INPUT, p->file, line, column, "found %s", found);
}

static CpsStatus refuse_nothing(const Parse *p, const char *found) {
    return cpsi_fail_at(p->err, CPS_ERR_INPUT, p->file, 1, 1,
                        "found %s: a %s begins with 'capstan: 1'", found, p->what);
}

/* the position of an anchor or tag, not of the value after it */
static CpsStatus refuse_token(const Parse *p, struct fy_token *token, const char *found) {
    const struct fy_mark *mark = fy_token_start_mark(token);
    return refuse(p, mark ? mark->line + 1 : 1, mark ? mark->column + 1 : 1, found);
}

/* A scalar or the beginning of a collection. */
static CpsStatus read_value(Parse *p, struct fy_event *event, int line, int column) {
    struct fy_token *anchor = fy_event_get_anchor_token(event),
                    *tag = fy_event_get_tag_token(event);
    if (anchor) return refuse_token(p, anchor, "an anchor ('&'): write the value out instead");
    if (tag) return refuse_token(p, tag, "a tag ('!'): remove it");

    /* the value of the key has not been read yet */
    CpsStatus status = CPS_OK;
    OpenCollection *parent = p->depth > 0 ? &p->open[p->depth - 1] : NULL;
    const bool scalar = event->type == FYET_SCALAR;
    if (parent && parent->node->kind == CPSI_YAML_MAPPING && !parent->key) {
        if (!scalar)
            return refuse(p, line, column, "a mapping or a list as a key: a key is a word");
        parent->key = scalar_text(p, event, line, column, &status);
        parent->line = line;
        parent->column = column;
        return status;
    }

    CpsiYaml value = {.line = line, .column = column}, *added = NULL;
    if (scalar) {
        value.kind = CPSI_YAML_SCALAR;
        value.plain = fy_token_scalar_style(event->scalar.value) == FYSS_PLAIN;
        value.text = scalar_text(p, event, line, column, &status);
        return status == CPS_OK ? add_value(p, value, &added) : status;
    }
    if (p->depth == p->max_depth)
        return cpsi_fail_at(p->err, CPS_ERR_LIMIT, p->file, line, column,
                            "mappings and lists are nested deeper than %d, the limit",
                            p->max_depth);
    value.kind = event->type == FYET_MAPPING_START ? CPSI_YAML_MAPPING : CPSI_YAML_SEQUENCE;
    status = add_value(p, value, &added);
    if (status == CPS_OK) p->open[p->depth++] = (OpenCollection){.node = added};
    return status;
}

static CpsStatus read_event(Parse *p, struct fy_event *event) {
    const struct fy_mark *mark = fy_event_start_mark(event);
    /* an empty value has no position; that of the preceding token is used */
    if (mark) {
        p->line = mark->line + 1;
        p->column = mark->column + 1;
    }
    const int line = p->line;
    int column = p->column;
    if (event->type == FYET_SCALAR) {
        /* libfyaml gives the position after an opening quote */
        const enum fy_scalar_style style = fy_token_scalar_style(event->scalar.value);
        if ((style == FYSS_SINGLE_QUOTED || style == FYSS_DOUBLE_QUOTED) && column > 1) column--;
    }
    switch (event->type) {
    case FYET_DOCUMENT_START:
        if (++p->documents < 2) return CPS_OK;
        return cpsi_fail_at(p->err, CPS_ERR_INPUT, p->file, line, column,
                            "found a second document ('---'): a file holds one %s", p->what);
    case FYET_ALIAS: return refuse(p, line, column, "an alias ('*'): write the value out instead");
    case FYET_SCALAR:
    case FYET_MAPPING_START:
    case FYET_SEQUENCE_START: return read_value(p, event, line, column);
    case FYET_MAPPING_END: return check_duplicates(p, p->open[--p->depth].node);
    case FYET_SEQUENCE_END: p->depth--; return CPS_OK;
    default: return CPS_OK;
    }
}

/* libfyaml stopped: return its first message */
static CpsStatus syntax_error(const Parse *p, struct fy_diag *diag) {
    void *previous = NULL;
    const struct fy_diag_error *error = fy_diag_errors_iterate(diag, &previous);
    if (!error) return out_of_memory(p);
    const int line = error->line > 0 ? error->line : 1,
              column = error->column > 0 ? error->column : 1;
    return cpsi_fail_at(p->err, CPS_ERR_INPUT, p->file, line, column, "not valid YAML: %.200s",
                        error->msg);
}

static CpsStatus read_all(Parse *p, struct fy_parser *parser, struct fy_diag *diag) {
    for (bool ended = false; !ended;) {
        struct fy_event *event = fy_parser_parse(parser);
        if (!event) return syntax_error(p, diag);
        ended = event->type == FYET_STREAM_END;
        const CpsStatus status = read_event(p, event);
        fy_parser_event_free(parser, event);
        if (status != CPS_OK) return status;
    }
    if (!p->root) return refuse_nothing(p, "nothing");
    return CPS_OK;
}

CpsStatus cpsi_yaml_parse(const char *file, const char *what, const char *bytes, size_t size,
                          int max_depth, CpsiPool *pool, CpsiYaml **root, CpsError *err) {
    Parse p = {.file = file,
               .what = what,
               .bytes = bytes,
               .size = size,
               .pool = pool,
               .err = err,
               .max_depth = max_depth,
               .line = 1,
               .column = 1};
    *root = NULL;
    CpsStatus status = check_characters(&p, bytes, size);
    if (status != CPS_OK) return status;
    if (size == 0) return refuse_nothing(&p, "an empty file");
    int line;
    const char *found;
    if (!cpsi_yaml_lines(bytes, size, &line, &found)) return refuse(&p, line, 1, found);

    /* messages are collected instead of printed */
    struct fy_diag_cfg quiet;
    fy_diag_cfg_default(&quiet);
    quiet.fp = NULL;
    struct fy_diag *diag = fy_diag_create(&quiet);
    if (diag) fy_diag_set_collect_errors(diag, true);
    const struct fy_parse_cfg config = {.flags = FYPCF_QUIET | FYPCF_COLLECT_DIAG |
                                                 FYPCF_DISABLE_DEPTH_LIMIT |
                                                 FYPCF_DEFAULT_VERSION_1_2 | FYPCF_JSON_NONE,
                                        .diag = diag};
    struct fy_parser *parser = diag ? fy_parser_create(&config) : NULL;
    p.open = CPSI_POOL_TAKE(pool, max_depth, OpenCollection);
    if (!parser || !p.open || fy_parser_set_string(parser, bytes, size) != 0)
        status = out_of_memory(&p);
    else
        status = read_all(&p, parser, diag);
    if (parser) fy_parser_destroy(parser);
    if (diag) fy_diag_destroy(diag);
    if (status == CPS_OK) *root = p.root;
    return status;
}
