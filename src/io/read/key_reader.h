/* SPDX-License-Identifier: BSD-3-Clause */
/* Reading by tables of keys: one reader for scenes, laws and driven systems. It checks a mapping
 * against the rows of its table (schema/keys.h) and stores the values at the offsets of the
 * rows. */
#ifndef CAPSTAN_SRC_IO_READ_KEY_READER_H
#define CAPSTAN_SRC_IO_READ_KEY_READER_H

#include "io/read/document.h"
#include "io/schema/keys.h"

/* Check that every key has a row, that all required keys are given, and that every value has its
 * type and range, and store the values.
 *
 *   what  name of the mapping in messages: "scene", "'plane'"
 *   out   a zeroed struct of the mapping's kind; lists, rows and texts are in the document's pool
 *
 * Returns CPS_OK, CPS_ERR_INPUT, CPS_ERR_LIMIT or CPS_ERR_MEMORY. */
CpsStatus cpsi_read_mapping(const CpsiDocument *d, const CpsiYaml *node, const CpsiMapping *mapping,
                            const char *what, void *out);

/* The same for one value, which is stored in `out` at the offset of its row. */
CpsStatus cpsi_read_value(const CpsiDocument *d, const CpsiYaml *node, const CpsiKey *key,
                          const char *what, void *out);

/* A single number. */
CpsStatus cpsi_read_number(const CpsiDocument *d, const CpsiYaml *node, const char *what,
                           double *out);

/* For rows and vectors whose size is known only to the builder: fails unless they have this
 * size. */
CpsStatus cpsi_expect_columns(const CpsiDocument *d, const CpsiNumberRows *rows, const char *what,
                              int columns);
CpsStatus cpsi_expect_components(const CpsiDocument *d, const CpsiNumberRows *vector,
                                 const char *what, int components);

#endif
