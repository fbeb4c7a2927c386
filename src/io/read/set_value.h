/* SPDX-License-Identifier: BSD-3-Clause */
/* Values of a law file: texts, numbers, vectors and matrices, and the keys of mappings, each with a message of its own.
 */
#ifndef CAPSTAN_SRC_IO_READ_SET_VALUE_H
#define CAPSTAN_SRC_IO_READ_SET_VALUE_H

#include "io/schema/set_words.h"
#include "io/base/yaml.h"

/* A file being read; arrays taken from the tree live in the pool. */
typedef struct CpsiLawFile {
    const char *name; /* of the file, for messages */
    CpsiPool *pool;
    CpsError *err;
} CpsiLawFile;

/* "found a list of 2, expected ..." at a node; returns CPS_ERR_INPUT. `what` names the value: "'disc'". */
CpsStatus cpsi_law_wrong(const CpsiLawFile *f, const CpsiYaml *node, const char *what, const char *expected);

/* A value made of text or numbers (CPSI_TEXT .. CPSI_SIDES); numbers are at most 1e100. A size is checked
 * before room is taken for it. */
CpsStatus cpsi_law_value(const CpsiLawFile *f, const CpsiYaml *node, const CpsiKey *key, const char *what,
                         CpsiLawValue *value);

/* The node is a mapping that holds exactly these keys; child[i] is the value of key i, NULL where it is
 * optional and absent. */
CpsStatus cpsi_law_keys(const CpsiLawFile *f, const CpsiYaml *node, const char *what, const CpsiKey *key, int count,
                        const CpsiYaml **child);

CpsStatus cpsi_law_no_memory(const CpsiLawFile *f);

#endif
