/* SPDX-License-Identifier: BSD-3-Clause */
/* Several files of one result, written together into a directory, completely or not at all. */
#ifndef CAPSTAN_SRC_IO_BASE_DIRECTORY_FILE_SET_H
#define CAPSTAN_SRC_IO_BASE_DIRECTORY_FILE_SET_H

#include <stdbool.h>
#include <stdio.h>

#include "capstan/base.h"

typedef struct CpsiFile {
    const char *name;
    void (*put)(const void *what,
                FILE *out); /* numbers have a decimal point whatever the program's locale */
    const void *what;
} CpsiFile;

/* Write `count` files and then their summary. The summary is a JSON object written without its last
 * brace, to which the list of the others is added. Listed files for which `stale` is true and that
 * are not among them are removed; NULL: none. Returns CPS_OK, CPS_ERR_IO or CPS_ERR_MEMORY. */
CpsStatus cpsi_file_set_write(const char *directory, const CpsiFile *file, int count,
                              const CpsiFile *summary, bool (*stale)(const char *name),
                              CpsError *err);

/* Writes a summary that contains only its title. */
void cpsi_file_set_title(const void *title, FILE *out);

/* Write only the summary, without a list, into an open stream. */
CpsStatus cpsi_file_set_write_member(const CpsiFile *summary, FILE *out, CpsError *err);

#endif
