/* SPDX-License-Identifier: BSD-3-Clause */
/* The same history by several methods, side by side: the projections of S90 figures 5 to 12, and a table. */
#include <locale.h>
#include <math.h>

#include "base/status.h"
#include "base/vec3.h"
#include "capstan/classic_io.h"
#include "io/result_file.h"
#include "io/result_text.h"
#include "io/svg.h"

enum {
    MAX_METHODS = 4,
    LEFT = 84,
    COLUMN = 300,
    GAP = 90,
    PLAN_TOP = 100,
    PLAN_HEIGHT = 300,
    SIDE_TOP = 480,
    SIDE_HEIGHT = 180,
    SHEET_HEIGHT = 740
};

typedef struct Methods {
    const char *title;
    int methods, steps, points;
    const CpsMethodHistory *method;
    const char *const *step_name;
} Methods;

static const double *place(const Methods *m, int method, int step, int point) {
    return m->method[method].position + 3 * ((size_t)step * (size_t)m->points + (size_t)point);
}

/* ---- table ---- */

static double farthest(const Methods *m, int method, int step) {
    double most = 0;
    for (int p = 0; p < m->points; ++p) {
        const Vec3 way = vec3_sub(vec3_load(place(m, method, step, p)), vec3_load(place(m, 0, step, p)));
        most = fmax(most, vec3_norm(way));
    }
    return most;
}

static void put_table(const Methods *m, FILE *out) {
    fputs("step,method,B.x,B.y,B.z,farthest_from_first\n,,m,m,m,m\n", out);
    for (int s = 0; s < m->steps; ++s)
        for (int k = 0; k < m->methods; ++k) {
            cpsi_put_csv(out, m->step_name[s]);
            fputc(',', out);
            cpsi_put_csv(out, m->method[k].name);
            for (int x = 0; x < 3; ++x) {
                fputc(',', out);
                cpsi_put_csv_number(out, place(m, k, s, m->points - 1)[x]);
            }
            fputc(',', out);
            cpsi_put_csv_number(out, farthest(m, k, s));
            fputc('\n', out);
        }
}

/* ---- picture ---- */

static CpsiColour step_colour(const Methods *m, int step) {
    return cpsi_colour(CPSI_SCALE_STEP, m->steps > 1 ? (double)step / (m->steps - 1) : 1);
}

/* ranges of all methods, so that columns compare */
static void find_ranges(const Methods *m, double range[3][2]) {
    for (int x = 0; x < 3; ++x) range[x][0] = INFINITY, range[x][1] = -INFINITY;
    for (int k = 0; k < m->methods; ++k)
        for (int s = 0; s < m->steps; ++s)
            for (int p = 0; p < m->points; ++p)
                for (int x = 0; x < 3; ++x) cpsi_range_include(range[x], place(m, k, s, p)[x]);
    for (int x = 0; x < 3; ++x) cpsi_range_pad(range[x], 0.06);
}

/* the same metres per pixel along both axes */
static void make_even(CpsiFrame *frame) {
    const double across = (frame->x[1] - frame->x[0]) / frame->width, up = (frame->y[1] - frame->y[0]) / frame->height;
    double *narrow = across > up ? frame->y : frame->x;
    const double wanted = fmax(across, up) * (across > up ? frame->height : frame->width);
    const double more = (wanted - (narrow[1] - narrow[0])) / 2;
    narrow[0] -= more, narrow[1] += more;
}

static void put_point(const Methods *m, const CpsiFrame *frame, int method, int step, int point, int up, FILE *out) {
    const double *x = place(m, method, step, point);
    fprintf(out, "%.1f,%.1f ", cpsi_frame_x(frame, x[0]), cpsi_frame_y(frame, x[up]));
}

/* a point on every second pixel is enough; more only make files large */
static void put_curve(const Methods *m, const CpsiFrame *frame, int method, int step, int up, FILE *out) {
    const int last = m->points - 1, stride = last > COLUMN / 2 ? last / (COLUMN / 2) : 1;
    for (int p = 0; p < last; p += stride) put_point(m, frame, method, step, p, up, out);
    put_point(m, frame, method, step, last, up, out);
}

static void draw_frame(const Methods *m, int method, int row, double range[3][2], FILE *out) {
    const int up = row ? 2 : 1;
    CpsiFrame frame = {.left = LEFT + (COLUMN + GAP) * method,
                       .top = row ? SIDE_TOP : PLAN_TOP,
                       .width = COLUMN,
                       .height = row ? SIDE_HEIGHT : PLAN_HEIGHT,
                       .x = {range[0][0], range[0][1]},
                       .y = {range[up][0], range[up][1]}};
    if (!row) make_even(&frame);
    cpsi_frame_axes(out, &frame, "x (m)", row ? "z (m)" : "y (m)");
    cpsi_frame_begin(out, &frame, 2 * method + row);
    for (int s = 0; s < m->steps; ++s) {
        fprintf(out, "<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"%.1f\" points=\"", step_colour(m, s).hex,
                1.2 + 2.4 * (m->steps - 1 - s) / m->steps);
        put_curve(m, &frame, method, s, up, out);
        fputs("\"/>\n", out);
    }
    cpsi_frame_end(out);
    if (!row)
        cpsi_svg_text(out, frame.left + frame.width / 2, PLAN_TOP - 10, CPSI_MIDDLE, "font-weight=\"bold\"",
                      m->method[method].name);
}

static void put_picture(const Methods *m, FILE *out) {
    double range[3][2];
    find_ranges(m, range);
    cpsi_svg_begin(out, LEFT + (COLUMN + GAP) * m->methods, SHEET_HEIGHT, m->title,
                   "Plan and elevation (heights stretched), step by step");
    for (int k = 0; k < m->methods; ++k)
        for (int row = 0; row < 2; ++row) draw_frame(m, k, row, range, out);
    double x = LEFT;
    for (int s = 0; s < m->steps && x < LEFT + (COLUMN + GAP) * m->methods - 80; ++s) {
        char mark[128], name[24];
        snprintf(mark, sizeof mark, "<line x1=\"-11\" x2=\"11\" y1=\"0\" y2=\"0\" stroke=\"%s\" stroke-width=\"3\"/>",
                 step_colour(m, s).hex);
        snprintf(name, sizeof name, "%.*s", (int)cpsi_utf8_cut(m->step_name[s], 18), m->step_name[s]);
        cpsi_legend(out, &x, SHEET_HEIGHT - 14, mark, name);
    }
    cpsi_svg_finish(out);
}

/* ---- files ---- */

static bool nothing_stale(const char *name) {
    (void)name;
    return false;
}

static CpsStatus write_all(CpsiDirectory *directory, const Methods *m, CpsError *err) {
    static const struct {
        const char *name;
        void (*put)(const Methods *m, FILE *out);
    } FILES[] = {{"methods.csv", put_table}, {"methods.svg", put_picture}};
    CpsStatus status = CPS_OK;
    for (size_t i = 0; i < sizeof FILES / sizeof *FILES && status == CPS_OK; ++i) {
        FILE *out = NULL;
        status = cpsi_directory_create(directory, FILES[i].name, &out, err);
        if (status != CPS_OK) break;
        FILES[i].put(m, out);
        status = cpsi_directory_close_file(directory, out, err);
    }
    return status == CPS_OK ? cpsi_directory_commit(directory, nothing_stale, err) : status;
}

CpsStatus cps_methods_write(const char *directory, const char *title, int methods, const CpsMethodHistory *method,
                            int steps, int points, const char *const *step_name, CpsError *err) {
    if (!directory || !title || !method || !step_name)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "directory, title, method or step_name is NULL");
    if (methods < 1 || methods > MAX_METHODS || steps < 1 || points < 2)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "found %d methods, %d steps, %d points; expected 1 to %d, and at least 1 and 2", methods,
                         steps, points, (int)MAX_METHODS);
    const locale_t numbers = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (!numbers) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    const locale_t before = uselocale(numbers);
    const Methods m = {title, methods, steps, points, method, step_name};
    CpsiDirectory *open = NULL;
    CpsStatus status = cpsi_directory_open(directory, &open, err);
    if (status == CPS_OK) status = write_all(open, &m, err);
    cpsi_directory_destroy(open);
    uselocale(before);
    freelocale(numbers);
    return status;
}
