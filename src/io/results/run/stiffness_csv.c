/* SPDX-License-Identifier: BSD-3-Clause */
/* The stiffness of the ends as CSV (RFC 4180): a row of names, a row of units, then a row per step,
 * line, end and kind. Without a matrix its cells are empty, and the outcome says why. */
#include <math.h>

#include "io/base/text/columns.h"
#include "io/base/text/escape.h"
#include "io/results/writers.h"

static void write_matrix(FILE *out, const CpsStiffness *found) {
    const bool given = found->outcome == CPS_STIFFNESS_OUTCOME_FOUND;
    fprintf(out, ",%s", cps_stiffness_outcome_name(found->outcome));
    for (int i = 0; i < 9; ++i) cpsi_csv_next(out, given ? found->matrix[i] : NAN);
    for (int i = 0; i < 9; ++i) cpsi_csv_next(out, found->has_smooth ? found->smooth[i] : NAN);
    fputc('\n', out);
}

static void write_line(FILE *out, const CpsResults *results, int r, int l) {
    const CpsiRow *row = &results->row[r];
    for (int end = 0; end < 2; ++end)
        for (int kind = 0; kind < 2; ++kind) {
            fprintf(out, "%d,", row->report.step_count - 1);
            cpsi_write_csv(out, row->name);
            fputc(',', out);
            cpsi_write_csv(out, results->line_name[l]);
            fprintf(out, ",%c,%s", end == CPS_END_A ? 'A' : 'B',
                    cps_stiffness_name((CpsStiffnessKind)kind));
            write_matrix(out, &row->stiffness[l][end][kind]);
        }
}

void cpsi_stiffness_write(const CpsResults *results, FILE *out) {
    fputs("step,name,line,end,kind,outcome", out);
    for (int i = 0; i < 18; ++i)
        fprintf(out, ",%s%c%c", i < 9 ? "" : "smooth_", "xyz"[i % 9 / 3], "xyz"[i % 3]);
    fputs("\n1,,,,,", out);
    for (int i = 0; i < 18; ++i) fputs(",N/m", out);
    fputc('\n', out);
    for (int r = 0; r < results->row_count; ++r)
        for (int l = 0; l < results->line_count; ++l) write_line(out, results, r, l);
}
