/* SPDX-License-Identifier: BSD-3-Clause */
/* Tensions and uplift at the ends, grounded and slipping length, over the steps of the history:
 * a frame for each pair of quantities, a colour for each line. Steps that are not certified are
 * left out. */
#include <math.h>
#include <stdlib.h>

#include "io/base/text/escape.h"
#include "io/draw/diagram.h"
#include "io/draw/run/run_picture.h"

static const double ROUNDING = 1e-9;

enum { TENSIONS, UPLIFT, LENGTHS, PANELS };
enum { MAX_LINES = 6, CURVES = 2, PANEL_HEIGHT = 190, PANEL_PITCH = 256, LEGEND = 24 };

static const char *const COLOUR[MAX_LINES] = {CPSI_BLUE, CPSI_ORANGE, CPSI_PLUM,
                                              "#3f8f5f", "#7a5fb0",   "#5a5a5a"};
/* solid, dashed */
static const char *const DASHES[CURVES] = {"", " stroke-dasharray=\"5 3\""};

/* A pair of quantities of a line that are drawn in one frame. */
typedef struct Panel {
    const char *label, *unit;
    const char *curve[CURVES];
    double (*value)(const CpsLineReport *report, int curve); /* NAN where it is not known */
} Panel;

static double tension(const CpsLineReport *report, int curve) { return report->end[curve].tension; }

static double uplift(const CpsLineReport *report, int curve) { return report->end[curve].uplift; }

static double length(const CpsLineReport *report, int curve) {
    if (curve == 0) return report->grounded;
    return report->has_slipping ? report->slipping : NAN;
}

static const Panel PANEL[PANELS] = {
    [TENSIONS] = {"tension", "N", {"end A", "end B"}, tension},
    [UPLIFT] = {"uplift", "N", {"end A", "end B"}, uplift},
    [LENGTHS] = {"length", "m", {"grounded", "slipping"}, length},
};

static int lines_drawn(const CpsResults *results) {
    return results->line_count < MAX_LINES ? results->line_count : MAX_LINES;
}

/* The value of a curve at a row, NAN where nothing is drawn. */
static double value_at(const CpsResults *results, const Panel *panel, int line, int curve,
                       int row) {
    const CpsLineReport *report = &results->row[row].line[line].report;
    return cps_outcome_is_certified(report->outcome) ? panel->value(report, curve) : NAN;
}

/* The range of a panel's values, with 0. */
static void value_range(const CpsResults *results, const Panel *panel, double range[2]) {
    range[0] = range[1] = 0;
    for (int row = 0; row < results->row_count; ++row)
        for (int line = 0; line < lines_drawn(results); ++line)
            for (int curve = 0; curve < CURVES; ++curve) {
                const double value = value_at(results, panel, line, curve, row);
                if (isfinite(value)) cpsi_range_include(range, value);
            }
}

/* Of a history in time the abscissa is the time, which stands still in quasi-static steps. */
static bool is_over_time(const CpsResults *results) {
    return results->row_count > 0 && results->row[results->row_count - 1].motion.time > 0;
}

static double abscissa(const CpsResults *results, int row) {
    return is_over_time(results) ? results->row[row].motion.time : row;
}

/* A curve, in pieces between steps without a value; `point` is work space for all rows. */
static void draw_curve(const CpsResults *results, const Panel *panel, const CpsiFrame *frame,
                       double factor, int line, int curve, double *point, FILE *out) {
    char style[120];
    snprintf(style, sizeof style, "fill=\"none\" stroke=\"%s\" stroke-width=\"1.6\"%s",
             COLOUR[line], DASHES[curve]);
    int count = 0;
    for (int row = 0; row <= results->row_count; ++row) {
        const double value =
            row < results->row_count ? value_at(results, panel, line, curve, row) : NAN;
        if (isfinite(value)) {
            point[2 * count] = abscissa(results, row);
            point[2 * count++ + 1] = factor * value;
            continue;
        }
        if (count > 1) cpsi_draw_curve(out, frame, count, point, false, style);
        if (count == 1) {
            char fill[40];
            snprintf(fill, sizeof fill, "fill=\"%s\"", COLOUR[line]);
            cpsi_draw_dot(out, frame, point, 2.5, fill);
        }
        count = 0;
    }
}

/* Thin lines where stages end. */
static void draw_stages(const CpsResults *results, const CpsiFrame *frame, FILE *out) {
    for (int i = 0; i + 1 < results->stage_count; ++i) {
        if (results->stage[i].last >= results->row_count - 1) break;
        const double x = cpsi_frame_x(frame, abscissa(results, results->stage[i].last));
        fprintf(out,
                "<path d=\"M%.1f %.1fV%.1f\" stroke=\"#bbb\" stroke-width=\"0.8\" "
                "stroke-dasharray=\"2 3\"/>\n",
                x, frame->top, frame->top + frame->height);
    }
}

/* What the dashes mean, above the frame. */
static void draw_legend(const Panel *panel, const CpsiFrame *frame, FILE *out) {
    double x = frame->left;
    for (int curve = 0; curve < CURVES; ++curve) {
        char mark[120];
        snprintf(mark, sizeof mark,
                 "<path d=\"M-11 0H11\" stroke=\"#444\" stroke-width=\"1.6\"%s/>", DASHES[curve]);
        cpsi_legend(out, &x, frame->top - 10, mark, panel->curve[curve]);
    }
}

/* The names of the lines in their colours, at the right of the frame. */
static void draw_names(const CpsResults *results, const CpsiFrame *frame, FILE *out) {
    for (int line = 0; line < lines_drawn(results); ++line) {
        char text[48], style[64];
        const char *name = results->line_name[line];
        snprintf(text, sizeof text, "%.*s", (int)cpsi_utf8_cut(name, 16), name);
        snprintf(style, sizeof style, "font-size=\"12\" fill=\"%s\"", COLOUR[line]);
        cpsi_svg_text(out, frame->left + frame->width + 10, frame->top + 12 + 16 * line, CPSI_START,
                      style, text);
    }
}

static void draw_panel(const CpsResults *results, const Panel *panel, const double range[2],
                       int place, double *point, FILE *out) {
    const CpsiUnit unit = cpsi_unit(panel->unit, fmax(fabs(range[0]), fabs(range[1])));
    CpsiFrame frame = {.left = CPSI_FRAME_LEFT,
                       .top = CPSI_FRAME_TOP + LEGEND + PANEL_PITCH * place,
                       .width = CPSI_FRAME_WIDTH,
                       .height = PANEL_HEIGHT,
                       .x = {0, abscissa(results, results->row_count - 1)},
                       .y = {range[0] * unit.factor, range[1] * unit.factor}};
    cpsi_range_pad(frame.y, 0.06);
    char label[48];
    snprintf(label, sizeof label, "%s (%s)", panel->label, unit.name);
    cpsi_frame_axes(out, &frame, is_over_time(results) ? "time (s)" : "step", label);
    draw_legend(panel, &frame, out);
    if (place == 0 && results->line_count > 1) draw_names(results, &frame, out);
    cpsi_frame_begin(out, &frame, place);
    draw_stages(results, &frame, out);
    for (int line = 0; line < lines_drawn(results); ++line)
        for (int curve = 0; curve < CURVES; ++curve)
            draw_curve(results, panel, &frame, unit.factor, line, curve, point, out);
    cpsi_frame_end(out);
}

bool cpsi_picture_over_steps(const CpsResults *results, FILE *out) {
    double *point = calloc((size_t)results->row_count, 2 * sizeof *point), range[PANELS][2];
    bool shown[PANELS];
    if (!point) return false;
    int drawn = 0;
    for (int p = 0; p < PANELS; ++p) {
        value_range(results, &PANEL[p], range[p]);
        /* forces below this share of the tensions are rounding */
        const double least = p == LENGTHS ? 0 : ROUNDING * range[TENSIONS][1];
        shown[p] = range[p][1] - range[p][0] > least;
        drawn += shown[p];
    }
    char subtitle[160];
    snprintf(subtitle, sizeof subtitle,
             "Ends and contact over %d steps  \xC2\xB7  stages end at dotted lines%s",
             results->row_count,
             results->line_count > MAX_LINES ? "  \xC2\xB7  the first 6 lines" : "");
    cpsi_svg_begin(out, CPSI_SHEET_WIDTH, CPSI_FRAME_TOP + LEGEND + PANEL_PITCH * drawn,
                   *results->title ? results->title : "capstan", subtitle);
    for (int p = 0, place = 0; p < PANELS; ++p)
        if (shown[p]) draw_panel(results, &PANEL[p], range[p], place++, point, out);
    cpsi_svg_finish(out);
    free(point);
    return true;
}
