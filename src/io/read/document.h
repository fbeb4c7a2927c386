/* SPDX-License-Identifier: BSD-3-Clause */
/* A file of any kind from its path to its tree, and what is said of places in it. */
#ifndef CAPSTAN_SRC_IO_READ_DOCUMENT_H
#define CAPSTAN_SRC_IO_READ_DOCUMENT_H

#include "capstan/io.h"
#include "io/base/yaml.h"
#include "io/schema/file_kind.h"

/* A file that is being read. */
typedef struct CpsiDocument {
    const char *path, *name; /* name: for messages */
    const CpsReadLimits *limits;
    const CpsiYaml *root;
    CpsiPool *pool; /* of the tree, and of what is read from it */
    CpsError *err;
} CpsiDocument;

/* Read the file at `path`, expect one of this kind, and let `build` make `out` of it, all in a
 * locale with a decimal point.
 *
 *   limits  NULL: the default ones
 *   pool    takes the tree; the caller frees it, also on failure
 *
 * Returns what build returns, or CPS_ERR_ARGUMENT, CPS_ERR_INPUT, CPS_ERR_IO, CPS_ERR_LIMIT or
 * CPS_ERR_MEMORY. */
CpsStatus cpsi_document_read(const char *path, const CpsReadLimits *limits, CpsiFileKind kind,
                             CpsiPool *pool,
                             CpsStatus (*build)(const CpsiDocument *document, void *out), void *out,
                             CpsError *err);

/* Fail with a message at a node. Returns `status`. */
__attribute__((format(printf, 4, 5))) CpsStatus cpsi_document_fail(const CpsiDocument *d,
                                                                   CpsStatus status,
                                                                   const CpsiYaml *node,
                                                                   const char *format, ...);
/* "WHAT: found a list of 2, expected .."; returns CPS_ERR_INPUT. `what` names the value: "'disc'".
 */
CpsStatus cpsi_document_wrong(const CpsiDocument *d, const CpsiYaml *node, const char *what,
                              const char *expected);
/* Give a library call's error its place in the file: its own, or that of the node. Returns its
 * status (ARGUMENT becomes INPUT). */
CpsStatus cpsi_document_place(const CpsiDocument *d, const CpsiYaml *node, const CpsError *found);
CpsStatus cpsi_document_no_memory(const CpsiDocument *d);

#endif
