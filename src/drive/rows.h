/* SPDX-License-Identifier: BSD-3-Clause */
/* Sparse rows that grow: the maps of laws, constraints and drive over the velocity parameters. */
#ifndef CAPSTAN_SRC_DRIVE_ROWS_H
#define CAPSTAN_SRC_DRIVE_ROWS_H

#include "capstan/drive.h"

/* Row i: entries start[i] .. start[i + 1], each column once, in increasing order. A zeroed struct
 * has no rows. */
typedef struct CpsiRows {
    int rows;
    size_t row_capacity, capacity;
    size_t *start; /* (rows + 1), NULL while there are no rows */
    int *column;
    double *value;
} CpsiRows;

/* Append `rows` rows from entries whose rows count from 0 and whose columns are below n; entries
 * with the same place are added. On failure nothing has changed. `what` is their name in
 * messages. */
CpsStatus cpsi_rows_append(CpsiRows *rows, const char *what, int n, int more, int count,
                           const CpsEntry *entry, CpsError *err);
void cpsi_rows_free(CpsiRows *rows);

/* <row i, x> */
double cpsi_rows_times(const CpsiRows *rows, int i, const double *x);
/* out += factor row i */
void cpsi_rows_add(const CpsiRows *rows, int i, double factor, double *out);

#endif
