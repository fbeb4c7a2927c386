/* SPDX-License-Identifier: BSD-3-Clause */
/* Reading by tables of keys (see key_reader.h). The depth of the recursion is that of the tables,
 * not of the file. A size is checked before memory is allocated for it. */
#include "io/read/key_reader.h"
#include "capstan/io.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "io/schema/tables/set_keys.h"

/* A value that is being read: its row, and its name in messages. */
typedef struct Value {
    const CpsiDocument *d;
    const CpsiKey *key;
    const char *what;
} Value;

static CpsStatus wrong(const Value *v, const CpsiYaml *node, const char *hint) {
    char accepted[400], expected[460];
    int length = 0;
    const char *now =
        node->kind == CPSI_YAML_SCALAR ? cpsi_key_renamed_word(v->key, node->text, &length) : NULL;
    if (now)
        return cpsi_document_fail(v->d, CPS_ERR_INPUT, node, "%s: '%s' is now '%.*s'", v->what,
                                  node->text, length, now);
    snprintf(expected, sizeof expected, "%s%s",
             cpsi_key_expected(v->key, accepted, sizeof accepted), hint);
    return cpsi_document_wrong(v->d, node, v->what, expected);
}

static CpsStatus too_many(const Value *v, const CpsiYaml *node, int found, const char *of,
                          int most) {
    return cpsi_document_fail(v->d, CPS_ERR_LIMIT, node, "%s: found %d %s, at most %d", v->what,
                              found, of, most);
}

static bool is_list(const CpsiYaml *node) {
    return node->kind == CPSI_YAML_SEQUENCE && node->count > 0;
}

static bool is_word_with_value(const CpsiYaml *node) {
    return node->kind == CPSI_YAML_MAPPING && node->count == 1;
}

/* ---- numbers ---- */

/* A finite number within the row's range, or an infinite one where that allows it. */
static CpsStatus read_number(const Value *v, const CpsiYaml *node, const CpsiKey *range,
                             double *out) {
    double x = NAN;
    if (node->kind != CPSI_YAML_SCALAR || !node->plain) return wrong(v, node, "");
    if (!cpsi_yaml_number(node->text, &x)) {
        const bool unit =
            strspn(node->text, "+-.0123456789eE") > 0 && strpbrk(node->text, "0123456789");
        const bool comma = strchr(node->text, ',') != NULL;
        return wrong(v, node,
                     !unit   ? ""
                     : comma ? ": write a decimal point"
                             : ": write the number alone, without a unit");
    }
    const bool above = range->open ? x > range->low : x >= range->low;
    const bool endless = x == INFINITY && isinf(range->high);
    if (!endless && !(fabs(x) <= CPSI_LARGEST)) return wrong(v, node, ", finite and at most 1e100");
    if (!above || !(x <= range->high)) return wrong(v, node, "");
    *out = x;
    return CPS_OK;
}

static CpsStatus read_whole(const Value *v, const CpsiYaml *node, const CpsiKey *range,
                            double *out) {
    double x = 0;
    const CpsStatus status = read_number(v, node, range, &x);
    if (status != CPS_OK) return status;
    if (x != floor(x)) return wrong(v, node, "");
    *out = x;
    return CPS_OK;
}

/* All numbers of a list, each within the range. */
static CpsStatus read_numbers(const Value *v, const CpsiYaml *list, const CpsiKey *range,
                              double *out) {
    const CpsiKey number = {.type = CPSI_NUMBER,
                            .low = range->low,
                            .high = range->high,
                            .open = range->open,
                            .unit = v->key->unit};
    const Value each = {v->d, &number, v->what};
    CpsStatus status = CPS_OK;
    for (const CpsiYaml *x = list->child; x && status == CPS_OK; x = x->next)
        status = read_number(&each, x, &number, out++);
    return status;
}

/* ---- rows ---- */

static const CpsiKey ANY_NUMBER = {.type = CPSI_NUMBER, .low = -CPSI_LARGEST, .high = CPSI_LARGEST};

static CpsStatus reserve_rows(const Value *v, const CpsiYaml *node, int rows, int columns,
                              CpsiNumberRows *out) {
    *out = (CpsiNumberRows){.node = node, .rows = rows, .columns = columns};
    out->x = CPSI_POOL_TAKE(v->d->pool, (size_t)rows * (size_t)columns, double);
    return out->x ? CPS_OK : cpsi_document_no_memory(v->d);
}

static CpsStatus read_vector(const Value *v, const CpsiYaml *node, const CpsiKey *form,
                             CpsiNumberRows *out) {
    if (!is_list(node)) return wrong(v, node, "");
    if (node->count > form->most) return too_many(v, node, node->count, "numbers", form->most);
    const CpsStatus status = reserve_rows(v, node, 1, node->count, out);
    return status ? status : read_numbers(v, node, form, out->x);
}

static CpsStatus read_rows(const Value *v, const CpsiYaml *node, const CpsiKey *form,
                           CpsiNumberRows *out) {
    const bool list = is_list(node) && node->child->kind == CPSI_YAML_SEQUENCE;
    if (!list || node->count < form->low) return wrong(v, node, "");
    const int columns = form->most ? form->most : node->child->count;
    for (const CpsiYaml *row = node->child; row; row = row->next)
        if (!is_list(row) || row->count != columns) return wrong(v, row, "");
    if (columns > CPSI_LAW_MOST_COMPONENTS)
        return too_many(v, node->child, columns, "numbers", CPSI_LAW_MOST_COMPONENTS);
    const bool square = form->type != CPSI_SQUARE || columns == node->count;
    if (!square || (form->low == form->high && node->count > form->high)) return wrong(v, node, "");
    if (node->count > form->high) return too_many(v, node, node->count, "rows", (int)form->high);
    CpsStatus status = reserve_rows(v, node, node->count, columns, out);
    double *x = out->x;
    for (const CpsiYaml *row = node->child; row && status == CPS_OK; row = row->next, x += columns)
        status = read_numbers(v, row, &ANY_NUMBER, x);
    return status;
}

/* An end of a side; it may be infinite only on its own side. */
static CpsStatus read_end(const Value *v, const CpsiYaml *node, double low, double end,
                          double *out) {
    const CpsiKey range = {.type = CPSI_NUMBER, .low = low, .high = CPSI_LARGEST};
    const Value number = {v->d, &range, v->what};
    double x = NAN;
    const bool plain =
        node->kind == CPSI_YAML_SCALAR && node->plain && cpsi_yaml_number(node->text, &x);
    if (!plain || x != end) return read_number(&number, node, &range, out);
    *out = end;
    return CPS_OK;
}

/* b for [-b, b], or [low, high] */
static CpsStatus read_side(const Value *v, const CpsiYaml *node, double *low, double *high) {
    if (node->kind == CPSI_YAML_SCALAR) {
        const CpsStatus status = read_end(v, node, 0, INFINITY, high);
        *low = -*high;
        return status;
    }
    if (node->kind != CPSI_YAML_SEQUENCE || node->count != 2) return wrong(v, node, "");
    const CpsStatus status = read_end(v, node->child, -CPSI_LARGEST, -INFINITY, low);
    return status ? status : read_end(v, node->child->next, -CPSI_LARGEST, INFINITY, high);
}

static CpsStatus read_sides(const Value *v, const CpsiYaml *node, const CpsiKey *form,
                            CpsiNumberRows *out) {
    if (!is_list(node)) return wrong(v, node, "");
    const int n = node->count;
    if (n > form->most) return too_many(v, node, n, "numbers", form->most);
    const CpsiKey side = {.type = CPSI_SIDE};
    const Value each = {v->d, &side, v->what};
    CpsStatus status = reserve_rows(v, node, 2, n, out);
    int i = 0;
    for (const CpsiYaml *item = node->child; item && status == CPS_OK; item = item->next, i++)
        status = read_side(&each, item, &out->x[i], &out->x[n + i]);
    return status;
}

/* ---- values read later ---- */

/* [length, [count, length], ..] */
static CpsStatus check_elements(const Value *v, const CpsiYaml *node, const CpsiKey *form) {
    const CpsiKey count = {.type = CPSI_COUNT, .low = 1, .high = CPSI_LARGEST};
    const CpsiKey length = {
        .type = CPSI_NUMBER, .low = form->low, .high = form->high, .open = form->open, .unit = "m"};
    const Value counted = {v->d, &count, v->what}, measured = {v->d, &length, v->what};
    double unused;
    if (!is_list(node)) return wrong(v, node, "");
    CpsStatus status = CPS_OK;
    for (const CpsiYaml *item = node->child; item && status == CPS_OK; item = item->next) {
        if (item->kind == CPSI_YAML_SCALAR) {
            status = read_number(&measured, item, &length, &unused);
        } else if (item->kind == CPSI_YAML_SEQUENCE && item->count == 2) {
            status = read_whole(&counted, item->child, &count, &unused);
            if (status == CPS_OK)
                status = read_number(&measured, item->child->next, &length, &unused);
        } else {
            status = wrong(v, item, "");
        }
    }
    return status;
}

/* The node itself, whose form is checked as far as its type determines it. */
static CpsStatus keep_node(const Value *v, const CpsiYaml *node, const CpsiKey *form,
                           const CpsiYaml **out) {
    *out = node;
    if (form->type == CPSI_ELEMENTS) return check_elements(v, node, form);
    if (form->type == CPSI_EXPRESSION)
        return is_word_with_value(node) ? CPS_OK : wrong(v, node, "");
    if (form->type == CPSI_BY_NAME)
        return node->kind == CPSI_YAML_MAPPING ? CPS_OK : wrong(v, node, "");
    if (!is_list(node)) return wrong(v, node, "");
    if (form->type == CPSI_NAMES && node->count > form->most)
        return too_many(v, node, node->count, "names", form->most);
    for (const CpsiYaml *item = node->child; item; item = item->next) {
        const bool name = item->kind == CPSI_YAML_SCALAR && *item->text;
        if (form->type == CPSI_EXPRESSIONS ? !is_word_with_value(item)
                                           : form->type == CPSI_NAMES && !name)
            return wrong(v, item, "");
    }
    return CPS_OK;
}

/* ---- scalars ---- */

static CpsStatus read_text(const Value *v, const CpsiYaml *node, const CpsiKey *form,
                           const char **out) {
    const bool scalar = node->kind == CPSI_YAML_SCALAR;
    const size_t most = (size_t)form->most, length = scalar ? strlen(node->text) : 0;
    if (!scalar || (most > 0 ? length > most : length == 0)) return wrong(v, node, "");
    *out = node->text;
    return CPS_OK;
}

static CpsStatus read_word(const Value *v, const CpsiYaml *node, const char *words, void *out) {
    const int which = node->kind == CPSI_YAML_SCALAR ? cpsi_key_word(words, node->text) : -1;
    if (which < 0) return wrong(v, node, "");
    memcpy(out, &which, sizeof which); /* an int, or an enum */
    return CPS_OK;
}

/* [word, ..] */
static CpsStatus read_words(const Value *v, const CpsiYaml *node, const CpsiKey *form, bool *out) {
    if (node->kind != CPSI_YAML_SEQUENCE) return wrong(v, node, "");
    memset(out, 0, (size_t)form->most * sizeof *out);
    for (const CpsiYaml *item = node->child; item; item = item->next) {
        const int which =
            item->kind == CPSI_YAML_SCALAR ? cpsi_key_word(form->words, item->text) : -1;
        if (which < 0 || out[which]) return wrong(v, item, "");
        out[which] = true;
    }
    return CPS_OK;
}

static CpsStatus read_flag(const Value *v, const CpsiYaml *node, bool *out) {
    const int which = node->kind == CPSI_YAML_SCALAR && node->plain
                          ? cpsi_key_word("false true", node->text)
                          : -1;
    if (which < 0) return wrong(v, node, "");
    *out = which;
    return CPS_OK;
}

static CpsStatus read_integer(const Value *v, const CpsiYaml *node, const CpsiKey *form, int *out) {
    double x = *out;
    const CpsStatus status = read_whole(v, node, form, &x);
    *out = (int)x;
    return status;
}

static CpsStatus read_point(const Value *v, const CpsiYaml *node, const CpsiKey *form,
                            double *out) {
    if (node->kind != CPSI_YAML_SEQUENCE || node->count != form->most) return wrong(v, node, "");
    return read_numbers(v, node, form, out);
}

/* [mapping, ..] or {name: mapping, ..} */
static CpsStatus read_list(const Value *v, const CpsiYaml *node, const CpsiKey *form,
                           CpsiList *out) {
    const CpsiMapping *each = form->inside;
    const bool named = form->type == CPSI_NAMED;
    if (node->kind != (named ? CPSI_YAML_MAPPING : CPSI_YAML_SEQUENCE) || node->count < form->most)
        return wrong(v, node, "");
    char *item = cpsi_pool_take(v->d->pool, (size_t)node->count, each->size), what[160];
    *out = (CpsiList){.node = node, .count = node->count, .item = item};
    if (!item) return cpsi_document_no_memory(v->d);
    CpsStatus status = CPS_OK;
    for (const CpsiYaml *child = node->child; child && status == CPS_OK; child = child->next) {
        snprintf(what, sizeof what, named ? "%s '%.64s'" : "%s", each->name, child->key);
        status = cpsi_read_mapping(v->d, child, each, what, item);
        item += each->size;
    }
    return status;
}

/* ---- values ---- */

/* Whether the value has this form. Forms that only some scalars have come first in a row. */
static bool has_form(const CpsiYaml *node, const CpsiKey *form) {
    switch (form->type) {
    case CPSI_WORD:
        return node->kind == CPSI_YAML_SCALAR && cpsi_key_word(form->words, node->text) >= 0;
    case CPSI_TEXT:
    case CPSI_INTEGER:
    case CPSI_COUNT:
    case CPSI_NUMBER:
    case CPSI_FLAG: return node->kind == CPSI_YAML_SCALAR;
    case CPSI_EXPRESSION:
    case CPSI_BY_NAME:
    case CPSI_MAPPING:
    case CPSI_NAMED: return node->kind == CPSI_YAML_MAPPING;
    default: return node->kind == CPSI_YAML_SEQUENCE;
    }
}

static CpsStatus read_form(const Value *v, const CpsiYaml *node, const CpsiKey *form, void *to) {
    switch (form->type) {
    case CPSI_TEXT: return read_text(v, node, form, to);
    case CPSI_INTEGER: return read_integer(v, node, form, to);
    case CPSI_COUNT: return read_whole(v, node, form, to);
    case CPSI_NUMBER: return read_number(v, node, form, to);
    case CPSI_FLAG: return read_flag(v, node, to);
    case CPSI_WORD: return read_word(v, node, form->words, to);
    case CPSI_POINT: return read_point(v, node, form, to);
    case CPSI_WORDS: return read_words(v, node, form, to);
    case CPSI_VECTOR: return read_vector(v, node, form, to);
    case CPSI_ROWS:
    case CPSI_SQUARE: return read_rows(v, node, form, to);
    case CPSI_SIDE: {
        CpsiNumberRows *side = to;
        const CpsStatus status = reserve_rows(v, node, 2, 1, side);
        return status ? status : read_side(v, node, &side->x[0], &side->x[1]);
    }
    case CPSI_SIDES: return read_sides(v, node, form, to);
    case CPSI_MAPPING:
        if (node->kind != CPSI_YAML_MAPPING) return wrong(v, node, "");
        return cpsi_read_mapping(v->d, node, form->inside, v->what, to);
    case CPSI_LIST:
    case CPSI_NAMED: return read_list(v, node, form, to);
    default: return keep_node(v, node, form, to);
    }
}

CpsStatus cpsi_read_value(const CpsiDocument *d, const CpsiYaml *node, const CpsiKey *key,
                          const char *what, void *out) {
    const Value v = {d, key, what};
    const CpsiKey *form = key;
    if (key->other)
        while (form && !has_form(node, form)) form = form->other;
    return form ? read_form(&v, node, form, (char *)out + form->offset) : wrong(&v, node, "");
}

CpsStatus cpsi_read_number(const CpsiDocument *d, const CpsiYaml *node, const char *what,
                           double *out) {
    const Value v = {d, &ANY_NUMBER, what};
    return read_number(&v, node, &ANY_NUMBER, out);
}

CpsStatus cpsi_expect_columns(const CpsiDocument *d, const CpsiNumberRows *rows, const char *what,
                              int columns) {
    const CpsiKey key = {.type = CPSI_ROWS, .most = columns, .low = 1, .high = CPSI_LARGEST};
    const Value v = {d, &key, what};
    return rows->columns == columns ? CPS_OK : wrong(&v, rows->node->child, "");
}

CpsStatus cpsi_expect_components(const CpsiDocument *d, const CpsiNumberRows *vector,
                                 const char *what, int components) {
    const CpsiKey key = {.type = CPSI_POINT, .most = components};
    const Value v = {d, &key, what};
    return vector->columns == components ? CPS_OK : wrong(&v, vector->node, "");
}

/* ---- mappings ---- */

/* The text before the last dot must be a key under `owner`, "lines" or "obstacles". */
static CpsStatus check_owner(const CpsiDocument *d, const CpsiYaml *node, const char *owner) {
    const CpsiYaml *all = cpsi_yaml_child(d->root, owner);
    const char *dot = strrchr(node->key, '.');
    const size_t n = (size_t)(dot - node->key);
    char wanted[80] = ""; /* stays empty for a text too long for a name */
    if (n < sizeof wanted) memcpy(wanted, node->key, n);
    if (wanted[0] && cpsi_yaml_child(all, wanted)) return CPS_OK;
    CpsSuggestion suggestion = {.word = wanted};
    for (const CpsiYaml *one = all ? all->child : NULL; one; one = one->next)
        cps_suggest(&suggestion, one->key);
    const int all_letters = (int)strlen(owner);
    const bool ies = all_letters > 3 && strcmp(owner + all_letters - 3, "ies") == 0;
    const int letters = all_letters - (ies ? 3 : 1); /* "line" of "lines", "bod" of "bodies" */
    const char *singular = ies ? "y" : "";
    if (suggestion.best)
        return cpsi_document_fail(d, CPS_ERR_INPUT, node,
                                  "'%.80s': there is no such %.*s%s; did you mean '%.64s%s'?",
                                  node->key, letters, owner, singular, suggestion.best, dot);
    return cpsi_document_fail(d, CPS_ERR_INPUT, node, "'%.80s': there is no such %.*s%s under '%s'",
                              node->key, letters, owner, singular, owner);
}

/* Memory in the lists of keys with an owner for as many as are given. */
static CpsStatus reserve_owned(const CpsiDocument *d, const CpsiYaml *node,
                               const CpsiMapping *mapping, char *out) {
    for (int i = 0; i < mapping->count; i++) {
        const CpsiKey *key = &mapping->key[i];
        CpsiList *list = (CpsiList *)(void *)(out + key->offset);
        if (!key->owner) continue;
        const size_t size = key->inside ? key->inside->size : sizeof(CpsiNumberItem);
        list->node = node;
        list->item = cpsi_pool_take(d->pool, (size_t)node->count, size);
        if (!list->item) return cpsi_document_no_memory(d);
    }
    return CPS_OK;
}

/* The value of a key with an owner: one more item of its list. */
static CpsStatus read_owned(const CpsiDocument *d, const CpsiYaml *node, const CpsiKey *key,
                            CpsiList *list) {
    char what[90];
    const size_t size = key->inside ? key->inside->size : sizeof(CpsiNumberItem);
    CpsiNumberItem *number = (CpsiNumberItem *)list->item;
    CpsiKey item = *key;
    item.offset = 0;
    const CpsStatus status = check_owner(d, node, key->owner);
    if (status != CPS_OK) return status;
    snprintf(what, sizeof what, "'%.80s'", node->key);
    if (key->inside)
        return cpsi_read_value(d, node, &item, what,
                               (char *)list->item + size * (size_t)list->count++);
    number += list->count++;
    number->node = node;
    return cpsi_read_value(d, node, &item, what, &number->number);
}

/* The index of the key CPSI_ONE_OF that is given. */
static int which_given(const CpsiYaml *node, const CpsiMapping *mapping) {
    int which = 0;
    for (int i = 0; i < mapping->count; i++) {
        if (mapping->key[i].need != CPSI_ONE_OF) continue;
        if (cpsi_yaml_child(node, mapping->key[i].name)) break;
        which++;
    }
    return which;
}

CpsStatus cpsi_read_mapping(const CpsiDocument *d, const CpsiYaml *node, const CpsiMapping *mapping,
                            const char *what, void *out) {
    if (node->kind != CPSI_YAML_MAPPING) {
        const CpsiKey key = {.type = CPSI_MAPPING, .inside = mapping};
        const Value v = {d, &key, what};
        return wrong(&v, node, "");
    }
    for (const CpsiYaml *child = node->child; child; child = child->next)
        if (!cpsi_key_find(mapping, child->key))
            return cpsi_key_unknown(d->name, child, what, mapping, d->err);
    if (mapping->begin) mapping->begin(out);
    CpsStatus status = reserve_owned(d, node, mapping, out);
    for (const CpsiYaml *child = node->child; child && status == CPS_OK; child = child->next) {
        const CpsiKey *key = cpsi_key_find(mapping, child->key);
        char name[90];
        snprintf(name, sizeof name, "'%.80s'", child->key);
        if (key->owner)
            status = read_owned(d, child, key, (CpsiList *)(void *)((char *)out + key->offset));
        else
            status = cpsi_read_value(d, child, key, name, out);
    }
    if (status == CPS_OK) status = cpsi_key_needs(d->name, node, what, mapping, d->err);
    const int which = which_given(node, mapping);
    if (status == CPS_OK && mapping->which)
        memcpy((char *)out + *mapping->which, &which, sizeof which);
    if (mapping->size > 0) memcpy(out, &node, sizeof node);
    return status;
}
