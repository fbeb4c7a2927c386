/* SPDX-License-Identifier: BSD-3-Clause */
/* Names and messages from the rows of tables of keys (see keys.h). */
#include "io/schema/keys.h"
#include "capstan/io.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

int cpsi_key_word(const char *words, const char *written) {
    const size_t n = strlen(written);
    int number = 0;
    for (const char *word = words; word && *word; number++) {
        const size_t length = strcspn(word, " ");
        if (length == n && memcmp(word, written, n) == 0) return number;
        word += length + (word[length] == ' ');
    }
    return -1;
}

/* Whether this is the name of the row, or of its form. */
static bool has_name(const CpsiKey *key, const char *written) {
    if (!key->owner) return strcmp(key->name, written) == 0;
    const char *dot = strrchr(written, '.');
    return dot && dot > written && cpsi_key_word(key->after, dot + 1) >= 0;
}

const CpsiKey *cpsi_key_find(const CpsiMapping *mapping, const char *written) {
    for (int i = 0; i < mapping->count; i++)
        if (has_name(&mapping->key[i], written)) return &mapping->key[i];
    return NULL;
}

const char *cpsi_key_renamed_word(const CpsiKey *key, const char *written, int *length) {
    for (const CpsiKey *form = key; form; form = form->other) {
        int number = cpsi_key_word(form->former_words, written);
        if (number < 0 || cpsi_key_word(form->words, written) >= 0) continue;
        const char *now = form->words;
        for (; number > 0; number--) now += strcspn(now, " ") + 1;
        *length = (int)strcspn(now, " ");
        return now;
    }
    return NULL;
}

/* The row of a key that earlier versions called so; NULL: there is none. */
static const CpsiKey *find_former(const CpsiMapping *mapping, const char *written) {
    for (int i = 0; i < mapping->count; i++)
        if (cpsi_key_word(mapping->key[i].formerly, written) >= 0) return &mapping->key[i];
    return NULL;
}

/* ---- what a row accepts ---- */

/* A text under construction; what exceeds its size is dropped. */
typedef struct Text {
    char *text;
    size_t size, used;
} Text;

__attribute__((format(printf, 2, 3))) static void put(Text *out, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    if (out->used < out->size)
        out->used +=
            (size_t)vsnprintf(out->text + out->used, out->size - out->used, format, arguments);
    va_end(arguments);
}

static void write_names(Text *out, const CpsiMapping *mapping) {
    for (int i = 0; i < mapping->count; i++) put(out, "%s%s", i ? ", " : "", mapping->key[i].name);
}

static void write_unit(Text *out, const char *unit) {
    if (unit) put(out, " in %s", unit);
}

/* " in m, greater than 0", ", from 1 to 1000", .. */
static void write_range(Text *out, const CpsiKey *key, const char *unit) {
    write_unit(out, unit);
    if (key->low <= -CPSI_LARGEST) return;
    if (key->high < CPSI_LARGEST && key->low == key->high)
        put(out, ": %.15g", key->low);
    else if (key->high < CPSI_LARGEST)
        put(out, ", from %.15g to %.15g", key->low, key->high);
    else
        put(out, ", %s %.15g%s", key->open ? "greater than" : "at least", key->low,
            isinf(key->high) ? ", or .inf" : "");
}

/* "a list of at least 2 rows of 2 numbers, as in [[x, y], [x, y]]" */
static void write_rows(Text *out, const CpsiKey *key, const char *unit) {
    static const char *const ROWS[] = {"[1, 0], [0, 1]", "[x], [x]", "[x, y], [x, y]",
                                       "[x, y, z], [x, y, z]"};
    if (key->low == key->high)
        put(out, "%g ", key->low);
    else if (key->most > 0)
        put(out, "a list of at least %g ", key->low);
    put(out, key->low == 1 && key->most > 0 ? "row of " : "rows of ");
    if (key->most == 0)
        put(out, "numbers, all equally long");
    else
        put(out, "%d number%s", key->most, key->most == 1 ? "" : "s");
    write_unit(out, unit);
    if (key->most < 4) put(out, ", as in [%s]", ROWS[key->most]);
}

/* Values whose form does not depend on the row. */
static const char *const ALWAYS[] = {
    [CPSI_FLAG] = "true or false",
    [CPSI_VECTOR] = "a list of numbers, as in [1, 2]",
    [CPSI_SQUARE] = "a square matrix, as in [[1, 0], [0, 1]]",
    [CPSI_SIDE] = "a number b for -b .. b, or two, as in [-1, 2]",
    [CPSI_SIDES] = "half widths, as in [300, 100], or sides, as in [[-1, 2], [0, 5]]",
    [CPSI_ELEMENTS] = "a list of lengths and [count, length] in m",
    [CPSI_NAMES] = "a list of names, as in [omega, side, roll]",
    [CPSI_COMBINATIONS] = "a list of parameters, as in [side, {roll: 1, omega: -0.3}]",
    [CPSI_BY_NAME] = "forces by parameter, as in {roll: -5}",
};

static void write_form(Text *out, const CpsiKey *key, const char *unit) {
    static const char *const COORDINATES[] = {
        "", "[x]", "[x, y]", "[x, y, z]", "[w, x, y, z]", "", "[x, y, z, rx, ry, rz]"};
    static const char *const NUMBER[] = {
        "",           "one number", "two numbers", "three numbers", "four numbers", "five numbers",
        "six numbers"};
    switch (key->type) {
    case CPSI_TEXT:
        put(out, "a text");
        if (key->most > 0)
            put(out, " of at most %d bytes", key->most);
        else
            put(out, ", not empty");
        break;
    case CPSI_NUMBER:
        put(out, "a number");
        write_range(out, key, unit);
        break;
    case CPSI_INTEGER:
    case CPSI_COUNT:
        put(out, "a whole number");
        write_range(out, key, unit);
        break;
    case CPSI_POINT:
        put(out, "%s", NUMBER[key->most]);
        write_unit(out, unit);
        put(out, ", as in %s", COORDINATES[key->most]);
        break;
    case CPSI_ROWS: write_rows(out, key, unit); break;
    case CPSI_WORDS: put(out, "a list of some of: %s, each once", key->words); break;
    case CPSI_WORD: put(out, strchr(key->words, ' ') ? "one of: %s" : "'%s'", key->words); break;
    case CPSI_EXPRESSION:
        put(out, "one %s with its value, as in %s", key->inside->word, key->inside->example);
        break;
    case CPSI_EXPRESSIONS:
        put(out, "a list of at least one %s with its value, as in [%s]", key->inside->word,
            key->inside->example);
        break;
    case CPSI_NAMED: put(out, "a mapping with a name for each %s", key->inside->name); break;
    case CPSI_LIST:
        put(out, "a list, as in [%s]",
            key->inside->example ? key->inside->example : "{...}, {...}");
        break;
    case CPSI_MAPPING:
        put(out, "a mapping with ");
        write_names(out, key->inside);
        break;
    default: put(out, "%s", ALWAYS[key->type]);
    }
}

const char *cpsi_key_expected(const CpsiKey *key, char *text, size_t size) {
    Text out = {.text = text, .size = size};
    for (const CpsiKey *form = key; form; form = form->other) {
        write_form(&out, form, key->unit);
        if (form->other) put(&out, ", or ");
    }
    return text;
}

/* ---- messages ---- */

/* Description of a value in messages. */
static const char *found_text(const CpsiYaml *node, char *text, size_t size) {
    if (node->kind == CPSI_YAML_MAPPING)
        snprintf(text, size, "a mapping");
    else if (node->kind == CPSI_YAML_SEQUENCE)
        snprintf(text, size, "a list of %d", node->count);
    else if (!node->plain)
        snprintf(text, size, "the text \"%.60s\" in quotes", node->text);
    else if (!node->text[0])
        snprintf(text, size, "nothing");
    else
        snprintf(text, size, "'%.60s'", node->text);
    return text;
}

CpsStatus cpsi_key_wrong(const char *file, const CpsiYaml *node, const char *what,
                         const char *expected, CpsError *err) {
    char found[160];
    return cpsi_fail_at(err, CPS_ERR_INPUT, file, node->line, node->column,
                        "%s: found %s, expected %s", what, found_text(node, found, sizeof found),
                        expected);
}

CpsStatus cpsi_key_unknown(const char *file, const CpsiYaml *node, const char *what,
                           const CpsiMapping *mapping, CpsError *err) {
    const CpsiKey *key = mapping->key;
    CpsSuggestion suggestion = {.word = node->key};
    char names[400], start[160];
    Text list = {.text = names, .size = sizeof names};
    const CpsiKey *renamed = find_former(mapping, node->key);
    if (renamed)
        return cpsi_fail_at(err, CPS_ERR_INPUT, file, node->line, node->column,
                            "%s: '%s' is now '%s'%s%s", what, node->key, renamed->name,
                            renamed->instead ? ", " : "", renamed->instead ? renamed->instead : "");
    for (int i = 0; i < mapping->count; i++)
        if (!key[i].owner) cps_suggest(&suggestion, key[i].name);
    if (mapping->word)
        snprintf(start, sizeof start, "unknown %s", mapping->word);
    else
        snprintf(start, sizeof start, "%s: unknown key", what);
    if (suggestion.best)
        return cpsi_fail_at(err, CPS_ERR_INPUT, file, node->line, node->column,
                            "%s '%.64s'; did you mean '%s'?", start, node->key, suggestion.best);
    write_names(&list, mapping);
    return cpsi_fail_at(err, CPS_ERR_INPUT, file, node->line, node->column,
                        "%s '%.64s', expected %s %s", start, node->key,
                        mapping->word ? "one of:" : "a mapping with", names);
}

CpsStatus cpsi_key_needs(const char *file, const CpsiYaml *node, const char *what,
                         const CpsiMapping *mapping, CpsError *err) {
    char names[200] = "";
    Text list = {.text = names, .size = sizeof names};
    const CpsiYaml *alone = NULL; /* a key that is given without the key that it needs */
    const CpsiKey *companion = NULL;
    int alternatives = 0, given = 0;
    for (int i = 0; i < mapping->count; i++) {
        const CpsiKey *key = &mapping->key[i];
        const CpsiYaml *value = cpsi_yaml_child(node, key->name);
        const bool replaced = key->unless && cpsi_yaml_child(node, key->unless);
        if (value && replaced)
            return cpsi_fail_at(err, CPS_ERR_INPUT, file, value->line, value->column,
                                "'%s': it does not go with '%s': leave one of them out", key->name,
                                key->unless);
        if (key->need == CPSI_REQUIRED && !value && !replaced)
            return cpsi_fail_at(err, CPS_ERR_INPUT, file, node->line, node->column,
                                "%s: '%s' is missing: %s%s%s%s", what, key->name,
                                key->unit ? "[" : "", key->unit ? key->unit : "",
                                key->unit ? "] " : "", key->help);
        if (value && key->with && !cpsi_yaml_child(node, key->with)) {
            alone = value;
            companion = key;
        }
        if (key->need != CPSI_ONE_OF) continue;
        put(&list, "%s'%s'", alternatives++ ? ", " : "", key->name);
        given += value != NULL;
    }
    if (alternatives > 0 && given != 1)
        return cpsi_fail_at(err, CPS_ERR_INPUT, file, node->line, node->column,
                            "%s: %s, expected exactly one of %s", what,
                            given == 0 ? "nothing given" : "too much given", names);
    if (!alone) return CPS_OK;
    return cpsi_fail_at(err, CPS_ERR_INPUT, file, alone->line, alone->column,
                        "'%s': it goes with '%s', which is not given", alone->key, companion->with);
}
