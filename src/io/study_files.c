/* SPDX-License-Identifier: BSD-3-Clause */
/* A study of the 1990 method as files: tables of its solves and of P10.1, and the pictures. As in history.csv the first
 * row has the names, the second the units. */
#include <locale.h>
#include <math.h>
#include <stddef.h>

#include "base/status.h"
#include "io/picture_study.h"
#include "io/result_file.h"
#include "io/result_text.h"

typedef struct Column {
    const char *name, *unit;
    size_t offset; /* of a double in CpsStudyRow */
} Column;

#define ROW(member) offsetof(CpsStudyRow, member)

static const Column COLUMN[] = {
    {"lambda", "N/m2", ROW(parameters.penalty)},
    {"1/n", "N m2", ROW(parameters.stiffness)},
    {"delta", "m", ROW(parameters.delta)},
    {"wall", "s", ROW(wall)},
    {"gradient", "N", ROW(report.gradient)},
    {"total", "J", ROW(report.total)},
    {"elastic", "J", ROW(report.elastic)},
    {"potential", "J", ROW(report.potential)},
    {"friction", "J", ROW(report.friction)},
    {"bending", "J", ROW(report.bending)},
    {"contact", "J", ROW(report.contact)},
    {"relaxed", "J", ROW(report.relaxed)},
    {"energy_error", "J", ROW(report.energy_error)},
    {"energy_rate", "-", ROW(rate_energy)},
    {"tension_rms_error", "N", ROW(report.tension_rms)},
    {"tension_max_error", "N", ROW(report.tension_max)},
    {"tension_rate", "-", ROW(rate_tension)},
    {"position_max_error", "m", ROW(report.position_max)},
    {"compression", "N", ROW(report.compression)},
    {"shortening", "-", ROW(report.shortening)},
    {"penetration", "m", ROW(report.penetration)},
    {"creep", "m", ROW(report.creep)},
    {"friction_excess", "N", ROW(report.friction_excess)},
};
enum { COLUMNS = sizeof COLUMN / sizeof COLUMN[0] };

static void put_number(FILE *out, double x) {
    fputc(',', out);
    cpsi_put_csv_number(out, x);
}

static void put_study(const CpsStudyFiles *files, FILE *out) {
    const CpsClassicStep step = cps_classic_step(files->classic);
    fputs("stage,cells,h,converged,iterations,gradients", out);
    for (int i = 0; i < COLUMNS; ++i) fprintf(out, ",%s", COLUMN[i].name);
    fputs("\n,,m,,,", out);
    for (int i = 0; i < COLUMNS; ++i) fprintf(out, ",%s", COLUMN[i].unit);
    fputc('\n', out);
    for (int r = 0; r < cps_study_row_count(files->study); ++r) {
        const CpsStudyRow *row = cps_study_row(files->study, r);
        const int cells = row->parameters.cells > 0 ? row->parameters.cells : step.elements;
        fprintf(out, "%s,%d", cps_study_stage_key(row->stage), cells);
        put_number(out, step.length / cells);
        fprintf(out, ",%d,%d,%d", row->report.converged, row->report.iterations, row->report.evaluations);
        for (int i = 0; i < COLUMNS; ++i)
            put_number(out, *(const double *)(const void *)((const char *)row + COLUMN[i].offset));
        fputc('\n', out);
    }
}

/* P10.1 beside P2.1: a row per node; what belongs to an element stands beside the node it ends at */
static void put_first_order(const CpsStudyFiles *files, FILE *out) {
    const CpsClassicStep step = cps_classic_step(files->classic);
    const CpsFirstOrderView view = cps_first_order_view(files->first_order);
    fputs("arc_length,reference.x,reference.y,reference.z,P2.1.x,P2.1.y,P2.1.z,u.x,u.y,u.z,friction.x,friction.y,"
          "friction.z,"
          "reaction,strain,tension.x,tension.y,tension.z,P2.1.tension\n"
          "m,m,m,m,m,m,m,m,m,m,N,N,N,N,-,N,N,N,N\n",
          out);
    for (int j = 0; j <= step.elements; ++j) {
        const size_t k = 3 * (size_t)j;
        const double *const vector[] = {step.reference + k, step.position + k, view.displacement + k,
                                        view.friction + k};
        cpsi_put_csv_number(out, view.arc_length[j]);
        for (size_t v = 0; v < sizeof vector / sizeof *vector; ++v)
            for (int x = 0; x < 3; ++x) put_number(out, vector[v][x]);
        put_number(out, view.reaction[j]);
        put_number(out, j > 0 ? view.strain[j - 1] : NAN);
        for (int x = 0; x < 3; ++x) put_number(out, j > 0 ? view.tension[k - 3 + (size_t)x] : NAN);
        put_number(out, j > 0 ? step.tension[j - 1] : NAN);
        fputc('\n', out);
    }
}

static bool nothing_stale(const char *name) {
    (void)name;
    return false;
}

static CpsStatus write_all(CpsiDirectory *directory, const CpsStudyFiles *files, CpsError *err) {
    static const struct {
        const char *name;
        void (*put)(const CpsStudyFiles *files, FILE *out);
    } FILES[] = {{"study.csv", put_study},
                 {"study.svg", cpsi_picture_study},
                 {"first-order.csv", put_first_order},
                 {"first-order.svg", cpsi_picture_first_order},
                 {"relaxed.svg", cpsi_picture_relaxed}};
    CpsStatus status = CPS_OK;
    for (size_t i = 0; i < sizeof FILES / sizeof *FILES && status == CPS_OK; ++i) {
        FILE *out = NULL;
        status = cpsi_directory_create(directory, FILES[i].name, &out, err);
        if (status != CPS_OK) break;
        FILES[i].put(files, out);
        status = cpsi_directory_close_file(directory, out, err);
    }
    return status == CPS_OK ? cpsi_directory_commit(directory, nothing_stale, err) : status;
}

CpsStatus cps_study_write(const char *directory, const CpsStudyFiles *files, CpsError *err) {
    if (!directory || !files || !files->title || !files->classic || !files->study || !files->first_order)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "directory, files, or one of what files has, is NULL");
    /* numbers have a decimal point whatever the program's locale */
    const locale_t numbers = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (!numbers) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    const locale_t before = uselocale(numbers);
    CpsiDirectory *open = NULL;
    CpsStatus status = cpsi_directory_open(directory, &open, err);
    if (status == CPS_OK) status = write_all(open, files, err);
    cpsi_directory_destroy(open);
    uselocale(before);
    freelocale(numbers);
    return status;
}
