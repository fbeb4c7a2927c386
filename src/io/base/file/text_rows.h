/* SPDX-License-Identifier: BSD-3-Clause */
/* The rows of a text file, without empty lines and comments. */
#ifndef CAPSTAN_SRC_IO_BASE_FILE_TEXT_ROWS_H
#define CAPSTAN_SRC_IO_BASE_FILE_TEXT_ROWS_H

#include <stddef.h>

#include "capstan/base.h"

typedef struct CpsiTextRows {
    char *bytes;  /* to be freed by the caller, also after a failure */
    char *next;   /* the line that follows; NULL at the end */
    size_t lines; /* number of lines in the file */
    int line;     /* number of the last row returned, from 1 */
} CpsiTextRows;

/* Read a file that another file names (cpsi_read_file_itself); a zero byte is refused. */
CpsStatus cpsi_text_rows_open(CpsiTextRows *rows, const char *path, size_t max_bytes,
                              CpsError *err);
/* The next line that is neither empty nor a comment (#), without its end; NULL after the last. */
char *cpsi_text_rows_next(CpsiTextRows *rows);

#endif
