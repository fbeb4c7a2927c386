/* SPDX-License-Identifier: BSD-3-Clause */
/* P10.1 beside P2.1 (S90 annex 5), and J beside J** (remark 4.6.1, figure 4). */
#include <math.h>
#include <stddef.h>

#include "base/vec3.h"
#include "io/base/text/escape.h"
#include "io/draw/study/study_picture.h"
#include "io/draw/svg.h"

enum {
    SHEET_WIDTH = 960,
    LEFT = 84,
    WIDTH = 740,
    HEIGHT = 250,
    PITCH = 330,
    TOP = 84,
    CURVE_POINTS = 241
};

static const char *const FIRST_ORDER_STYLE = "stroke=\"#c2410c\" stroke-width=\"2\"";
static const char *const STEP_STYLE = "stroke=\"#1b6ca8\" stroke-width=\"2\"";

typedef double Along(const CpsStudyFiles *files, int element);

static double step_strain(const CpsStudyFiles *files, int i) {
    const CpsRegularizedStep step = cps_regularized_step(files->regularized);
    return step.tension[i] / step.stiffness;
}

static double step_tension(const CpsStudyFiles *files, int i) {
    return cps_regularized_step(files->regularized).tension[i];
}

static Vec3 tangent(const CpsStudyFiles *files, int i) {
    const double *x = cps_regularized_step(files->regularized).reference + 3 * (size_t)i;
    const Vec3 d = vec3_sub(vec3_load(x + 3), vec3_load(x));
    const double length = vec3_norm(d);
    return length > 0 ? vec3_scale(1 / length, d) : d;
}

static double linear_tension(const CpsStudyFiles *files, int i) {
    return vec3_dot(vec3_load(cps_first_order_view(files->first_order).tension + 3 * (size_t)i),
                    tangent(files, i));
}

/* strain of the reference, limited to what P10.1 can represent, and its change */
static double linear_strain(const CpsStudyFiles *files, int i) {
    const CpsRegularizedStep step = cps_regularized_step(files->regularized);
    const double *x = step.reference + 3 * (size_t)i;
    const double reference = vec3_norm(vec3_sub(vec3_load(x + 3), vec3_load(x))) /
                                 (step.arc_length[i + 1] - step.arc_length[i]) -
                             1;
    return fmax(0, reference) + cps_first_order_view(files->first_order).strain[i];
}

static void draw_curve(const CpsStudyFiles *files, const CpsiFrame *frame, Along *value,
                       double factor, const char *style, FILE *out) {
    const CpsRegularizedStep step = cps_regularized_step(files->regularized);
    fprintf(out, "<polyline fill=\"none\" %s points=\"", style);
    for (int i = 0; i < step.element_count; ++i)
        fprintf(out, "%.1f,%.1f ",
                cpsi_frame_x(frame, (step.arc_length[i] + step.arc_length[i + 1]) / 2),
                cpsi_frame_y(frame, factor * value(files, i)));
    fputs("\"/>\n", out);
}

static void draw_pair(const CpsStudyFiles *files, int panel, Along *linear, Along *exact,
                      const char *base, FILE *out) {
    const CpsRegularizedStep step = cps_regularized_step(files->regularized);
    double range[2] = {0, 0};
    for (int i = 0; i < step.element_count; ++i) {
        cpsi_range_include(range, linear(files, i));
        cpsi_range_include(range, exact(files, i));
    }
    const CpsiUnit unit = *base ? cpsi_unit(base, fmax(fabs(range[0]), range[1]))
                                : (CpsiUnit){.name = "-", .factor = 1};
    CpsiFrame frame = {.left = LEFT,
                       .top = TOP + PITCH * panel,
                       .width = WIDTH,
                       .height = HEIGHT,
                       .x = {0, step.length},
                       .y = {range[0] * unit.factor, range[1] * unit.factor}};
    cpsi_range_pad(frame.y, 0.08);
    char label[64];
    snprintf(label, sizeof label, "%s (%s)", *base ? "tension along t_R" : "strain", unit.name);

    /* the region that a line cannot reach */
    const double zero = cpsi_frame_y(&frame, 0), bottom = frame.top + frame.height;
    fprintf(out,
            "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"#b91c1c\" "
            "opacity=\"0.08\"/>\n",
            frame.left, zero, frame.width, fmax(0, bottom - zero));
    cpsi_frame_axes(out, &frame, "natural length from A to B (m)", label);
    cpsi_frame_begin(out, &frame, panel);
    draw_curve(files, &frame, exact, unit.factor, STEP_STYLE, out);
    draw_curve(files, &frame, linear, unit.factor, FIRST_ORDER_STYLE, out);
    cpsi_frame_end(out);
}

/* Abscissa of a position along the line between ends A and B of the reference; a line that turns
 * back has smaller abscissae again. */
static double along_reference(const CpsRegularizedStep *step, Vec3 x) {
    const Vec3 from = vec3_load(step->reference),
               chord = vec3_sub(vec3_load(step->reference + 3 * (size_t)step->element_count), from);
    const double length = vec3_norm(chord);
    return length > 0 ? vec3_dot(vec3_sub(x, from), chord) / length : 0;
}

/* x of P2.1, or x_R + u of P10.1, or x_R */
typedef enum Configuration { EXACT, LINEAR, REFERENCE } Configuration;

static double node_along(const CpsStudyFiles *files, Configuration of, int j) {
    const CpsRegularizedStep step = cps_regularized_step(files->regularized);
    const size_t k = 3 * (size_t)j;
    Vec3 x = vec3_load((of == EXACT ? step.position : step.reference) + k);
    if (of == LINEAR)
        x = vec3_add(x, vec3_load(cps_first_order_view(files->first_order).displacement + k));
    return along_reference(&step, x);
}

static void draw_places(const CpsStudyFiles *files, int panel, bool linear, FILE *out) {
    static const char REFERENCE_STYLE[] = "stroke=\"#bbb\" stroke-width=\"5\"";
    const CpsRegularizedStep step = cps_regularized_step(files->regularized);
    const Configuration shown[] = {REFERENCE, EXACT, LINEAR};
    const char *const style[] = {REFERENCE_STYLE, STEP_STYLE, FIRST_ORDER_STYLE};
    const int count = linear ? 3 : 2;
    double range[2] = {0, 0};
    for (int c = 0; c < count; ++c)
        for (int j = 0; j <= step.element_count; ++j)
            cpsi_range_include(range, node_along(files, shown[c], j));
    CpsiFrame frame = {.left = LEFT,
                       .top = TOP + PITCH * panel,
                       .width = WIDTH,
                       .height = HEIGHT,
                       .x = {0, step.length},
                       .y = {range[0], range[1]}};
    cpsi_range_pad(frame.y, 0.08);
    cpsi_frame_axes(out, &frame, "natural length from A to B (m)",
                    "place along the reference, A to B (m)");
    cpsi_frame_begin(out, &frame, panel);
    for (int c = 0; c < count; ++c) {
        fprintf(out, "<polyline fill=\"none\" %s points=\"", style[c]);
        for (int j = 0; j <= step.element_count; ++j)
            fprintf(out, "%.1f,%.1f ", cpsi_frame_x(&frame, step.arc_length[j]),
                    cpsi_frame_y(&frame, node_along(files, shown[c], j)));
        fputs("\"/>\n", out);
    }
    cpsi_frame_end(out);
    double x = LEFT;
    char mark[128];
    snprintf(mark, sizeof mark, "<line x1=\"-11\" x2=\"11\" y1=\"0\" y2=\"0\" %s/>",
             REFERENCE_STYLE);
    cpsi_legend(out, &x, frame.top - 12, mark,
                "reference x_R; where a curve falls the line has turned over");
}

void cpsi_picture_first_order(const CpsStudyFiles *files, FILE *out) {
    const CpsFirstOrderReport report = cps_first_order_report(files->first_order);
    const bool drawn = report.outcome == CPS_FIRST_ORDER_OUTCOME_SOLVED ||
                       report.outcome == CPS_FIRST_ORDER_OUTCOME_SHORTENS;
    char note[200];
    snprintf(note, sizeof note, "P10.1: %s", cps_first_order_outcome_text(report.outcome));
    cpsi_svg_begin(out, SHEET_WIDTH, TOP + PITCH * (drawn ? 3 : 2) - 10, files->title, note);
    if (drawn) {
        draw_pair(files, 0, linear_strain, step_strain, "", out);
        draw_pair(files, 1, linear_tension, step_tension, "N", out);
    } else {
        /* displacements that diverge are not drawn as curves */
        draw_pair(files, 0, step_tension, step_tension, "N", out);
    }
    draw_places(files, drawn ? 2 : 1, drawn, out);
    double x = LEFT;
    char mark[128];
    snprintf(mark, sizeof mark, "<line x1=\"-11\" x2=\"11\" y1=\"0\" y2=\"0\" %s/>", STEP_STYLE);
    cpsi_legend(out, &x, TOP - 12, mark, "P2.1");
    snprintf(mark, sizeof mark, "<line x1=\"-11\" x2=\"11\" y1=\"0\" y2=\"0\" %s/>",
             FIRST_ORDER_STYLE);
    if (drawn) cpsi_legend(out, &x, TOP - 12, mark, "P10.1, first order");
    cpsi_legend(
        out, &x, TOP - 12,
        "<rect x=\"-11\" y=\"-5\" width=\"22\" height=\"10\" fill=\"#b91c1c\" opacity=\"0.15\"/>",
        "below zero: what a line cannot do");
    cpsi_svg_finish(out);
}

/* ---- remark 4.6.1 ---- */

static double energy(double stiffness, double alpha, bool relaxed) {
    const double strain = fabs(alpha) - 1;
    return stiffness / 2 * (relaxed && strain < 0 ? 0 : strain * strain) + alpha;
}

static void draw_energy(const CpsiFrame *frame, double stiffness, bool relaxed, const char *style,
                        FILE *out) {
    fprintf(out, "<polyline fill=\"none\" %s points=\"", style);
    for (int i = 0; i < CURVE_POINTS; ++i) {
        const double alpha = frame->x[0] + (frame->x[1] - frame->x[0]) * i / (CURVE_POINTS - 1);
        fprintf(out, "%.1f,%.1f ", cpsi_frame_x(frame, alpha),
                cpsi_frame_y(frame, energy(stiffness, alpha, relaxed)));
    }
    fputs("\"/>\n", out);
}

void cpsi_picture_relaxed(const CpsStudyFiles *files, FILE *out) {
    const CpsRegularizedStep step = cps_regularized_step(files->regularized);
    double largest = 0;
    for (int i = 0; i < step.element_count; ++i) largest = fmax(largest, step.tension[i]);
    if (!(largest > 0)) largest = step.force;
    const double stiffness = step.stiffness / largest, place = -(1 + 1 / stiffness),
                 least = -(1 + 1 / (2 * stiffness));
    char note[160];
    snprintf(note, sizeof note,
             "K is %.4g times the largest tension: both are least at \xCE\xB1 = %.4f, where they "
             "are %.4f",
             stiffness, place, least);
    cpsi_svg_begin(out, SHEET_WIDTH, TOP + 430, "J and J** of remark 4.6.1", note);
    const double reach = 2 * fmax(1, 1 / stiffness) + 0.2;
    const CpsiFrame frame = {.left = LEFT,
                             .top = TOP,
                             .width = WIDTH,
                             .height = 370,
                             .x = {-reach, reach},
                             .y = {least - 0.5, fmax(energy(stiffness, 0, false),
                                                     energy(stiffness, reach, true)) *
                                                    1.05}};
    cpsi_frame_axes(out, &frame, "\xCE\xB1", "energy");
    cpsi_frame_begin(out, &frame, 0);
    draw_energy(&frame, stiffness, false, "stroke=\"#c2410c\" stroke-width=\"4\"", out);
    draw_energy(&frame, stiffness, true, "stroke=\"#1b6ca8\" stroke-width=\"2\"", out);
    fprintf(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4\" fill=\"#1a1a1a\"/>\n",
            cpsi_frame_x(&frame, place), cpsi_frame_y(&frame, least));
    cpsi_frame_end(out);
    double x = LEFT + 12;
    cpsi_legend(
        out, &x, TOP - 12,
        "<line x1=\"-11\" x2=\"11\" y1=\"0\" y2=\"0\" stroke=\"#c2410c\" stroke-width=\"4\"/>",
        "J, not convex");
    cpsi_legend(
        out, &x, TOP - 12,
        "<line x1=\"-11\" x2=\"11\" y1=\"0\" y2=\"0\" stroke=\"#1b6ca8\" stroke-width=\"2\"/>",
        "J**, relaxed");
    cpsi_legend(out, &x, TOP - 12, "<circle r=\"4\" fill=\"#1a1a1a\"/>", "minimum of both");
    cpsi_svg_finish(out);
}
