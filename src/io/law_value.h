/* SPDX-License-Identifier: BSD-3-Clause */
/* Values of a law file: numbers, vectors and matrices of any size, words and keys, each with a message of its own. */
#ifndef CAPSTAN_SRC_IO_LAW_VALUE_H
#define CAPSTAN_SRC_IO_LAW_VALUE_H

#include "io/scene_yaml.h"

/* A file being read; arrays taken from the tree live in the pool. */
typedef struct CpsiLawFile {
    const char *name; /* of the file, for messages */
    CpsiPool *pool;
    CpsError *err;
} CpsiLawFile;

/* "found a list of 2, expected ..." at a node; returns CPS_ERR_INPUT. `what` names the value: "'disc'". */
CpsStatus cpsi_law_wrong(const CpsiLawFile *f, const CpsiYaml *node, const char *what, const char *expected);

/* A finite number of at most 1e100; with `least` a smallest value, itself excluded if `open`. */
CpsStatus cpsi_law_number(const CpsiLawFile *f, const CpsiYaml *node, const char *what, double least, bool open,
                          double *out);
/* A whole number from 1 to `most`. */
CpsStatus cpsi_law_count(const CpsiLawFile *f, const CpsiYaml *node, const char *what, int most, int *out);

/* [x, ...]: at least one number; *out (*count) in the pool. */
CpsStatus cpsi_law_vector(const CpsiLawFile *f, const CpsiYaml *node, const char *what, int *count, double **out);

/* [[x, ...], ...]: rows of equal length; *out (rows * columns), row by row, in the pool. */
CpsStatus cpsi_law_matrix(const CpsiLawFile *f, const CpsiYaml *node, const char *what, int *rows, int *columns,
                          double **out);

/* The node is a mapping that holds exactly the given keys (NULL behind the last; one that begins with '?'
 * may be absent); child[i] is the value of key i. */
CpsStatus cpsi_law_keys(const CpsiLawFile *f, const CpsiYaml *node, const char *what, const char *const *key,
                        const CpsiYaml **child);

CpsStatus cpsi_law_no_memory(const CpsiLawFile *f);

#endif
