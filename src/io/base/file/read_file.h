/* SPDX-License-Identifier: BSD-3-Clause */
/* Read a whole file without trusting its size. */
#ifndef CAPSTAN_SRC_IO_BASE_FILE_READ_FILE_H
#define CAPSTAN_SRC_IO_BASE_FILE_READ_FILE_H

#include <stdbool.h>
#include <stddef.h>

#include "capstan/base.h"
#include "io/base/yaml/pool.h"

/* All bytes of a regular file, or of standard input if `path` is "-", and a zero byte after them;
 * free *bytes.
 *
 *   file       its name in messages
 *   max_bytes  larger files are refused
 *
 * Returns CPS_OK, CPS_ERR_IO, CPS_ERR_LIMIT or CPS_ERR_MEMORY; on failure *bytes and *size are
 * unchanged. */
CpsStatus cpsi_read_file(const char *path, const char *file, size_t max_bytes, char **bytes,
                         size_t *size, CpsError *err);

/* The same for a file that another file names: never through a link, never standard input. */
CpsStatus cpsi_read_file_itself(const char *path, size_t max_bytes, char **bytes, size_t *size,
                                CpsError *err);

/* Whether a file may name this file. It may only name files in its own folder, since a file from
 * someone else must not cause other files to be read. */
bool cpsi_is_beside(const char *name);

/* The path of a file beside `file`, in the pool; NULL when memory does not suffice. */
char *cpsi_path_beside(CpsiPool *pool, const char *file, const char *name);

#endif
