/* SPDX-License-Identifier: BSD-3-Clause */
/* A file of any kind from its path to its tree. */
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
    CpsiPool *pool; /* of the tree */
    CpsError *err;
} CpsiDocument;

/* Read the file at `path`, expect one of this kind, and let `build` make `out` of it, all in a locale with a decimal point.
 *
 *   limits  NULL: the default ones
 *   pool    takes the tree; the caller frees it, also on failure
 *
 * Returns what build returns, or CPS_ERR_ARGUMENT, CPS_ERR_INPUT, CPS_ERR_IO, CPS_ERR_LIMIT or CPS_ERR_MEMORY. */
CpsStatus cpsi_document_read(const char *path, const CpsReadLimits *limits, CpsiFileKind kind, CpsiPool *pool,
                             CpsStatus (*build)(const CpsiDocument *document, void *out), void *out, CpsError *err);

#endif
