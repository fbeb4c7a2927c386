/* SPDX-License-Identifier: BSD-3-Clause */
/* Expressions of a law file made into sets, laws and resistance laws. The recursion is as deep as
 * the file, which the YAML reader limits. What the library refuses is reported at the word that
 * asked for it. */
#ifndef CAPSTAN_SRC_IO_READ_SET_BUILD_H
#define CAPSTAN_SRC_IO_READ_SET_BUILD_H

#include "capstan/law.h"
#include "io/read/document.h"

/* A file being built; and the weakest condition of the composition rule met so far. */
typedef struct CpsiSetBuild {
    const CpsiDocument *d;
    int solved_depth; /* words around, for whose sake a conic program is solved over this one too */
    int solved_size;  /* components, points and rows of all sets inside such words */
    bool has_preimage;
    CpsComposition composition;
    int composition_line;
} CpsiSetBuild;

/* {WORD: value} as a set; as a law, whose set must hold 0; and [{TERM: value}, ..] as a resistance
 * law. The reader has checked their form. The caller destroys what is made; nothing is made on
 * failure. */
CpsStatus cpsi_build_set(CpsiSetBuild *b, const CpsiYaml *node, CpsSet **out);
CpsStatus cpsi_build_law(CpsiSetBuild *b, const CpsiYaml *node, CpsLaw **out);
CpsStatus cpsi_build_resistance(CpsiSetBuild *b, const CpsiYaml *list, CpsResistance **out);

#endif
