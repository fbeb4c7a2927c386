/* SPDX-License-Identifier: BSD-3-Clause */
/* Numbers of files have a decimal point whatever the program's locale. */
#ifndef CAPSTAN_SRC_IO_BASE_NUMBERS_H
#define CAPSTAN_SRC_IO_BASE_NUMBERS_H

#include <locale.h>
#include <stdbool.h>

/* The calling thread's locale while files are read or written. */
typedef struct CpsiNumbers {
    locale_t plain, before;
} CpsiNumbers;

/* False: no memory, and nothing has changed. */
bool cpsi_numbers_begin(CpsiNumbers *numbers);
void cpsi_numbers_end(CpsiNumbers *numbers);

#endif
