/* SPDX-License-Identifier: BSD-3-Clause */
/* The stiffness of the ends, of points and of bodies as CSV (RFC 4180): a row of names, a row of
 * units, then a row per step, line, end and kind, or step, point or body, and kind. Without a
 * matrix its cells are empty, and the outcome says why. */
#include <math.h>

#include "io/base/text/columns.h"
#include "io/base/text/escape.h"
#include "io/results/writers.h"

/* The matrix of the discrete lines and the smooth one, of so many numbers each. */
static void write_matrices(FILE *out, CpsStiffnessOutcome outcome, int count, const double *matrix,
                           const double *smooth) {
    fprintf(out, ",%s", cps_stiffness_outcome_name(outcome));
    for (int i = 0; i < count; ++i)
        cpsi_csv_next(out, outcome == CPS_STIFFNESS_OUTCOME_FOUND ? matrix[i] : NAN);
    for (int i = 0; i < count; ++i) cpsi_csv_next(out, smooth ? smooth[i] : NAN);
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
            const CpsStiffness *found = &row->stiffness[l][end][kind];
            write_matrices(out, found->outcome, 9, found->matrix,
                           found->has_smooth ? found->smooth : NULL);
        }
}

/* Names and units of two matrices (3, 3), behind the names of other columns and their units. */
static void write_heads(FILE *out, const char *names, const char *units) {
    fputs(names, out);
    for (int i = 0; i < 18; ++i)
        fprintf(out, ",%s%c%c", i < 9 ? "" : "smooth_", "xyz"[i % 9 / 3], "xyz"[i % 3]);
    fprintf(out, "\n%s", units);
    for (int i = 0; i < 18; ++i) fputs(",N/m", out);
    fputc('\n', out);
}

void cpsi_stiffness_write(const CpsResults *results, FILE *out) {
    write_heads(out, "step,name,line,end,kind,outcome", "1,,,,,");
    for (int r = 0; r < results->row_count; ++r)
        for (int l = 0; l < results->line_count; ++l) write_line(out, results, r, l);
}

/* The first cells of a row of a point or body. */
static void write_owner(FILE *out, const CpsiRow *row, const char *name, int kind) {
    fprintf(out, "%d,", row->report.step_count - 1);
    cpsi_write_csv(out, row->name);
    fputc(',', out);
    cpsi_write_csv(out, name);
    fprintf(out, ",%s", cps_stiffness_name((CpsStiffnessKind)kind));
}

void cpsi_point_stiffness_write(const CpsResults *results, FILE *out) {
    write_heads(out, "step,name,point,kind,outcome", "1,,,,");
    for (int r = 0; r < results->row_count; ++r)
        for (int i = 0; i < results->point_count; ++i)
            for (int kind = 0; kind < 2; ++kind) {
                const CpsStiffness *found = &results->row[r].point_stiffness[i][kind];
                write_owner(out, &results->row[r], results->point[i].name, kind);
                write_matrices(out, found->outcome, 9, found->matrix,
                               found->has_smooth ? found->smooth : NULL);
            }
}

static void write_body(FILE *out, const CpsResults *results, const CpsiRow *row, int body) {
    for (int kind = 0; kind < 2; ++kind) {
        const CpsBodyStiffness *found = &row->body[body].stiffness[kind];
        write_owner(out, row, results->body[body].name, kind);
        write_matrices(out, found->outcome, CPS_BODY_DIRECTIONS * CPS_BODY_DIRECTIONS,
                       found->matrix, found->has_smooth ? found->smooth : NULL);
    }
}

/* Columns "x_rz": the force along x by the rotation about z. */
void cpsi_body_stiffness_write(const CpsResults *results, FILE *out) {
    static const char *const DIRECTION[] = {"x", "y", "z", "rx", "ry", "rz"};
    fputs("step,name,body,kind,outcome", out);
    for (int m = 0; m < 2; ++m)
        for (int i = 0; i < CPS_BODY_DIRECTIONS; ++i)
            for (int k = 0; k < CPS_BODY_DIRECTIONS; ++k)
                fprintf(out, ",%s%s_%s", m ? "smooth_" : "", DIRECTION[i], DIRECTION[k]);
    fputs("\n1,,,,", out);
    for (int m = 0; m < 2; ++m)
        for (int i = 0; i < CPS_BODY_DIRECTIONS; ++i)
            for (int k = 0; k < CPS_BODY_DIRECTIONS; ++k)
                fputs(i < 3 && k < 3 ? ",N/m" : i < 3 || k < 3 ? ",N" : ",N m", out);
    fputc('\n', out);
    for (int r = 0; r < results->row_count; ++r)
        for (int i = 0; i < results->body_count; ++i) write_body(out, results, &results->row[r], i);
}
