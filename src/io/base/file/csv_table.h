/* SPDX-License-Identifier: BSD-3-Clause */
/* A CSV file of named columns of numbers: a line of names, optionally one of units, then the rows;
 * empty lines and those that begin with # are skipped. */
#ifndef CAPSTAN_SRC_IO_BASE_FILE_CSV_TABLE_H
#define CAPSTAN_SRC_IO_BASE_FILE_CSV_TABLE_H

#include <stdbool.h>
#include <stddef.h>

#include "capstan/base.h"
#include "io/base/yaml/pool.h"

/* Whether a file has a column. */
typedef enum CpsiCsvNeed {
    CPSI_CSV_OPTIONAL,
    CPSI_CSV_REQUIRED,
    CPSI_CSV_NOT_FIRST /* optional, and its cell of the first row is empty */
} CpsiCsvNeed;

typedef struct CpsiCsvColumn {
    const char *name, *unit;
    CpsiCsvNeed need;
} CpsiCsvColumn;

enum { CPSI_CSV_COLUMNS = 40 }; /* at most */

typedef struct CpsiCsvTable {
    int names, rows;            /* number of the line of names, from 1; rows */
    double *value;              /* (rows, columns asked for), 0 of a column that the file has not */
    int *line;                  /* (rows) its number in the file, from 1 */
    bool has[CPSI_CSV_COLUMNS]; /* the columns that the file has */
} CpsiCsvTable;

/* Read the file at `path`, which has some of `count` columns in any order, into memory of `pool`.
 * The calling thread's locale must have a decimal point. A file of more than `max_bytes` is
 * refused, and numbers that are not finite are. Returns CPS_OK, CPS_ERR_INPUT with line and column,
 * CPS_ERR_IO, CPS_ERR_LIMIT or CPS_ERR_MEMORY. */
CpsStatus cpsi_csv_read(const char *path, size_t max_bytes, const CpsiCsvColumn *column, int count,
                        CpsiPool *pool, CpsiCsvTable *out, CpsError *err);

#endif
