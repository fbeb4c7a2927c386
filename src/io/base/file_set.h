/* SPDX-License-Identifier: BSD-3-Clause */
/* Several files about one thing, written into a directory whole and together, or not at all. */
#ifndef CAPSTAN_SRC_IO_BASE_FILE_SET_H
#define CAPSTAN_SRC_IO_BASE_FILE_SET_H

#include <stdio.h>

#include "capstan/base.h"

typedef struct CpsiFile {
    const char *name;
    void (*put)(const void *what,
                FILE *out); /* numbers have a decimal point whatever the program's locale */
    const void *what;
} CpsiFile;

/* Write `count` files and then their summary: an object of JSON that is put without its last brace,
 * and gets the list of the others. Returns CPS_OK, CPS_ERR_IO or CPS_ERR_MEMORY. */
CpsStatus cpsi_file_set_write(const char *directory, const CpsiFile *file, int count,
                              const CpsiFile *summary, CpsError *err);

/* What to put of a summary that says no more than its title. */
void cpsi_file_set_title(const void *title, FILE *out);

/* The summary by itself, without a list, into a stream that is open. */
CpsStatus cpsi_file_set_write_member(const CpsiFile *summary, FILE *out, CpsError *err);

#endif
