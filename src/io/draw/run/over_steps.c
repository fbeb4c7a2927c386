/* SPDX-License-Identifier: BSD-3-Clause */
/* Poses of bodies, tensions and uplift at the ends, grounded and slipping length, over the steps of
 * the history: a frame for each direction in which a body moves, and for each pair of quantities of
 * lines; a colour for each body or line. Steps that are not certified are left out. */
#include <math.h>
#include <stdlib.h>

#include "io/base/text/escape.h"
#include "io/draw/diagram.h"
#include "io/draw/run/run_picture.h"

static const double ROUNDING = 1e-9;
/* Bodies do not move in a direction in which they move less than this share of their largest
 * displacement or rotation. */
static const double FAINT = 1e-6;

enum { SURGE, SWAY, HEAVE, ROLL, PITCH, YAW, TENSIONS, UPLIFT, LENGTHS, PANELS };
enum { MOST = 6, CURVES = 2 };
/* in pixels: of a body and of a line; above a frame with a legend and without, and below one */
enum { BODY_HEIGHT = 150, LINE_HEIGHT = 190, LEGEND = 24, GAP = 8, AXIS = 42 };

static const char *const COLOUR[MOST] = {CPSI_BLUE, CPSI_ORANGE, CPSI_PLUM,
                                         "#3f8f5f", "#7a5fb0",   "#5a5a5a"};
/* solid, dashed */
static const char *const DASHES[CURVES] = {"", " stroke-dasharray=\"5 3\""};

/* What is drawn in one frame of every line, a pair of quantities, or of every body, one. */
typedef struct Panel {
    const char *label, *unit;
    const char *curve[CURVES];                               /* NULL of bodies */
    double (*value)(const CpsLineReport *report, int curve); /* NAN where it is not known */
} Panel;

static double tension(const CpsLineReport *report, int curve) { return report->end[curve].tension; }

static double uplift(const CpsLineReport *report, int curve) { return report->end[curve].uplift; }

static double length(const CpsLineReport *report, int curve) {
    if (curve == 0) return report->grounded;
    return report->has_slipping ? report->slipping : NAN;
}

static const Panel PANEL[PANELS] = {
    [SURGE] = {.label = "surge x", .unit = "m"},
    [SWAY] = {.label = "sway y", .unit = "m"},
    [HEAVE] = {.label = "heave z", .unit = "m"},
    [ROLL] = {.label = "roll", .unit = "degrees"},
    [PITCH] = {.label = "pitch", .unit = "degrees"},
    [YAW] = {.label = "yaw", .unit = "degrees"},
    [TENSIONS] = {"tension", "N", {"end A", "end B"}, tension},
    [UPLIFT] = {"uplift", "N", {"end A", "end B"}, uplift},
    [LENGTHS] = {"length", "m", {"grounded", "slipping"}, length},
};

static bool is_of_bodies(int panel) { return panel < TENSIONS; }

static int curves_of(int panel) { return is_of_bodies(panel) ? 1 : CURVES; }

/* How many lines or bodies are drawn in a panel. */
static int count_drawn(const CpsResults *results, int panel) {
    const int count = is_of_bodies(panel) ? results->body_count : results->line_count;
    return count < MOST ? count : MOST;
}

static const char *name_of(const CpsResults *results, int panel, int which) {
    return is_of_bodies(panel) ? results->body[which].name : results->line_name[which];
}

/* [m] from where the body begins, or [degrees] */
static double pose(const CpsResults *results, int direction, int body, int row) {
    const CpsiBodyRow *at = &results->row[row].body[body];
    return direction < ROLL
               ? at->report.position[direction] - results->body[body].position[direction]
               : at->angle[direction - ROLL];
}

/* The value of a curve at a row, NAN where nothing is drawn. */
static double value_at(const CpsResults *results, int panel, int which, int curve, int row) {
    if (is_of_bodies(panel))
        return cps_outcome_is_certified(results->row[row].report.outcome)
                   ? pose(results, panel, which, row)
                   : NAN;
    const CpsLineReport *report = &results->row[row].line[which].report;
    return cps_outcome_is_certified(report->outcome) ? PANEL[panel].value(report, curve) : NAN;
}

/* The range of a panel's values, of lines with 0. */
static void value_range(const CpsResults *results, int panel, double range[2]) {
    range[0] = is_of_bodies(panel) ? INFINITY : 0;
    range[1] = -range[0];
    for (int row = 0; row < results->row_count; ++row)
        for (int which = 0; which < count_drawn(results, panel); ++which)
            for (int curve = 0; curve < curves_of(panel); ++curve) {
                const double value = value_at(results, panel, which, curve, row);
                if (isfinite(value)) cpsi_range_include(range, value);
            }
}

/* The size of a range that is worth a frame is above this. */
static double least_range(const CpsResults *results, int panel, double range[PANELS][2]) {
    /* forces below this share of the tensions are rounding */
    if (panel == UPLIFT || panel == TENSIONS) return ROUNDING * range[TENSIONS][1];
    if (panel == LENGTHS) return 0;
    const int first = panel < ROLL ? SURGE : ROLL;
    double most = 0, longest = 0;
    for (int k = first; k < first + 3; ++k) most = fmax(most, range[k][1] - range[k][0]);
    for (int i = 0; i < results->line_count; ++i) longest = fmax(longest, results->line_length[i]);
    return fmax(FAINT * most, ROUNDING * (first == SURGE ? longest : 180));
}

/* Of a history in time the abscissa is the time, which stands still in quasi-static steps. */
static bool is_over_time(const CpsResults *results) {
    return results->row_count > 0 && results->row[results->row_count - 1].motion.time > 0;
}

static double abscissa(const CpsResults *results, int row) {
    return is_over_time(results) ? results->row[row].motion.time : row;
}

/* A piece of a curve; one point is a dot. */
static void draw_piece(const CpsiFrame *frame, int which, int curve, int count, const double *point,
                       FILE *out) {
    char style[120];
    if (count == 1) {
        snprintf(style, sizeof style, "fill=\"%s\"", COLOUR[which]);
        cpsi_draw_dot(out, frame, point, 2.5, style);
    } else if (count > 1) {
        snprintf(style, sizeof style, "fill=\"none\" stroke=\"%s\" stroke-width=\"1.6\"%s",
                 COLOUR[which], DASHES[curve]);
        cpsi_draw_curve(out, frame, count, point, false, style);
    }
}

/* A curve, in pieces between steps without a value, and where an angle goes on from 180 degrees at
 * -180; `point` is work space for all rows. */
static void draw_curve(const CpsResults *results, int panel, const CpsiFrame *frame, double factor,
                       int which, int curve, double *point, FILE *out) {
    const bool is_angle = panel >= ROLL && panel <= YAW;
    int count = 0;
    for (int row = 0; row < results->row_count; ++row) {
        const double value = factor * value_at(results, panel, which, curve, row);
        if (!isfinite(value) ||
            (is_angle && count > 0 && fabs(value - point[2 * count - 1]) > 180)) {
            draw_piece(frame, which, curve, count, point, out);
            count = 0;
        }
        if (!isfinite(value)) continue;
        point[2 * count] = abscissa(results, row);
        point[2 * count++ + 1] = value;
    }
    draw_piece(frame, which, curve, count, point, out);
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
    for (int curve = 0; curve < CURVES && panel->curve[curve]; ++curve) {
        char mark[120];
        snprintf(mark, sizeof mark,
                 "<path d=\"M-11 0H11\" stroke=\"#444\" stroke-width=\"1.6\"%s/>", DASHES[curve]);
        cpsi_legend(out, &x, frame->top - 10, mark, panel->curve[curve]);
    }
}

/* The names of the lines or bodies in their colours, at the right of the frame. */
static void draw_names(const CpsResults *results, int panel, const CpsiFrame *frame, FILE *out) {
    for (int which = 0; which < count_drawn(results, panel); ++which) {
        char text[48], style[64];
        const char *name = name_of(results, panel, which);
        snprintf(text, sizeof text, "%.*s", (int)cpsi_utf8_cut(name, 16), name);
        snprintf(style, sizeof style, "font-size=\"12\" fill=\"%s\"", COLOUR[which]);
        cpsi_svg_text(out, frame->left + frame->width + 10, frame->top + 12 + 16 * which,
                      CPSI_START, style, text);
    }
}

static double height_of(int panel) { return is_of_bodies(panel) ? BODY_HEIGHT : LINE_HEIGHT; }

static double above(int panel) { return is_of_bodies(panel) ? GAP : LEGEND; }

/* A panel below `top`; `id` differs from that of others. */
static void draw_panel(const CpsResults *results, int panel, const double range[2], double top,
                       int id, bool names, double *point, FILE *out) {
    const CpsiUnit unit = cpsi_unit(PANEL[panel].unit, fmax(fabs(range[0]), fabs(range[1])));
    CpsiFrame frame = {.left = CPSI_FRAME_LEFT,
                       .top = top + above(panel),
                       .width = CPSI_FRAME_WIDTH,
                       .height = height_of(panel),
                       .x = {0, abscissa(results, results->row_count - 1)},
                       .y = {range[0] * unit.factor, range[1] * unit.factor}};
    cpsi_range_pad(frame.y, 0.06);
    char label[48];
    snprintf(label, sizeof label, "%s (%s)", PANEL[panel].label, unit.name);
    cpsi_frame_axes(out, &frame, is_over_time(results) ? "time (s)" : "step", label);
    draw_legend(&PANEL[panel], &frame, out);
    if (names) draw_names(results, panel, &frame, out);
    cpsi_frame_begin(out, &frame, id);
    draw_stages(results, &frame, out);
    for (int which = 0; which < count_drawn(results, panel); ++which)
        for (int curve = 0; curve < curves_of(panel); ++curve)
            draw_curve(results, panel, &frame, unit.factor, which, curve, point, out);
    cpsi_frame_end(out);
}

bool cpsi_picture_over_steps(const CpsResults *results, FILE *out) {
    double *point = calloc((size_t)results->row_count, 2 * sizeof *point), range[PANELS][2];
    bool shown[PANELS], bodies = false;
    if (!point) return false;
    double height = CPSI_FRAME_TOP + LEGEND;
    for (int p = 0; p < PANELS; ++p) value_range(results, p, range[p]);
    for (int p = 0; p < PANELS; ++p) {
        shown[p] = range[p][1] - range[p][0] > least_range(results, p, range);
        if (shown[p]) height += above(p) + height_of(p) + AXIS;
        bodies = bodies || (shown[p] && is_of_bodies(p));
    }
    char subtitle[160];
    snprintf(subtitle, sizeof subtitle,
             "%s over %d steps  \xC2\xB7  stages end at dotted lines%s%s",
             bodies ? "Bodies, ends and contact" : "Ends and contact", results->row_count,
             results->line_count > MOST ? "  \xC2\xB7  the first 6 lines" : "",
             results->body_count > MOST ? "  \xC2\xB7  the first 6 bodies" : "");
    cpsi_svg_begin(out, CPSI_SHEET_WIDTH, height, *results->title ? results->title : "capstan",
                   subtitle);
    double top = CPSI_FRAME_TOP;
    bool named[2] = {false, results->line_count < 2}; /* bodies, lines */
    for (int p = 0, place = 0; p < PANELS; ++p) {
        if (!shown[p]) continue;
        const int kind = is_of_bodies(p) ? 0 : 1;
        draw_panel(results, p, range[p], top, place++, !named[kind], point, out);
        named[kind] = true;
        top += above(p) + height_of(p) + AXIS;
    }
    cpsi_svg_finish(out);
    free(point);
    return true;
}
