/* SPDX-License-Identifier: BSD-3-Clause */
/* Reading by tables of keys: one reader for scenes, laws and driven systems. It checks a mapping
 * against the rows of its table (schema/keys.h) and puts the values where they say. */
#ifndef CAPSTAN_SRC_IO_READ_KEY_READER_H
#define CAPSTAN_SRC_IO_READ_KEY_READER_H

#include "io/read/document.h"
#include "io/schema/keys.h"

/* Every key has a row, those needed are there, every value is of its type and within its range.
 *
 *   what  names the mapping in messages: "scene", "'plane'"
 *   out   a zeroed struct of the mapping's kind; lists, rows and texts live in the document's pool
 *
 * Returns CPS_OK, CPS_ERR_INPUT, CPS_ERR_LIMIT or CPS_ERR_MEMORY. */
CpsStatus cpsi_read_mapping(const CpsiDocument *d, const CpsiYaml *node, const CpsiMapping *mapping,
                            const char *what, void *out);

/* The same for one value, which goes to the place in `out` that its row says. */
CpsStatus cpsi_read_value(const CpsiDocument *d, const CpsiYaml *node, const CpsiKey *key,
                          const char *what, void *out);

/* A number alone. */
CpsStatus cpsi_read_number(const CpsiDocument *d, const CpsiYaml *node, const char *what,
                           double *out);

/* Rows and vectors whose size only the builder knows: fails unless it is this. */
CpsStatus cpsi_expect_columns(const CpsiDocument *d, const CpsiRows *rows, const char *what,
                              int columns);
CpsStatus cpsi_expect_components(const CpsiDocument *d, const CpsiRows *vector, const char *what,
                                 int components);

#endif
