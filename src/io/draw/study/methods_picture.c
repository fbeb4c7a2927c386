/* SPDX-License-Identifier: BSD-3-Clause */
/* Configurations side by side: the projections of S90 figures 5 to 12 (see methods_picture.h). */
#include "io/draw/study/methods_picture.h"

#include <math.h>
#include <string.h>

#include "io/base/text/escape.h"
#include "io/draw/svg.h"

enum {
    LEFT = 84,
    NARROW = 300,
    WIDE = 720,
    GAP = 90,
    TOP = 100,
    PLAN_HEIGHT = 300,
    SIDE_HEIGHT = 180,
    PITCH = 80,
    CURVES = 60,
    RINGED = 8,  /* number of steps separated by rings */
    DOTTED = 120 /* up to this number, nodes are drawn one by one */
};

/* frames below each other */
enum { PLAN, ELEVATION, PLAN_NEAR, ELEVATION_NEAR, ROWS };

typedef struct MethodsSheet {
    const CpsiMethods *m;
    int rows;
    double column;       /* width */
    double whole[3][2];  /* ranges of everything drawn, so that columns can be compared */
    double around[3][2]; /* the same for end B after the start; heights are all included */
} MethodsSheet;

static const double *place(const CpsiMethods *m, int method, int step, int point) {
    return m->method[method].position + 3 * ((size_t)step * (size_t)m->points + (size_t)point);
}

static CpsiColour step_colour(const CpsiMethods *m, int step) {
    return cpsi_colour(CPSI_SCALE_STEP, m->steps > 1 ? (double)step / (m->steps - 1) : 1);
}

static void find_ranges(MethodsSheet *sheet) {
    const CpsiMethods *m = sheet->m;
    for (int x = 0; x < 3; ++x) {
        sheet->whole[x][0] = sheet->around[x][0] = INFINITY;
        sheet->whole[x][1] = sheet->around[x][1] = -INFINITY;
    }
    for (int k = 0; k < m->methods; ++k)
        for (int s = 0; s < m->steps; ++s)
            for (int p = 0; p < m->points; ++p)
                for (int x = 0; x < 3; ++x) {
                    const double value = place(m, k, s, p)[x];
                    cpsi_range_include(sheet->whole[x], value);
                    if (p == m->points - 1 && s > 0) cpsi_range_include(sheet->around[x], value);
                }
    for (int x = 0; x < 3; ++x) {
        cpsi_range_pad(sheet->whole[x], 0.06);
        cpsi_range_pad(sheet->around[x], 0.5);
    }
    memcpy(sheet->around[2], sheet->whole[2], sizeof sheet->whole[2]);
}

/* the same metres per pixel along both axes */
static void make_even(CpsiFrame *frame) {
    const double across = (frame->x[1] - frame->x[0]) / frame->width,
                 up = (frame->y[1] - frame->y[0]) / frame->height;
    double *narrow = across > up ? frame->y : frame->x;
    const double wanted = fmax(across, up) * (across > up ? frame->height : frame->width);
    const double more = (wanted - (narrow[1] - narrow[0])) / 2;
    narrow[0] -= more;
    narrow[1] += more;
}

static void draw_point(const CpsiMethods *m, const CpsiFrame *frame, int method, int step,
                       int point, int up, FILE *out) {
    const double *x = place(m, method, step, point);
    fprintf(out, "%.1f,%.1f ", cpsi_frame_x(frame, x[0]), cpsi_frame_y(frame, x[up]));
}

/* the node before the first one inside the frame */
static int first_inside(const CpsiMethods *m, const CpsiFrame *frame, int method, int step,
                        int up) {
    for (int p = 0; p < m->points; ++p) {
        const double *x = place(m, method, step, p);
        if (x[0] >= frame->x[0] && x[0] <= frame->x[1] && x[up] >= frame->y[0] &&
            x[up] <= frame->y[1])
            return p > 0 ? p - 1 : 0;
    }
    return m->points - 1;
}

/* Steps with the same final position remain visible: each is drawn over the one before, and
 * thinner. */
static double width_of(const CpsiMethods *m, int step, bool near) {
    if (m->steps < 2) return 1.6;
    return 1.2 + (near ? 6 : 2.4) * (m->steps - 1 - step) / m->steps;
}

/* End B after a step, as a ring; rings of steps with the same final position are concentric. */
static void draw_ring(const CpsiMethods *m, const CpsiFrame *frame, int method, int step, int up,
                      FILE *out) {
    const double *x = place(m, method, step, m->points - 1);
    fprintf(out,
            "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"none\" stroke=\"%s\" "
            "stroke-width=\"1.8\"/>\n",
            cpsi_frame_x(frame, x[0]), cpsi_frame_y(frame, x[up]),
            3.0 + 2.6 * (m->steps - 1 - step), step_colour(m, step).hex);
}

/* The nodes of a short piece, as dots, whatever their distance. */
static void draw_dots(const CpsiMethods *m, const CpsiFrame *frame, int method, FILE *out) {
    if (m->points <= DOTTED)
        for (int p = 0; p < m->points; ++p) {
            const double *x = place(m, method, 0, p);
            fprintf(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"2\" fill=\"%s\"/>\n",
                    cpsi_frame_x(frame, x[0]), cpsi_frame_y(frame, x[1]), step_colour(m, 0).hex);
        }
}

/* About 150 points are enough for a whole line, and for the rest those inside the frame; more would
 * only make files larger. */
static void draw_curve(const CpsiMethods *m, const CpsiFrame *frame, int method, int step, int up,
                       bool near, FILE *out) {
    const int last = m->points - 1;
    const int stride = !near && !m->plan_only && last > NARROW / 2 ? last / (NARROW / 2) : 1;
    for (int p = near ? first_inside(m, frame, method, step, up) : 0; p < last; p += stride)
        draw_point(m, frame, method, step, p, up, out);
    draw_point(m, frame, method, step, last, up, out);
}

static bool is_near(int row) { return row >= PLAN_NEAR; }
static bool is_plan(int row) { return row % 2 == PLAN; }

static double row_top(int row) {
    const int pairs = row / 2;
    return TOP + (PLAN_HEIGHT + SIDE_HEIGHT + 2 * PITCH) * pairs +
           (is_plan(row) ? 0 : PLAN_HEIGHT + PITCH);
}

static double row_bottom(int row) {
    return row_top(row) + (is_plan(row) ? PLAN_HEIGHT : SIDE_HEIGHT);
}

/* for a long history an even selection, with the first and the last step */
static bool is_drawn(const CpsiMethods *m, int step) {
    return step % (m->steps / CURVES + 1) == 0 || step == m->steps - 1;
}

static void draw_frame(const MethodsSheet *sheet, int method, int row, FILE *out) {
    const CpsiMethods *m = sheet->m;
    const int up = is_plan(row) ? 1 : 2;
    const double(*range)[2] = is_near(row) ? sheet->around : sheet->whole;
    CpsiFrame frame = {.left = LEFT + (sheet->column + GAP) * method,
                       .top = row_top(row),
                       .width = sheet->column,
                       .height = row_bottom(row) - row_top(row),
                       .x = {range[0][0], range[0][1]},
                       .y = {range[up][0], range[up][1]}};
    if (is_plan(row)) make_even(&frame);
    cpsi_frame_axes(out, &frame, "x (m)", is_plan(row) ? "y (m)" : "z (m)");
    cpsi_frame_begin(out, &frame, ROWS * method + row);
    for (int s = 0; s < m->steps; ++s) {
        if (!is_drawn(m, s)) continue;
        fprintf(out, "<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"%.1f\" points=\"",
                step_colour(m, s).hex, width_of(m, s, is_near(row)));
        draw_curve(m, &frame, method, s, up, is_near(row), out);
        fputs("\"/>\n", out);
    }
    if (m->steps <= RINGED)
        for (int s = 1; s < m->steps && is_near(row); ++s) draw_ring(m, &frame, method, s, up, out);
    if (m->plan_only) draw_dots(m, &frame, method, out);
    cpsi_frame_end(out);
    if (!is_plan(row)) return;
    char name[96];
    snprintf(name, sizeof name, "%.72s%s", m->method[method].name,
             is_near(row) ? ", around end B" : "");
    cpsi_svg_text(out, frame.left + frame.width / 2, frame.top - 10, CPSI_MIDDLE,
                  "font-weight=\"bold\"", name);
}

static void draw_legend(const MethodsSheet *sheet, double width, double y, FILE *out) {
    const CpsiMethods *m = sheet->m;
    double x = LEFT;
    for (int s = 0; s < m->steps; ++s) {
        char mark[128], name[24];
        snprintf(name, sizeof name, "%.*s", (int)cpsi_utf8_cut(m->step_name[s], 18),
                 m->step_name[s]);
        if (x + 44 + 8 * (double)strlen(name) > width) break;
        snprintf(mark, sizeof mark,
                 "<line x1=\"-11\" x2=\"11\" y1=\"0\" y2=\"0\" stroke=\"%s\" stroke-width=\"3\"/>",
                 step_colour(m, s).hex);
        cpsi_legend(out, &x, y, mark, name);
    }
}

void cpsi_picture_methods(const CpsiMethods *m, FILE *out) {
    MethodsSheet sheet = {.m = m,
                          .rows = m->plan_only   ? 1
                                  : m->steps > 1 ? ROWS
                                                 : PLAN_NEAR,
                          .column = m->methods > 1 ? NARROW : WIDE};
    find_ranges(&sheet);
    const double width = LEFT + (sheet.column + GAP) * m->methods,
                 bottom = row_bottom(sheet.rows - 1) + 56;
    cpsi_svg_begin(out, width, bottom + (m->steps > 1 ? 34 : 0), m->title, m->note);
    for (int k = 0; k < m->methods; ++k)
        for (int row = 0; row < sheet.rows; ++row) draw_frame(&sheet, k, row, out);
    if (m->steps > 1) draw_legend(&sheet, width, bottom + 18, out);
    cpsi_svg_finish(out);
}
