/* SPDX-License-Identifier: BSD-3-Clause */
/* The name and the sentence of each value of an enumeration, from the list in its public header. */
#ifndef CAPSTAN_SRC_BASE_WORDS_H
#define CAPSTAN_SRC_BASE_WORDS_H

#include <stddef.h>

typedef struct CpsiWords {
    int value;
    const char *name, *text;
} CpsiWords;

/* The entries of a table of words: of values with a key, and of values whose name is their
 * identifier. */
#define CPSI_WORDS_WITH_KEY(name, number, key, sentence) {number, key, sentence},
#define CPSI_WORDS_WITH_NAME(name, number, sentence)     {number, #name, sentence},

static inline CpsiWords cpsi_words_find(const CpsiWords *words, size_t count, int value) {
    for (size_t i = 0; i < count; i++)
        if (words[i].value == value) return words[i];
    return (CpsiWords){value, "unknown", "an unknown value"};
}

#define CPSI_WORDS(table, value) cpsi_words_find(table, sizeof table / sizeof *table, (int)(value))

#endif
