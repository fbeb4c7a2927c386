/* SPDX-License-Identifier: BSD-3-Clause */
/* The files of a study of the 1990 method: tables of its solves and of P10.1, and the pictures. As
 * in history.csv the first row contains the names, the second the units. */
#include <math.h>

#include "base/status.h"
#include "io/base/directory/file_set.h"
#include "io/base/text/columns.h"
#include "io/base/text/escape.h"
#include "io/draw/study/study_picture.h"

#define ROW(member) CPSI_MEMBER(CpsStudyRow, member)

static const CpsiColumn COLUMN[] = {
    {"lambda", "N/m2", ROW(parameters.penalty)},
    {"1/n", "N m2", ROW(parameters.stiffness)},
    {"delta", "m", ROW(parameters.delta)},
    {"wall", "s", ROW(wall)},
    {"gradient", "N", ROW(report.gradient)},
    {"total", "J", ROW(report.total)},
    {"elastic", "J", ROW(report.elastic)},
    {"potential", "J", ROW(report.potential)},
    {"friction_energy", "J", ROW(report.friction_energy)},
    {"bending", "J", ROW(report.bending)},
    {"contact", "J", ROW(report.contact)},
    {"relaxed", "J", ROW(report.relaxed)},
    {"energy_error", "J", ROW(report.energy_error)},
    {"energy_rate", "-", CPSI_MEMBER_IF(CpsStudyRow, has_rate_energy, rate_energy)},
    {"tension_rms_error", "N", ROW(report.tension_rms)},
    {"tension_max_error", "N", ROW(report.tension_max)},
    {"tension_rate", "-", CPSI_MEMBER_IF(CpsStudyRow, has_rate_tension, rate_tension)},
    {"position_max_error", "m", ROW(report.position_max)},
    {"compression", "N", ROW(report.compression)},
    {"shortening", "-", ROW(report.shortening)},
    {"penetration", "m", ROW(report.penetration)},
    {"creep", "m", ROW(report.creep)},
    {"friction_excess", "N", ROW(report.friction_excess)},
};
enum { COLUMNS = sizeof COLUMN / sizeof COLUMN[0] };

static void study_table(const void *what, FILE *out) {
    const CpsStudyFiles *files = what;
    const CpsRegularizedStep step = cps_regularized_step(files->regularized);
    fputs("stage,cells,h,converged,iterations,gradients", out);
    cpsi_csv_names(out, COLUMN, COLUMNS, NULL);
    fputs("\n,,m,,,", out);
    cpsi_csv_units(out, COLUMN, COLUMNS);
    fputc('\n', out);
    for (int r = 0; r < cps_study_row_count(files->study); ++r) {
        const CpsStudyRow row = cps_study_row(files->study, r);
        const int cells =
            row.parameters.cell_count > 0 ? row.parameters.cell_count : step.element_count;
        fprintf(out, "%s,%d", cps_study_stage_name(row.stage), cells);
        cpsi_csv_next(out, step.length / cells);
        fprintf(out, ",%d,%d,%d", row.report.converged, row.report.iteration_count,
                row.report.evaluation_count);
        cpsi_csv_values(out, COLUMN, COLUMNS, &row);
        fputc('\n', out);
    }
}

/* P10.1 beside P2.1: a row per node; the value of an element is in the row of the node at its
 * end */
static void first_order_table(const void *what, FILE *out) {
    const CpsStudyFiles *files = what;
    const CpsRegularizedStep step = cps_regularized_step(files->regularized);
    const CpsFirstOrderView view = cps_first_order_view(files->first_order);
    fputs(
        "arc_length,reference.x,reference.y,reference.z,P2.1.x,P2.1.y,P2.1.z,u.x,u.y,u.z,friction_"
        "force.x,friction_force.y,friction_force.z,reaction,strain,tension.x,tension.y,tension.z,"
        "P2.1.tension\n"
        "m,m,m,m,m,m,m,m,m,m,N,N,N,N,-,N,N,N,N\n",
        out);
    for (int j = 0; j <= step.element_count; ++j) {
        const size_t k = 3 * (size_t)j;
        const double *const vector[] = {step.reference + k, step.position + k,
                                        view.displacement + k, view.friction_force + k};
        cpsi_write_csv_number(out, view.arc_length[j]);
        for (size_t v = 0; v < sizeof vector / sizeof *vector; ++v)
            for (int x = 0; x < 3; ++x) cpsi_csv_next(out, vector[v][x]);
        cpsi_csv_next(out, view.reaction[j]);
        cpsi_csv_next(out, j > 0 ? view.strain[j - 1] : NAN);
        for (int x = 0; x < 3; ++x)
            cpsi_csv_next(out, j > 0 ? view.tension[k - 3 + (size_t)x] : NAN);
        cpsi_csv_next(out, j > 0 ? step.tension[j - 1] : NAN);
        fputc('\n', out);
    }
}

static void study_picture(const void *files, FILE *out) { cpsi_picture_study(files, out); }
static void first_order_picture(const void *files, FILE *out) {
    cpsi_picture_first_order(files, out);
}
static void relaxed_picture(const void *files, FILE *out) { cpsi_picture_relaxed(files, out); }

/* marks files that were initialised by their default function */
static const uint32_t FILES_COOKIE = 0x46494c45;

CpsStudyFiles cps_study_files_default(void) { return (CpsStudyFiles){.cookie = FILES_COOKIE}; }

CpsStatus cps_study_write(const char *directory, const CpsStudyFiles *files, CpsError *err) {
    if (files && files->cookie != FILES_COOKIE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the files were not made by cps_study_files_default()");
    if (!directory || !files || !files->title || !files->regularized || !files->study ||
        !files->first_order)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "directory, files, or one of what files has, is NULL");
    const CpsiFile set[] = {{"study.csv", study_table, files},
                            {"study.svg", study_picture, files},
                            {"first-order.csv", first_order_table, files},
                            {"first-order.svg", first_order_picture, files},
                            {"relaxed.svg", relaxed_picture, files}};
    const CpsiFile summary = {"study.json", cpsi_file_set_title, files->title};
    return cpsi_file_set_write(directory, set, sizeof set / sizeof *set, &summary, NULL, err);
}
