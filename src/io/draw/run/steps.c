/* SPDX-License-Identifier: BSD-3-Clause */
/* The steps of a run in a picture (see steps.h). */
#include "io/draw/run/steps.h"

#include <math.h>

#include "io/base/text/escape.h"

enum { LISTED_STEPS = 14 };

void cpsi_tension_range(const CpsResults *results, double range[2]) {
    range[0] = INFINITY;
    range[1] = -INFINITY;
    for (int s = 0; s < results->snapshot_count; ++s)
        for (int l = 0; l < results->line_count; ++l)
            for (int i = 0; i + 1 < results->snapshot[s].shape[l].points; ++i)
                cpsi_range_include(range, results->snapshot[s].shape[l].tension[i]);
    if (!(range[1] >= range[0])) range[0] = range[1] = 0;
    /* the scale begins at zero, unless that would leave much of it unused */
    if (range[0] < 0.25 * range[1]) range[0] = 0;
    if (!(range[1] - range[0] > 1e-6 * range[1])) range[0] = 0;
    if (range[1] <= 0) range[1] = 1;
}

CpsiColour cpsi_step_colour(const CpsResults *results, int snapshot) {
    const int count = results->snapshot_count;
    return cpsi_colour(CPSI_SCALE_STEP, count > 1 ? (double)snapshot / (count - 1) : 1);
}

double cpsi_step_width(const CpsResults *results, int snapshot) {
    const int count = results->snapshot_count;
    return count < 2 || count > LISTED_STEPS ? 1.6
                                             : 1.6 + 5.0 * (count - 1 - snapshot) / (count - 1);
}

void cpsi_step_note(const CpsResults *results, char *out, size_t size) {
    if (results->snapshot_count == results->row_count)
        snprintf(out, size, "%d step%s", results->row_count, results->row_count == 1 ? "" : "s");
    else
        snprintf(out, size, "%d steps, %d of them drawn", results->row_count,
                 results->snapshot_count);
}

void cpsi_step_list(const CpsResults *results, const CpsiFrame *frame, FILE *out) {
    const double x = frame->left + frame->width + 18;
    if (results->snapshot_count > LISTED_STEPS) {
        cpsi_frame_bar(out, frame, CPSI_SCALE_STEP, 0, results->row_count - 1, "step");
        return;
    }
    for (int s = 0; s < results->snapshot_count; ++s) {
        const double y = frame->top + 10 + 18 * s;
        char name[20];
        const CpsiRow *row = &results->row[results->snapshot[s].step];
        snprintf(name, sizeof name, "%.*s", (int)cpsi_utf8_cut(row->name, 15), row->name);
        fprintf(out,
                "<line x1=\"%.1f\" x2=\"%.1f\" y1=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" "
                "stroke-width=\"3\"/>",
                x, x + 16, y - 4, y - 4, cpsi_step_colour(results, s).hex);
        cpsi_svg_text(out, x + 22, y, CPSI_START, "font-size=\"11\"", name);
    }
}
