/* SPDX-License-Identifier: BSD-3-Clause */
/* Expressions of a law file made into sets, laws and resistance laws. */
#ifndef CAPSTAN_SRC_IO_LAW_BUILD_H
#define CAPSTAN_SRC_IO_LAW_BUILD_H

#include "capstan/law.h"
#include "io/law_value.h"

/* A file being built; and the weakest condition of the composition rule met so far. */
typedef struct CpsiLawBuild {
    CpsiLawFile file;
    bool has_preimage;
    CpsComposition composition;
    int composition_line;
} CpsiLawBuild;

/* A set: {WORD: argument}, nested. */
CpsStatus cpsi_law_build_set(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out);
/* A friction law: any set with 0; products, preimages and contacts are composed as laws. */
CpsStatus cpsi_law_build_law(CpsiLawBuild *b, const CpsiYaml *node, CpsLaw **out);
/* A resistance law: a list of terms. */
CpsStatus cpsi_law_build_resistance(CpsiLawBuild *b, const CpsiYaml *node, CpsResistance **out);

/* Give a library call's error the place of the node in the file; returns its status (ARGUMENT becomes INPUT). */
CpsStatus cpsi_law_place(const CpsiLawBuild *b, const CpsiYaml *node, const CpsError *found);
/* The same for a call that writes its error to a local `found`. */
#define CPSI_PLACED(b, node, call) ((call) == CPS_OK ? CPS_OK : cpsi_law_place((b), (node), &found))

/* The words that are laws of their own (product, preimage, contacts, coulomb, unit_load): `node` is the word's value.
 * *law stays NULL for every other word. */
CpsStatus cpsi_law_build_word(CpsiLawBuild *b, const CpsiYaml *node, CpsLaw **law);

/* A map in `node` has `count` rows or columns (`which`), and must have as many as its set has components. */
CpsStatus cpsi_law_check_map(const CpsiLawBuild *b, const CpsiYaml *node, int count, int components, const char *which);

#endif
