/* SPDX-License-Identifier: BSD-3-Clause */
/* Tables of numbers whose columns are members of a struct (columns.h). */
#include "io/base/text/columns.h"

#include <math.h>
#include <stdbool.h>

#include "io/base/text/escape.h"

double cpsi_member(const void *of, CpsiMember member) {
    const char *at = of;
    if (member.flag && !*(const bool *)(at + member.flag)) return NAN;
    return *(const double *)(const void *)(at + member.offset);
}

void cpsi_csv_names(FILE *out, const CpsiColumn *column, int count, const char *line) {
    for (int i = 0; i < count; ++i) {
        char name[256];
        snprintf(name, sizeof name, "%.200s.%s", line ? line : "", column[i].name);
        fputc(',', out);
        if (line)
            cpsi_write_csv(out, name);
        else
            fputs(column[i].name, out);
    }
}

void cpsi_csv_units(FILE *out, const CpsiColumn *column, int count) {
    for (int i = 0; i < count; ++i) fprintf(out, ",%s", column[i].unit);
}

void cpsi_csv_next(FILE *out, double x) {
    fputc(',', out);
    cpsi_write_csv_number(out, x);
}

void cpsi_csv_values(FILE *out, const CpsiColumn *column, int count, const void *of) {
    for (int i = 0; i < count; ++i) cpsi_csv_next(out, cpsi_member(of, column[i].member));
}
