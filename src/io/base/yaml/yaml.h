/* SPDX-License-Identifier: BSD-3-Clause */
/* A YAML file as a tree with the position of every value; only what scenes and laws need.
 *
 * One document of mappings, sequences and scalars. Refused, with line and column: anchors, aliases
 * and tags (so nothing can expand), a second document, duplicate keys and keys that are not
 * scalars, text that is not UTF-8 or contains control characters, and files that exceed the limits
 * of depth, length or number. Numbers follow the YAML 1.2 core schema. */
#ifndef CAPSTAN_SRC_IO_BASE_YAML_YAML_H
#define CAPSTAN_SRC_IO_BASE_YAML_YAML_H

#include <stdbool.h>
#include <stddef.h>

#include "capstan/base.h"
#include "io/base/yaml/pool.h"

typedef enum CpsiYamlKind { CPSI_YAML_SCALAR, CPSI_YAML_SEQUENCE, CPSI_YAML_MAPPING } CpsiYamlKind;

typedef struct CpsiYaml {
    CpsiYamlKind kind;
    bool plain;                    /* scalar: written without quotes */
    int line, column;              /* of the value, from 1; in a mapping: of its key */
    int count;                     /* number of children */
    const char *key;               /* in a mapping, else NULL */
    const char *text;              /* scalar, else NULL */
    struct CpsiYaml *child, *next; /* first child; next child of the same parent */
} CpsiYaml;

/* Parse `size` bytes, after which there is a zero byte. `file` and `what` ("scene", "law") occur
 * only in messages. The tree is allocated in the pool. Returns CPS_OK, CPS_ERR_INPUT, CPS_ERR_LIMIT
 * or CPS_ERR_MEMORY. */
CpsStatus cpsi_yaml_parse(const char *file, const char *what, const char *bytes, size_t size,
                          int max_depth, CpsiPool *pool, CpsiYaml **root, CpsError *err);

/* The value of a key of a mapping; NULL if there is none (or node is NULL or not a mapping). */
const CpsiYaml *cpsi_yaml_child(const CpsiYaml *node, const char *key);

/* The node at a path as in CpsError: "lines.cable.length", "history[2].cable.B". Where the file
 * does not contain it, the nearest node around it. */
const CpsiYaml *cpsi_yaml_at(const CpsiYaml *root, const char *place);

/* A number of the YAML 1.2 core schema: 12, 0x1f, 0o17, -1.5e3, .inf, .nan. Returns false where the
 * text is not a number. The calling thread's locale must have a decimal point. */
bool cpsi_yaml_number(const char *text, double *number);

/* Return an error with a message and a position in the file. */
__attribute__((format(printf, 6, 7))) CpsStatus cpsi_fail_at(CpsError *err, CpsStatus status,
                                                             const char *file, int line, int column,
                                                             const char *format, ...);

#endif
