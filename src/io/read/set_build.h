/* SPDX-License-Identifier: BSD-3-Clause */
/* Expressions of a law file made into sets, laws and resistance laws. The recursion is as deep as the file, which the
 * YAML reader limits. What the library refuses is reported at the word that asked for it. */
#ifndef CAPSTAN_SRC_IO_READ_SET_BUILD_H
#define CAPSTAN_SRC_IO_READ_SET_BUILD_H

#include "io/read/set_value.h"

/* A file being built; and the weakest condition of the composition rule met so far. */
typedef struct CpsiLawBuild {
    CpsiLawFile file;
    int solved_depth; /* words around, for whose sake a conic program is solved over this one too */
    int solved_size;  /* components, points and rows of all sets inside such words */
    bool has_preimage;
    CpsComposition composition;
    int composition_line;
} CpsiLawBuild;

/* The values of a word's keys, or the one behind the word. On success and failure alike what they hold is let go with
 * cpsi_law_release. */
CpsStatus cpsi_law_read_values(CpsiLawBuild *b, const CpsiYaml *node, const CpsiLawWord *word, const char *what,
                               CpsiLawValue value[CPSI_LAW_MOST_KEYS]);
void cpsi_law_release(CpsiLawValue value[CPSI_LAW_MOST_KEYS]);

/* Give a library call's error its place in the file: its own, or that of the node. Returns its status (ARGUMENT becomes
 * INPUT). */
CpsStatus cpsi_law_place(const CpsiLawFile *f, const CpsiYaml *node, const CpsError *found);

#endif
