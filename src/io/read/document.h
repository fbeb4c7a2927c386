/* SPDX-License-Identifier: BSD-3-Clause */
/* A file of any kind from its path to its tree, and messages about positions in it. */
#ifndef CAPSTAN_SRC_IO_READ_DOCUMENT_H
#define CAPSTAN_SRC_IO_READ_DOCUMENT_H

#include "capstan/io.h"
#include "io/base/file/csv_table.h"
#include "io/base/yaml/yaml.h"
#include "io/schema/file_kind.h"

/* A file that is being read. */
typedef struct CpsiDocument {
    const char *path, *name; /* name: the name in messages */
    const char *text;        /* the contents; NULL: to be read from `path` */
    const CpsReadLimits *limits;
    const CpsiYaml *root;
    CpsiPool *pool; /* memory of the tree and of everything read from it */
    CpsError *err;
} CpsiDocument;

/* Read the file at `path`, check its kind, and let `build` make `out` from it, all in a locale with
 * a decimal point.
 *
 *   text    what the file is taken to contain, with a zero byte at its end; then `path` is its name
 *           in messages, and that beside which other files lie. NULL: the file is read
 *   limits  NULL: the default ones
 *   pool    memory of the tree; the caller frees it, also on failure
 *
 * Returns the status of build, or CPS_ERR_ARGUMENT, CPS_ERR_INPUT, CPS_ERR_IO, CPS_ERR_LIMIT or
 * CPS_ERR_MEMORY. */
CpsStatus cpsi_document_read(const char *path, const char *text, const CpsReadLimits *limits,
                             CpsiFileKind kind, CpsiPool *pool,
                             CpsStatus (*build)(const CpsiDocument *document, void *out), void *out,
                             CpsError *err);

/* Return `status` with a message at a node. */
__attribute__((format(printf, 4, 5))) CpsStatus cpsi_document_fail(const CpsiDocument *d,
                                                                   CpsStatus status,
                                                                   const CpsiYaml *node,
                                                                   const char *format, ...);
/* "WHAT: found a list of 2, expected .."; returns CPS_ERR_INPUT. `what` names the value: "'disc'".
 */
CpsStatus cpsi_document_wrong(const CpsiDocument *d, const CpsiYaml *node, const char *what,
                              const char *expected);
/* Give the error of a library call its position in the file: that of its own path, or that of the
 * node. Returns its status (ARGUMENT becomes INPUT). */
CpsStatus cpsi_document_place(const CpsiDocument *d, const CpsiYaml *node, const CpsError *found);
/* Read a table of columns from the CSV file `name` that the text of a node names, which lies beside
 * the document; its path, for messages, is `*path`. */
CpsStatus cpsi_document_table(const CpsiDocument *d, const CpsiYaml *node, const char *name,
                              const CpsiCsvColumn *column, int count, CpsiPool *pool,
                              CpsiCsvTable *out, const char **path);
CpsStatus cpsi_document_no_memory(const CpsiDocument *d);

#endif
