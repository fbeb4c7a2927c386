/* SPDX-License-Identifier: BSD-3-Clause */
/* What is said of rows of tables of keys (see keys.h). */
#include "io/schema/keys.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

int cpsi_key_word(const CpsiKey *key, const char *written) {
    const size_t n = strlen(written);
    int number = 0;
    for (const char *word = key->words; word && *word; number++) {
        const size_t length = strcspn(word, " ");
        if (length == n && memcmp(word, written, n) == 0) return number;
        word += length + (word[length] == ' ');
    }
    return -1;
}

/* Edits (insert, delete, replace a letter, capitals ignored) between two words of at most 31 letters; else 32. */
static int edit_distance(const char *a, const char *b) {
    enum { MOST = 32 };
    const size_t na = strlen(a), nb = strlen(b);
    if (na >= MOST || nb >= MOST) return MOST;
    int row[MOST];
    for (size_t j = 0; j <= nb; j++) row[j] = (int)j;
    for (size_t i = 1; i <= na; i++) {
        int diagonal = row[0];
        row[0] = (int)i;
        for (size_t j = 1; j <= nb; j++) {
            const int above = row[j];
            const bool same = tolower((unsigned char)a[i - 1]) == tolower((unsigned char)b[j - 1]);
            int least = diagonal + (same ? 0 : 1);
            if (above + 1 < least) least = above + 1;
            if (row[j - 1] + 1 < least) least = row[j - 1] + 1;
            row[j] = least;
            diagonal = above;
        }
    }
    return row[nb];
}

void cpsi_suggest(CpsiSuggestion *suggestion, const char *candidate) {
    const int distance = edit_distance(suggestion->word, candidate);
    const int allowed = ((int)strlen(candidate) + 2) / 3;
    if (distance <= allowed && (!suggestion->best || distance < suggestion->distance))
        suggestion->best = candidate, suggestion->distance = distance;
}

/* ---- messages ---- */

const char *cpsi_key_list(const CpsiKey *key, int count, char *text, size_t size) {
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; i < count && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s%s", i ? ", " : "", key[i].name);
    return text;
}

/* What was found, for messages. */
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

CpsStatus cpsi_key_wrong(const char *file, const CpsiYaml *node, const char *what, const char *expected, CpsError *err) {
    char found[160];
    return cpsi_fail_at(err, CPS_ERR_INPUT, file, node->line, node->column, "%s: found %s, expected %s", what,
                        found_text(node, found, sizeof found), expected);
}

CpsStatus cpsi_key_unknown(const char *file, const CpsiYaml *node, const char *what, const CpsiKey *key, int count, CpsError *err) {
    CpsiSuggestion suggestion = {.word = node->key};
    char list[400];
    for (int i = 0; i < count; i++) cpsi_suggest(&suggestion, key[i].name);
    if (suggestion.best)
        return cpsi_fail_at(err, CPS_ERR_INPUT, file, node->line, node->column, "%s: unknown key '%.64s'; did you mean '%s'?",
                            what, node->key, suggestion.best);
    return cpsi_fail_at(err, CPS_ERR_INPUT, file, node->line, node->column, "%s: unknown key '%.64s', expected a mapping with %s",
                        what, node->key, cpsi_key_list(key, count, list, sizeof list));
}

CpsStatus cpsi_key_missing(const char *file, const CpsiYaml *node, const char *what, const CpsiKey *key, CpsError *err) {
    const bool unit = key->unit && key->unit[0];
    return cpsi_fail_at(err, CPS_ERR_INPUT, file, node->line, node->column, "%s: '%s' is missing: %s%s%s%s", what, key->name,
                        unit ? "[" : "", unit ? key->unit : "", unit ? "] " : "", key->help);
}
