/* SPDX-License-Identifier: BSD-3-Clause */
/* Read a whole file whose size is not to be trusted. */
#ifndef CAPSTAN_SRC_IO_BASE_READ_FILE_H
#define CAPSTAN_SRC_IO_BASE_READ_FILE_H

#include <stdbool.h>
#include <stddef.h>

#include "capstan/base.h"
#include "io/base/pool.h"

/* All bytes of a regular file, or of standard input if `path` is "-", with a NUL behind them; free
 * *bytes.
 *
 *   file       what the messages call it
 *   max_bytes  more are refused
 *
 * Returns CPS_OK, CPS_ERR_IO, CPS_ERR_LIMIT or CPS_ERR_MEMORY; on failure *bytes and *size are
 * untouched. */
CpsStatus cpsi_read_file(const char *path, const char *file, size_t max_bytes, char **bytes,
                         size_t *size, CpsError *err);

/* The same of a file that another file names: never through a link, never standard input. */
CpsStatus cpsi_read_file_itself(const char *path, size_t max_bytes, char **bytes, size_t *size,
                                CpsError *err);

/* May a file name another one so?  Only one that lies beside it: a file from somebody else must not
 * read what lies elsewhere. */
bool cpsi_is_beside(const char *name);

/* The path of what lies beside `file`, in the pool; NULL without memory. */
char *cpsi_path_beside(CpsiPool *pool, const char *file, const char *name);

#endif
