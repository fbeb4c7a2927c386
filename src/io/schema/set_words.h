/* SPDX-License-Identifier: BSD-3-Clause */
/* The words of a law file. One table drives the reading (set_build.c), its messages and suggestions, and the JSON
 * schema (set_json.c). To add a word: its row and a few lines that make it here, its line in docs/formats.md. */
#ifndef CAPSTAN_SRC_IO_SCHEMA_SET_WORDS_H
#define CAPSTAN_SRC_IO_SCHEMA_SET_WORDS_H

#include "capstan/law.h"
#include "io/schema/keys.h"

/* A value read. Arrays are the pool's; sets, laws and terms are held until the word is made. */
typedef struct CpsiLawValue {
    const CpsiYaml *node; /* NULL: optional and not given */
    const char *text;
    int rows, columns;
    double *x; /* (rows x columns) */
    int count;
    CpsSet **set;         /* (count), or NULL */
    CpsLaw **law;         /* (count), or NULL */
    const double **map;   /* (count) of contacts, each (space of its law x columns) */
    CpsResistance **term; /* (count), or NULL */
} CpsiLawValue;

/* What a word becomes: one of the three; of a preimage of a law also its composition rule. */
typedef struct CpsiLawMade {
    CpsSet *set;
    CpsLaw *law;
    CpsResistance *term;
    bool composed;
    CpsComposition composition;
} CpsiLawMade;

enum { CPSI_LAW_MOST_KEYS = 5 };

typedef struct CpsiLawWord {
    const char *name;
    CpsiKey key[CPSI_LAW_MOST_KEYS]; /* up to the first one of type CPSI_NOTHING; their values are CpsiLawValue, in this order */
    /* Make it of its values. An error that has a line belongs there, any other to the word. */
    CpsStatus (*make)(const CpsiLawValue *value, CpsiLawMade *made, CpsError *err);
    bool solved; /* questions about it solve a conic program over all its parts */
    const char *help;
} CpsiLawWord;

typedef enum CpsiLawGroup {
    CPSI_LAW_SET_WORDS,
    CPSI_LAW_LAW_WORDS, /* composed as laws: under `law`, of parts that contain 0 */
    CPSI_LAW_TERM_WORDS /* of resistance laws */
} CpsiLawGroup;

/* The words of a group: *count of them. */
const CpsiLawWord *cpsi_law_words(CpsiLawGroup group, int *count);
/* The word of this name in a group; NULL: none. */
const CpsiLawWord *cpsi_law_word(CpsiLawGroup group, const char *name);

/* How many keys it has; 1 where its value stands behind the word itself. */
int cpsi_law_key_count(const CpsiLawWord *word);

/* The file itself, and one contact, as words that are not made. */
enum { CPSI_LAW_VERSION, CPSI_LAW_TITLE, CPSI_LAW_OF_FRICTION, CPSI_LAW_LOAD, CPSI_LAW_OF_RESISTANCE };
enum { CPSI_LAW_CONTACT_MAP, CPSI_LAW_CONTACT_OF };
extern const CpsiLawWord cpsi_law_file_word, cpsi_law_contact_word;

/* Limits of what is read, chosen so that no file keeps the program busy for more than about a minute: components of one
 * set, and components, points and rows together of all sets that a conic program is solved over. */
enum { CPSI_LAW_MOST_COMPONENTS = 32, CPSI_LAW_MOST_SOLVED = 300, CPSI_LAW_LONGEST_TITLE = 255 };

/* Fails, at the value, unless `found` is `expected`: "'map': found 3 columns, expected 2, as many as ..". */
CpsStatus cpsi_law_match(const CpsiLawValue *value, const char *name, int found, const char *what, int expected,
                         const char *reason, CpsError *err);

#endif
