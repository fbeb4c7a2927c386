/* SPDX-License-Identifier: BSD-3-Clause */
/* The words of sets and laws, in every kind of file. Each is a row from whose value, numbers or
 * parts, a set, a law or a term of a resistance law is made. CONTRIBUTING lists what a new word
 * needs ("Add a friction set"). */
#ifndef CAPSTAN_SRC_IO_SCHEMA_TABLES_SET_KEYS_H
#define CAPSTAN_SRC_IO_SCHEMA_TABLES_SET_KEYS_H

#include "capstan/law.h"
#include "io/schema/keys.h"

/* The values of a word. Values that the word does not have are zero. A word whose value has another
 * meaning gets a field of its own. */
typedef struct CpsiSetValues {
    CpsiNumberRows rows;    /* points, matrices, directions, sides, tables */
    CpsiNumberRows offsets; /* of inequalities */
    double number;          /* radius, width, offset, friction, factor */
    double load, degree;
    int dimension;
    const CpsiYaml *sets, *laws; /* its parts: an expression, or a list of expressions */
    CpsiList contacts;           /* CpsiContactValues */

    /* of each expression, made while reading; released after the word has been made */
    int count;
    CpsSet **set;
    CpsLaw **law;
    const double **map; /* of contacts, each (space of its law x columns) */
    int columns;
} CpsiSetValues;

/* The result of a word: one of the three; for the preimage of a law also its composition rule. */
typedef struct CpsiSetMade {
    CpsSet *set;
    CpsLaw *law;
    CpsResistance *term;
    bool composed;
    CpsComposition composition;
} CpsiSetMade;

/* One contact of `contacts`. */
typedef struct CpsiContactValues {
    const CpsiYaml *node;
    CpsiNumberRows map;
    const CpsiYaml *of;
} CpsiContactValues;

/* A law file. */
typedef struct CpsiLawFileValues {
    const CpsiYaml *node;
    int version;
    const char *title;
    CpsiNumberRows load;
    const CpsiYaml *law, *resistance;
} CpsiLawFileValues;

/* Words that make sets, or laws, which stand for their sets of forces where a set is expected;
 * words that make something else under the same name where a law is expected; terms of resistance
 * laws. */
extern const CpsiMapping cpsi_set_words, cpsi_law_words, cpsi_term_words;
extern const CpsiMapping cpsi_contact, cpsi_law_file;

/* Limits of a set: its components, and the components, points and rows together of all sets over
 * which a conic program is solved. A program over k of them takes k^3 operations, and as many
 * programs are solved as there are components: so that a file below 1 MB is read in 2 s,
 * k^3 x components is at most CPSI_LAW_MOST_WORK. */
enum { CPSI_LAW_MOST_COMPONENTS = 32, CPSI_LAW_MOST_WORK = 20000000, CPSI_LAW_LONGEST_TITLE = 255 };

/* Fails, at the value, unless `found` equals `expected`: "'map': found 3 columns, expected 2, as
 * many as .." */
CpsStatus cpsi_set_match(const CpsiNumberRows *value, const char *name, int found, const char *what,
                         int expected, const char *reason, CpsError *err);

#endif
