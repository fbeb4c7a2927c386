/* SPDX-License-Identifier: BSD-3-Clause */
/* Tension along the lines: a frame per line, a curve per step, the same scale in all frames. */
#include "io/draw/run/run_picture.h"
#include "io/draw/run/steps.h"

enum { MAX_PANELS = 6 };

static void draw_curve(FILE *out, const CpsiFrame *frame, const CpsiShape *shape, double factor,
                       double width, const char *colour) {
    fprintf(out,
            "<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"%.1f\" stroke-linejoin=\"round\" "
            "points=\"",
            colour, width);
    for (int i = 0; i + 1 < shape->points; ++i) {
        /* a tension belongs to the middle of its interval; the curve still extends to both ends of
         * the line */
        const double middle = 0.5 * (shape->abscissa[i] + shape->abscissa[i + 1]);
        const double at = i == 0                   ? shape->abscissa[0]
                          : i + 2 == shape->points ? shape->abscissa[i + 1]
                                                   : middle;
        fprintf(out, "%.1f,%.1f ", cpsi_frame_x(frame, at),
                cpsi_frame_y(frame, shape->tension[i] * factor));
        if (shape->points == 2)
            fprintf(out, "%.1f,%.1f ", cpsi_frame_x(frame, shape->abscissa[1]),
                    cpsi_frame_y(frame, shape->tension[i] * factor));
    }
    fputs("\"/>\n", out);
}

void cpsi_picture_tension(const CpsResults *results, FILE *out) {
    const int panels = results->line_count < MAX_PANELS ? results->line_count : MAX_PANELS;
    const double height = panels == 1 ? 380 : panels == 2 ? 260 : 190, pitch = height + 72;
    char note[64], subtitle[160], label[128];
    cpsi_step_note(results, note, sizeof note);
    snprintf(subtitle, sizeof subtitle, "Tension along the line%s  \xC2\xB7  %s%s",
             results->line_count > 1 ? "s" : "", note,
             results->line_count > MAX_PANELS ? "  \xC2\xB7  the first 6 lines" : "");
    cpsi_svg_begin(out, CPSI_SHEET_WIDTH, CPSI_FRAME_TOP + pitch * panels,
                   *results->title ? results->title : "capstan", subtitle);

    double range[2];
    cpsi_tension_range(results, range);
    const CpsiUnit unit = cpsi_unit("N", range[1]);
    for (int l = 0; l < panels; ++l) {
        CpsiFrame frame = {.left = CPSI_FRAME_LEFT,
                           .top = CPSI_FRAME_TOP + pitch * l,
                           .width = CPSI_FRAME_WIDTH,
                           .height = height,
                           .x = {0, results->line_length[l]},
                           .y = {range[0] * unit.factor, range[1] * unit.factor}};
        frame.y[1] += 0.05 * (frame.y[1] - frame.y[0]);
        if (frame.y[0] > 0) frame.y[0] -= 0.05 * (frame.y[1] - frame.y[0]);
        snprintf(label, sizeof label, "%.60s: natural length from A to B (m)",
                 results->line_name[l]);
        char y_label[32];
        snprintf(y_label, sizeof y_label, "tension (%s)", unit.name);
        cpsi_frame_axes(out, &frame, label, y_label);
        cpsi_frame_begin(out, &frame, l);
        for (int s = 0; s < results->snapshot_count; ++s)
            draw_curve(out, &frame, &results->snapshot[s].shape[l], unit.factor,
                       cpsi_step_width(results, s), cpsi_step_colour(results, s).hex);
        cpsi_frame_end(out);
        if (l == 0) cpsi_step_list(results, &frame, out);
    }
    cpsi_svg_finish(out);
}
