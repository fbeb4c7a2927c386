/* SPDX-License-Identifier: BSD-3-Clause */
/* Numbers in files have a decimal point whatever the program's locale. */
#ifndef CAPSTAN_SRC_IO_BASE_TEXT_NUMBERS_H
#define CAPSTAN_SRC_IO_BASE_TEXT_NUMBERS_H

#include <locale.h>
#include <stdbool.h>

/* The calling thread's locale while files are read or written. */
typedef struct CpsiNumbers {
    locale_t plain, before;
} CpsiNumbers;

/* Returns false when memory does not suffice; nothing has changed then. */
bool cpsi_numbers_begin(CpsiNumbers *numbers);
void cpsi_numbers_end(CpsiNumbers *numbers);

#endif
