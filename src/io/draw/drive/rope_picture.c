/* SPDX-License-Identifier: BSD-3-Clause */
/* A rope on a table: its shape with the velocity field and the parts at rest, the tension along it,
 * and a strip of shapes along its path. */
#include <math.h>
#include <stdlib.h>

#include "base/status.h"
#include "capstan/results.h"
#include "io/draw/diagram.h"

enum { LEFT = 84, TOP = 96, SHAPE = 460, HEIGHT = 380, GAP = 130, STRIP = 190, ARROWS = 24 };

/* Nodes slower than this share of the fastest one are at rest. */
static const double REST = 1e-6;

typedef struct RopePicture {
    const CpsDriveFile *file;
    const CpsDriveRope *rope;
    const CpsMotion *motion;
    int count;
    const double *shot;
} RopePicture;

static double fastest(const RopePicture *p) {
    const double *v = cps_motion_velocity(p->motion);
    double most = 0;
    for (int i = 0; i < p->rope->rope.node_count; i++)
        most = fmax(most, hypot(v[2 * i], v[2 * i + 1]));
    return most;
}

static void draw_shape(FILE *out, const RopePicture *p) {
    const CpsRope *rope = &p->rope->rope;
    const double *v = cps_motion_velocity(p->motion), most = fastest(p);
    CpsiFrame frame = {.left = LEFT, .top = TOP, .width = SHAPE, .height = HEIGHT};
    frame.x[0] = frame.y[0] = INFINITY;
    frame.x[1] = frame.y[1] = -INFINITY;
    cpsi_range_points(frame.x, frame.y, rope->node_count, rope->node);
    const double size = fmax(frame.x[1] - frame.x[0], frame.y[1] - frame.y[0]),
                 unit = most > 0 ? 0.22 * size / most : 0;
    for (int i = 0; i < rope->node_count; i++) {
        const double tip[2] = {rope->node[2 * i] + unit * v[2 * i],
                               rope->node[2 * i + 1] + unit * v[2 * i + 1]};
        cpsi_range_points(frame.x, frame.y, 1, tip);
    }
    cpsi_range_pad(frame.x, 0.06);
    cpsi_range_pad(frame.y, 0.06);
    cpsi_frame_equal(&frame);
    cpsi_frame_title(out, &frame, "velocities; grey: resting");
    cpsi_frame_axes(out, &frame, "x (m)", "y (m)");
    cpsi_frame_begin(out, &frame, 1);
    cpsi_draw_curve(out, &frame, rope->node_count, rope->node, false,
                    "fill=\"none\" stroke=\"#bbb\" stroke-width=\"5\"");
    /* runs of sliding nodes */
    for (int i = 0; i < rope->node_count;) {
        int end = i;
        while (end < rope->node_count && hypot(v[2 * end], v[2 * end + 1]) > REST * most) end++;
        if (end > i + 1)
            cpsi_draw_curve(out, &frame, end - i, rope->node + 2 * (size_t)i, false,
                            "fill=\"none\" stroke=\"" CPSI_BLUE "\" stroke-width=\"5\"");
        i = end + 1;
    }
    for (int k = 0; k <= ARROWS; k++) {
        const int i = (int)((long long)(rope->node_count - 1) * k / ARROWS);
        const double along[2] = {unit * v[2 * i], unit * v[2 * i + 1]};
        cpsi_draw_arrow(out, &frame, rope->node + 2 * (size_t)i, along, CPSI_PLUM, 1.3);
    }
    for (int k = 0; k < 2; k++)
        if (rope->driven[k])
            cpsi_draw_dot(out, &frame, rope->node + (k ? 2 * (size_t)(rope->node_count - 1) : 0),
                          4.5, "fill=\"#fff\" stroke=\"#333\" stroke-width=\"1.6\"");
    cpsi_frame_end(out);
}

static CpsStatus draw_tension(FILE *out, const RopePicture *p, CpsError *err) {
    const CpsRope *rope = &p->rope->rope;
    double *point = malloc(2 * (size_t)rope->node_count * sizeof *point), along = 0;
    if (!point) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    CpsiFrame frame = {.left = LEFT + SHAPE + GAP,
                       .top = TOP,
                       .width = SHAPE - 100,
                       .height = HEIGHT,
                       .y = {0, 0}};
    for (int i = 0; i + 1 < rope->node_count; i++) {
        const double *x = rope->node + 2 * (size_t)i, length = hypot(x[2] - x[0], x[3] - x[1]);
        point[2 * i] = along + 0.5 * length;
        along += length;
        point[2 * i + 1] = fmax(-cps_motion_law_force(p->motion, rope->node_count + i)[0], 0);
    }
    frame.x[1] = along;
    cpsi_range_points(frame.x, frame.y, rope->node_count - 1, point);
    cpsi_range_pad(frame.y, 0.06);
    frame.y[0] = fmin(frame.y[0], 0);
    cpsi_frame_title(out, &frame, "tension");
    cpsi_frame_axes(out, &frame, "along the rope, from end A (m)", "tension (N)");
    cpsi_frame_begin(out, &frame, 2);
    cpsi_draw_curve(out, &frame, rope->node_count - 1, point, false,
                    "fill=\"none\" stroke=\"" CPSI_BLUE "\" stroke-width=\"2\"");
    cpsi_frame_end(out);
    free(point);
    return CPS_OK;
}

/* shapes side by side with the same scale, each over the preceding ones in pale colours */
static void draw_strip(FILE *out, const RopePicture *p, double width) {
    const size_t nodes = (size_t)p->rope->rope.node_count;
    const int columns = p->count < 6 ? p->count : 6;
    const double side = (width - 14.0 * (columns - 1)) / columns;
    double x[2] = {INFINITY, -INFINITY}, y[2] = {INFINITY, -INFINITY};
    char text[48];
    cpsi_range_points(x, y, p->count * (int)nodes, p->shot);
    cpsi_range_points(x, y, p->rope->point_count, p->rope->path);
    cpsi_range_pad(x, 0.06);
    cpsi_range_pad(y, 0.06);
    for (int k = 0; k < p->count; k++) {
        const int row = k / columns;
        CpsiFrame frame = {.left = LEFT + (side + 14) * (k % columns),
                           .top = TOP + HEIGHT + 90 + (STRIP + 30) * (double)row,
                           .width = side,
                           .height = STRIP,
                           .x = {x[0], x[1]},
                           .y = {y[0], y[1]}};
        cpsi_frame_equal(&frame);
        fprintf(out,
                "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%d\" fill=\"#fbfbfb\" "
                "stroke=\"#ccc\"/>\n",
                frame.left, frame.top, side, (int)STRIP);
        cpsi_frame_begin(out, &frame, 10 + k);
        cpsi_draw_curve(out, &frame, p->rope->point_count, p->rope->path, false,
                        "fill=\"none\" stroke=\"" CPSI_PLUM
                        "\" stroke-width=\"1\" stroke-dasharray=\"3 3\"");
        for (int before = 0; before < k; before++)
            cpsi_draw_curve(out, &frame, (int)nodes, p->shot + (size_t)before * 2 * nodes, false,
                            "fill=\"none\" stroke=\"#d5dbe6\" stroke-width=\"1.2\"");
        cpsi_draw_curve(out, &frame, (int)nodes, p->shot + (size_t)k * 2 * nodes, false,
                        "fill=\"none\" stroke=\"" CPSI_BLUE "\" stroke-width=\"2.4\"");
        cpsi_draw_dot(out, &frame, p->shot + (size_t)(k + 1) * 2 * nodes - 2, 3.5,
                      "fill=\"" CPSI_PLUM "\"");
        cpsi_frame_end(out);
        snprintf(text, sizeof text, k ? "%.0f %% of the path" : "start",
                 p->count > 1 ? 100.0 * k / (p->count - 1) : 0);
        cpsi_svg_text(out, frame.left + 6, frame.top + STRIP + 16, CPSI_START,
                      "font-size=\"11\" fill=\"#555\"", text);
    }
}

static CpsStatus draw_rope(void *what, FILE *out, CpsError *err) {
    const RopePicture *p = what;
    const CpsMotionReport r = cps_motion_report(p->motion);
    const double width = 2 * SHAPE - 100 + GAP;
    const int rows = p->count > 1 ? (p->count + 5) / 6 : 0;
    char text[160];
    snprintf(text, sizeof text,
             "heavy inextensible rope on a rough table; least dissipation %.6g W", r.value);
    cpsi_svg_begin(out, LEFT + width + 40,
                   TOP + HEIGHT + 60 + rows * (STRIP + 30.0) + (rows ? 30 : 0),
                   *p->file->title ? p->file->title : "rope on a table", text);
    draw_shape(out, p);
    const CpsStatus status = draw_tension(out, p, err);
    if (status == CPS_OK && rows) draw_strip(out, p, width);
    cpsi_svg_finish(out);
    return status;
}

CpsStatus cps_drive_draw_rope(const CpsDriveFile *file, const CpsMotion *motion, int count,
                              const double *shots, FILE *out, CpsError *err) {
    if (!file || file->kind != CPS_DRIVE_ROPE || !motion)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the file holds no rope, or there is no motion");
    const CpsMotionOutcome outcome = cps_motion_report(motion).outcome;
    if (outcome == CPS_MOTION_OUTCOME_BLOCKED || outcome == CPS_MOTION_OUTCOME_NO_BALANCE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "nothing to draw: %s",
                         cps_motion_outcome_text(outcome));
    RopePicture picture = {file, &file->rope, motion, shots ? count : 0, shots};
    return cpsi_draw_plain(draw_rope, &picture, out, err);
}
