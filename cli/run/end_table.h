/* SPDX-License-Identifier: BSD-3-Clause */
/* The table of what a designer reads of each step beside tensions and lengths: at which angles the
 * lines leave their ends, what lifts there, where they touch down, and how far they have been swept
 * aside; of lines with a breaking load the share of it. */
#ifndef CAPSTAN_CLI_RUN_END_TABLE_H
#define CAPSTAN_CLI_RUN_END_TABLE_H

#include <stdio.h>

#include "capstan/evolve.h"

typedef struct EndTable {
    FILE *out;
    char *text;
    size_t size;
    bool says_something; /* a number in it is not zero */
} EndTable;

/* Begin an empty table. False: out of memory. */
bool end_table_begin(EndTable *table);

/* Add the step that has just been solved. */
void end_table_add(EndTable *table, const CpsEvolution *evolution);

/* Print what was added, if it says something. False: out of memory. */
bool end_table_print(EndTable *table, FILE *out);

void end_table_free(EndTable *table);

#endif
