/* SPDX-License-Identifier: BSD-3-Clause */
/* Expressions of a law file made into sets, laws and resistance laws. The depth of the recursion is
 * that of the file, which the YAML reader limits. Errors of the library are reported at the word
 * that caused them. */
#ifndef CAPSTAN_SRC_IO_READ_LAW_SET_BUILD_H
#define CAPSTAN_SRC_IO_READ_LAW_SET_BUILD_H

#include "capstan/law.h"
#include "io/read/document.h"

/* A file being built, and the weakest condition of the composition rule found so far. */
typedef struct CpsiSetBuild {
    const CpsiDocument *d;
    int solved_depth;      /* number of enclosing words for which a conic program is solved */
    int solved_size;       /* components, points and rows of all sets inside such words */
    int solved_components; /* most components of one of them */
    bool has_preimage;
    CpsComposition composition;
    int composition_line;
} CpsiSetBuild;

/* {WORD: value} as a set; as a law, whose set must contain 0; and [{TERM: value}, ..] as a
 * resistance law. The reader has checked their form. The caller releases the result; nothing is
 * made on failure. */
CpsStatus cpsi_build_set(CpsiSetBuild *b, const CpsiYaml *node, CpsSet **out);
CpsStatus cpsi_build_law(CpsiSetBuild *b, const CpsiYaml *node, CpsLaw **out);
CpsStatus cpsi_build_resistance(CpsiSetBuild *b, const CpsiYaml *list, CpsResistance **out);

#endif
