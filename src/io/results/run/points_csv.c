/* SPDX-License-Identifier: BSD-3-Clause */
/* The points where lines meet as CSV (RFC 4180): a row of names, a row of units, then a row per
 * step and point. The obstacle is empty where the point touches none. */
#include "io/base/text/columns.h"
#include "io/base/text/escape.h"
#include "io/results/writers.h"

#define POINT(member) CPSI_MEMBER(CpsPointReport, member)
#define VECTOR(name, unit, member)                                              \
    {name "_x", unit, POINT(member[0])}, {name "_y", unit, POINT(member[1])}, { \
        name "_z", unit, POINT(member[2])                                       \
    }

static const CpsiColumn COLUMN[] = {
    {"x", "m", POINT(position[0])},     {"y", "m", POINT(position[1])},
    {"z", "m", POINT(position[2])},     VECTOR("lines", "N", lines),
    VECTOR("load", "N", load),          VECTOR("support", "N", support),
    {"reaction", "N", POINT(reaction)}, VECTOR("normal", "1", normal),
    VECTOR("friction", "N", friction),  VECTOR("slip", "m", slip),
    VECTOR("residual", "N", residual),  {"dissipated", "J", POINT(dissipated)},
};

enum { COLUMNS = sizeof COLUMN / sizeof *COLUMN };

static void write_row(FILE *out, const CpsResults *results, const CpsiRow *row, int point) {
    const CpsPointReport *report = &row->point[point];
    fprintf(out, "%d,", row->report.step_count - 1);
    cpsi_write_csv(out, row->name);
    fputc(',', out);
    cpsi_write_csv(out, results->point[point].name);
    fprintf(out, ",%s", cpsi_point_state(report->state));
    cpsi_csv_values(out, COLUMN, COLUMNS, report);
    fputc(',', out);
    if (report->obstacle != CPS_NO_OBSTACLE)
        cpsi_write_csv(out, results->obstacle[report->obstacle].name);
    fprintf(out, ",%d,%d\n", report->trial_count, (int)report->has_place);
}

void cpsi_points_write(const CpsResults *results, FILE *out) {
    fputs("step,name,point,state", out);
    cpsi_csv_names(out, COLUMN, COLUMNS, NULL);
    fputs(",obstacle,trials,has_place\n1,,,", out);
    cpsi_csv_units(out, COLUMN, COLUMNS);
    fputs(",,1,1\n", out);
    for (int r = 0; r < results->row_count; ++r)
        for (int i = 0; i < results->point_count; ++i) write_row(out, results, &results->row[r], i);
}
