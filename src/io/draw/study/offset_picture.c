/* SPDX-License-Identifier: BSD-3-Clause */
/* Restoring force and largest tension over the offset of a body: a frame each, a colour for each
 * heading, the way back dashed. Places that are not certified are left out. */
#include "io/draw/study/offset_picture.h"

#include <math.h>

#include "io/draw/diagram.h"

enum { RESTORING, TENSION, PANELS };
enum { SHEET_WIDTH = 960, LEFT = 84, TOP = 108, WIDTH = 740 };
enum { PANEL_HEIGHT = 260, PANEL_PITCH = 340, NAMES = 18 };

typedef struct OffsetPanel {
    const char *label;
    double (*value)(const CpsOffsetPlace *place);
} OffsetPanel;

static double restoring(const CpsOffsetPlace *place) { return place->restoring; }
static double tension(const CpsOffsetPlace *place) { return place->tension; }

static const OffsetPanel PANEL[PANELS] = {{"restoring force", restoring},
                                          {"largest tension", tension}};

static CpsiColour colour_of(const CpsOffsets *offsets, int curve) {
    return cpsi_colour(CPSI_SCALE_TENSION,
                       offsets->curve_count > 1 ? (curve + 0.5) / offsets->curve_count : 0.5);
}

static void ranges(const CpsOffsets *offsets, const OffsetPanel *panel, double x[2], double y[2]) {
    x[0] = x[1] = y[0] = y[1] = 0;
    for (int k = 0; k < offsets->curve_count; ++k)
        for (int i = 0; i < offsets->curve[k].count; ++i) {
            const CpsOffsetPlace *place = &offsets->curve[k].place[i];
            cpsi_range_include(x, place->offset);
            if (place->certified) cpsi_range_include(y, panel->value(place));
        }
}

/* The pieces between two certified places next to each other. */
static void draw_curve(const CpsOffsetCurve *curve, const OffsetPanel *panel,
                       const CpsiFrame *frame, double factor, const char *colour, FILE *out) {
    for (int i = 1; i < curve->count; ++i) {
        const CpsOffsetPlace *from = &curve->place[i - 1], *to = &curve->place[i];
        if (!from->certified || !to->certified) continue;
        const double point[4] = {from->offset, factor * panel->value(from), to->offset,
                                 factor * panel->value(to)};
        char style[120];
        snprintf(style, sizeof style, "fill=\"none\" stroke=\"%s\" stroke-width=\"1.6\"%s", colour,
                 to->offset < from->offset ? " stroke-dasharray=\"5 3\"" : "");
        cpsi_draw_curve(out, frame, 2, point, false, style);
    }
}

/* The headings in their colours, at the right of the frame, as many as there is room for. */
static void draw_headings(const CpsOffsets *offsets, const CpsiFrame *frame, FILE *out) {
    const int room = (int)(frame->height / NAMES), count = offsets->curve_count;
    const int every = (count + room - 1) / room;
    for (int k = 0, row = 0; k < count; k += every, ++row) {
        char text[48], style[64];
        snprintf(text, sizeof text, "%.6g\xC2\xB0", offsets->curve[k].heading);
        snprintf(style, sizeof style, "font-size=\"12\" fill=\"%s\"", colour_of(offsets, k).hex);
        cpsi_svg_text(out, frame->left + frame->width + 10, frame->top + 12 + NAMES * row,
                      CPSI_START, style, text);
    }
}

static void draw_legend(const CpsiFrame *frame, FILE *out) {
    double x = frame->left;
    cpsi_legend(out, &x, frame->top - 10,
                "<path d=\"M-11 0H11\" stroke=\"#444\" stroke-width=\"1.6\"/>", "out");
    cpsi_legend(out, &x, frame->top - 10,
                "<path d=\"M-11 0H11\" stroke=\"#444\" stroke-width=\"1.6\" "
                "stroke-dasharray=\"5 3\"/>",
                "back");
}

void cpsi_picture_offsets(const CpsOffsets *offsets, FILE *out) {
    char subtitle[160];
    snprintf(subtitle, sizeof subtitle,
             "What its lines oppose to an offset of %.60s  \xC2\xB7  headings from x towards y",
             offsets->body);
    cpsi_svg_begin(out, SHEET_WIDTH, TOP + PANEL_PITCH * PANELS,
                   offsets->title && *offsets->title ? offsets->title : "capstan", subtitle);
    for (int p = 0; p < PANELS; ++p) {
        double x[2], y[2];
        ranges(offsets, &PANEL[p], x, y);
        const CpsiUnit unit = cpsi_unit("N", fmax(fabs(y[0]), fabs(y[1])));
        CpsiFrame frame = {.left = LEFT,
                           .top = TOP + PANEL_PITCH * p,
                           .width = WIDTH,
                           .height = PANEL_HEIGHT,
                           .x = {x[0], x[1]},
                           .y = {y[0] * unit.factor, y[1] * unit.factor}};
        cpsi_range_pad(frame.x, 0.02);
        cpsi_range_pad(frame.y, 0.06);
        char label[64];
        snprintf(label, sizeof label, "%s (%s)", PANEL[p].label, unit.name);
        cpsi_frame_axes(out, &frame, "offset (m)", label);
        draw_legend(&frame, out);
        if (p == 0) draw_headings(offsets, &frame, out);
        cpsi_frame_begin(out, &frame, p);
        for (int k = 0; k < offsets->curve_count; ++k)
            draw_curve(&offsets->curve[k], &PANEL[p], &frame, unit.factor,
                       colour_of(offsets, k).hex, out);
        cpsi_frame_end(out);
    }
    cpsi_svg_finish(out);
}
