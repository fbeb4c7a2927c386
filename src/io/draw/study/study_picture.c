/* SPDX-License-Identifier: BSD-3-Clause */
/* The convergence of a study: the final tensions of the stages, and the errors of all solves. */
#include <math.h>

#include "io/base/text/escape.h"
#include "io/draw/study/study_picture.h"
#include "io/draw/svg.h"

enum {
    SHEET_WIDTH = 960,
    LEFT = 84,
    WIDTH = 640,
    TENSION_TOP = 84,
    TENSION_HEIGHT = 280,
    ERROR_TOP = 440,
    ERROR_HEIGHT = 340,
    SHEET_HEIGHT = 850
};

/* smaller errors are not shown: rounding, and exact zeros */
static const double FLOOR = 1e-13;

static const char *const STAGE_NAME[CPS_STUDY_STAGE_COUNT] = {"h", "\xCE\xBB", "n", "\xCE\xB4"};

static CpsiColour stage_colour(int stage) {
    return cpsi_colour(CPSI_SCALE_STEP, (double)stage / (CPS_STUDY_STAGE_COUNT - 1));
}

/* ---- tensions ---- */

static void draw_tension(FILE *out, const CpsiFrame *frame, int cells, const double *arc,
                         const double *tension, double factor, const char *style) {
    fprintf(out, "<polyline fill=\"none\" %s points=\"", style);
    for (int i = 0; i < cells; ++i)
        fprintf(out, "%.1f,%.1f ", cpsi_frame_x(frame, (arc[i] + arc[i + 1]) / 2),
                cpsi_frame_y(frame, tension[i] * factor));
    fputs("\"/>\n", out);
}

static void draw_tensions(const CpsStudyFiles *files, FILE *out) {
    const CpsRegularizedStep step = cps_regularized_step(files->regularized);
    double range[2] = {0, 0};
    for (int i = 0; i < step.element_count; ++i) cpsi_range_include(range, step.tension[i]);
    for (int s = 0; s < CPS_STUDY_STAGE_COUNT; ++s) {
        const CpsRegularizedView view = cps_study_stage_end(files->study, (CpsStudyStage)s);
        for (int i = 0; i < view.cell_count; ++i) cpsi_range_include(range, view.tension[i]);
    }
    const CpsiUnit unit = cpsi_unit("N", range[1]);
    CpsiFrame frame = {.left = LEFT,
                       .top = TENSION_TOP,
                       .width = WIDTH,
                       .height = TENSION_HEIGHT,
                       .x = {0, step.length},
                       .y = {0, range[1] * unit.factor}};
    cpsi_range_pad(frame.y, 0.06);
    char label[32], style[128];
    snprintf(label, sizeof label, "tension (%s)", unit.name);
    cpsi_frame_axes(out, &frame, "natural length from A to B (m)", label);
    cpsi_frame_begin(out, &frame, 0);
    draw_tension(out, &frame, step.element_count, step.arc_length, step.tension, unit.factor,
                 "stroke=\"#bbb\" stroke-width=\"7\" stroke-linejoin=\"round\"");
    for (int s = 0; s < CPS_STUDY_STAGE_COUNT; ++s) {
        const CpsRegularizedView view = cps_study_stage_end(files->study, (CpsStudyStage)s);
        snprintf(style, sizeof style, "stroke=\"%s\" stroke-width=\"%.1f\"", stage_colour(s).hex,
                 3.4 - 0.6 * s);
        if (view.cell_count > 0)
            draw_tension(out, &frame, view.cell_count, view.arc_length, view.tension, unit.factor,
                         style);
    }
    cpsi_frame_end(out);

    /* the legend */
    const double x = LEFT + WIDTH + 20;
    for (int s = -1; s < CPS_STUDY_STAGE_COUNT; ++s) {
        const double y = TENSION_TOP + 30 + 22 * s;
        char text[64];
        if (s < 0)
            snprintf(text, sizeof text, "solution of P4.2");
        else
            snprintf(text, sizeof text, "%s at its limit", STAGE_NAME[s]);
        fprintf(out,
                "<line x1=\"%.1f\" x2=\"%.1f\" y1=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" "
                "stroke-width=\"%d\"/>",
                x, x + 18, y - 4, y - 4, s < 0 ? "#bbb" : stage_colour(s).hex, s < 0 ? 7 : 3);
        cpsi_svg_text(out, x + 26, y, CPSI_START, "", text);
    }
}

/* ---- errors ---- */

enum { CURVES = 6 };
static const struct {
    const char *name, *colour, *dash;
} CURVE[CURVES] = {{"energy / (force length)", "#1b6ca8", ""},
                   {"tension, rms / force", "#c2410c", ""},
                   {"penetration / length", "#4d7c0f", ""},
                   {"creep below the bound / length", "#7e22ce", ""},
                   {"push / force", "#b91c1c", "stroke-dasharray=\"5 3\""},
                   {"force without a carrier / force", "#555555", "stroke-dasharray=\"5 3\""}};

static double curve_value(int curve, CpsRegularizedReport r, const CpsRegularizedStep *step) {
    const double value[CURVES] = {fabs(r.energy_error) / (step->force * step->length),
                                  r.tension_rms / step->force,
                                  r.penetration / step->length,
                                  r.creep / step->length,
                                  r.compression / step->force,
                                  r.friction_excess / step->force};
    return log10(fmax(value[curve], FLOOR));
}

static void draw_stages(FILE *out, const CpsiFrame *frame, const CpsStudy *study) {
    const int rows = cps_study_row_count(study);
    for (int s = 0; s < CPS_STUDY_STAGE_COUNT; ++s) {
        int first = rows, last = -1;
        for (int i = rows - 1; i >= 0; --i)
            if (cps_study_row(study, i).stage == (CpsStudyStage)s) {
                first = i;
                last = last < 0 ? i : last;
            }
        if (last < 0) continue;
        const double left = cpsi_frame_x(frame, first - 0.5),
                     right = cpsi_frame_x(frame, last + 0.5);
        fprintf(out,
                "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\" "
                "opacity=\"0.10\"/>\n",
                left, frame->top, right - left, frame->height, stage_colour(s).hex);
        cpsi_svg_text(out, (left + right) / 2, frame->top - 8, CPSI_MIDDLE, "font-weight=\"bold\"",
                      STAGE_NAME[s]);
    }
}

static void draw_errors(const CpsStudyFiles *files, FILE *out) {
    const CpsRegularizedStep step = cps_regularized_step(files->regularized);
    const int rows = cps_study_row_count(files->study);
    double range[2] = {INFINITY, -INFINITY};
    for (int i = 0; i < rows; ++i)
        for (int c = 0; c < CURVES; ++c) {
            const double value = curve_value(c, cps_study_row(files->study, i).report, &step);
            if (value > log10(FLOOR)) cpsi_range_include(range, value);
        }
    cpsi_range_pad(range, 0.05);
    const CpsiFrame frame = {.left = LEFT,
                             .top = ERROR_TOP,
                             .width = WIDTH,
                             .height = ERROR_HEIGHT,
                             .x = {-0.5, rows - 0.5},
                             .y = {range[0], range[1]}};
    draw_stages(out, &frame, files->study);
    cpsi_frame_axes(out, &frame, "solve, in the order h, \xCE\xBB, n, \xCE\xB4",
                    "log10 of what is left");
    cpsi_frame_begin(out, &frame, 1);
    for (int c = 0; c < CURVES; ++c) {
        fprintf(out, "<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"1.8\" %s points=\"",
                CURVE[c].colour, CURVE[c].dash);
        for (int i = 0; i < rows; ++i)
            fprintf(out, "%.1f,%.1f ", cpsi_frame_x(&frame, i),
                    cpsi_frame_y(&frame,
                                 curve_value(c, cps_study_row(files->study, i).report, &step)));
        fputs("\"/>\n", out);
    }
    /* a solve that did not converge is crossed out */
    for (int i = 0; i < rows; ++i) {
        const CpsStudyRow row = cps_study_row(files->study, i);
        if (row.report.converged) continue;
        cpsi_svg_text(out, cpsi_frame_x(&frame, i),
                      cpsi_frame_y(&frame, curve_value(1, row.report, &step)) + 4, CPSI_MIDDLE,
                      "fill=\"#b91c1c\" font-weight=\"bold\"", "\xC3\x97");
    }
    cpsi_frame_end(out);
    for (int c = 0; c < CURVES; ++c) {
        const double x = LEFT + WIDTH + 20, y = ERROR_TOP + 14 + 22 * c;
        fprintf(out,
                "<line x1=\"%.1f\" x2=\"%.1f\" y1=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" "
                "stroke-width=\"2\" %s/>",
                x, x + 18, y - 4, y - 4, CURVE[c].colour, CURVE[c].dash);
        cpsi_svg_text(out, x + 26, y, CPSI_START, "", CURVE[c].name);
    }
}

void cpsi_picture_study(const CpsStudyFiles *files, FILE *out) {
    const int rows = cps_study_row_count(files->study);
    int iterations = 0, open = 0;
    for (int i = 0; i < rows; ++i) {
        const CpsStudyRow row = cps_study_row(files->study, i);
        iterations += row.report.iteration_count;
        open += !row.report.converged;
    }
    char note[160];
    snprintf(note, sizeof note,
             "The method of section 5 on its way to P4.2  \xC2\xB7  %d solves, %d Newton steps%s",
             rows, iterations, open ? "  \xC2\xB7  \xC3\x97 did not converge" : "");
    cpsi_svg_begin(out, SHEET_WIDTH, SHEET_HEIGHT, files->title, note);
    draw_tensions(files, out);
    if (rows > 0) draw_errors(files, out);
    cpsi_svg_finish(out);
}
