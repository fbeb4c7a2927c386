/* SPDX-License-Identifier: BSD-3-Clause */
/* Tables of numbers whose columns are members of a struct. */
#ifndef CAPSTAN_SRC_IO_BASE_TEXT_COLUMNS_H
#define CAPSTAN_SRC_IO_BASE_TEXT_COLUMNS_H

#include <stddef.h>
#include <stdio.h>

/* Where a double lies in a struct, and the flag that says whether it has a value; 0: it always
 * has. */
typedef struct CpsiMember {
    size_t offset, flag;
} CpsiMember;

#define CPSI_MEMBER(type, member) \
    { offsetof(type, member), 0 }
#define CPSI_MEMBER_IF(type, flag, member) \
    { offsetof(type, member), offsetof(type, flag) }

/* Its value in `of`; NaN where it has none. */
double cpsi_member(const void *of, CpsiMember member);

typedef struct CpsiColumn {
    const char *name, *unit;
    CpsiMember member;
} CpsiColumn;

/* Of CSV, each cell behind a comma: the units of some columns, their values in `of`, a number. */
void cpsi_csv_units(FILE *out, const CpsiColumn *column, int count);
void cpsi_csv_values(FILE *out, const CpsiColumn *column, int count, const void *of);
void cpsi_csv_next(FILE *out, double x);
/* The names, each behind a comma too; as part of `line` ("line.name") unless that is NULL. */
void cpsi_csv_names(FILE *out, const CpsiColumn *column, int count, const char *line);

#endif
