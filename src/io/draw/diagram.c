/* SPDX-License-Identifier: BSD-3-Clause */
/* Parts shared by pictures (diagram.h). */
#include "io/draw/diagram.h"

#include <math.h>

#include "base/math.h"
#include "base/status.h"
#include "io/base/text/numbers.h"

void cpsi_frame_equal(CpsiFrame *f) {
    const double sx = (f->x[1] - f->x[0]) / f->width, sy = (f->y[1] - f->y[0]) / f->height;
    double *const range = sx < sy ? f->x : f->y;
    const double middle = 0.5 * (range[0] + range[1]),
                 half = 0.5 * fmax(sx, sy) * (sx < sy ? f->width : f->height);
    range[0] = middle - half;
    range[1] = middle + half;
}

void cpsi_range_points(double x[2], double y[2], int count, const double *point) {
    for (int i = 0; i < count; i++) {
        cpsi_range_include(x, point[2 * i]);
        cpsi_range_include(y, point[2 * i + 1]);
    }
}

void cpsi_draw_curve(FILE *out, const CpsiFrame *frame, int count, const double *point, bool closed,
                     const char *style) {
    fprintf(out, "<%s %s stroke-linejoin=\"round\" points=\"", closed ? "polygon" : "polyline",
            style);
    double lx = INFINITY, ly = INFINITY;
    for (int i = 0; i < count; i++) {
        const double x = cpsi_frame_x(frame, point[2 * i]),
                     y = cpsi_frame_y(frame, point[2 * i + 1]);
        if (fabs(x - lx) + fabs(y - ly) < 0.5 && i + 1 < count) continue;
        fprintf(out, "%.1f,%.1f ", x, y);
        lx = x;
        ly = y;
    }
    fputs("\"/>\n", out);
}

void cpsi_draw_arrow(FILE *out, const CpsiFrame *frame, const double from[2], const double along[2],
                     const char *colour, double width) {
    const double x0 = cpsi_frame_x(frame, from[0]), y0 = cpsi_frame_y(frame, from[1]);
    const double x1 = cpsi_frame_x(frame, from[0] + along[0]),
                 y1 = cpsi_frame_y(frame, from[1] + along[1]);
    const double l = hypot(x1 - x0, y1 - y0), head = fmin(3 + 2.5 * width, 0.6 * l);
    if (!(l > 1)) return;
    const double ux = (x1 - x0) / l, uy = (y1 - y0) / l;
    fprintf(out, "<path d=\"M%.1f %.1fL%.1f %.1f\" stroke=\"%s\" stroke-width=\"%.1f\"/>", x0, y0,
            x1 - 0.7 * head * ux, y1 - 0.7 * head * uy, colour, width);
    fprintf(out, "<path fill=\"%s\" d=\"M%.1f %.1fL%.1f %.1fL%.1f %.1fZ\"/>\n", colour, x1, y1,
            x1 - head * ux - 0.4 * head * uy, y1 - head * uy + 0.4 * head * ux,
            x1 - head * ux + 0.4 * head * uy, y1 - head * uy - 0.4 * head * ux);
}

void cpsi_draw_dot(FILE *out, const CpsiFrame *frame, const double at[2], double radius,
                   const char *style) {
    fprintf(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" %s/>\n", cpsi_frame_x(frame, at[0]),
            cpsi_frame_y(frame, at[1]), radius, style);
}

void cpsi_frame_title(FILE *out, const CpsiFrame *frame, const char *text) {
    cpsi_svg_text(out, frame->left, frame->top - 10, CPSI_START,
                  "font-size=\"13\" fill=\"#1a1a1a\"", text);
}

/* ---- bodies ---- */

/* corners of a patch in its own axes; returns their number */
enum { ROUND = 64 };
static int outline(const CpsPatch *p, double x[2 * ROUND]) {
    if (p->kind == CPS_PATCH_POLYGON) {
        const int n = p->corner_count < ROUND ? p->corner_count : ROUND;
        for (int i = 0; i < 2 * n; i++) x[i] = p->corner[i];
        return n;
    }
    if (p->kind == CPS_PATCH_ROD || p->kind == CPS_PATCH_WHEEL) {
        const double a = p->size, b = p->kind == CPS_PATCH_WHEEL ? 0.35 * p->size : 0.02 * p->size;
        const double box[8] = {-a, -b, a, -b, a, b, -a, b};
        for (int i = 0; i < 8; i++) x[i] = box[i];
        return 4;
    }
    for (int i = 0; i < ROUND; i++) {
        x[2 * i] = p->size * cos(2 * CPSI_PI * i / ROUND);
        x[2 * i + 1] = p->size * sin(2 * CPSI_PI * i / ROUND);
    }
    return ROUND;
}

static void place(const double pose[3], double x[2]) {
    const double c = cos(pose[2]), s = sin(pose[2]), u = x[0], v = x[1];
    x[0] = pose[0] + c * u - s * v;
    x[1] = pose[1] + s * u + c * v;
}

void cpsi_draw_body(FILE *out, const CpsiFrame *frame, const CpsDriveBody *body,
                    const double pose[3], const char *colour, double opacity) {
    char style[160];
    /* a vehicle's wheels are connected by its frame */
    double hub[4][2];
    for (int i = 0; i < body->patch_count; i++) {
        const CpsPatch *p = &body->patch[i];
        const double own[3] = {p->position[0], p->position[1], p->angle};
        double at[2] = {p->position[0], p->position[1]}, x[2 * ROUND];
        place(pose, at);
        if (i < 4) {
            hub[i][0] = at[0];
            hub[i][1] = at[1];
        }
        if (p->kind == CPS_PATCH_POINT) {
            snprintf(style, sizeof style, "fill=\"%s\" opacity=\"%.2f\"", colour, opacity);
            cpsi_draw_dot(out, frame, at, 4, style);
            continue;
        }
        const int n = outline(p, x);
        for (int k = 0; k < n; k++) {
            place(own, x + 2 * k);
            place(pose, x + 2 * k);
        }
        const bool open = p->kind == CPS_PATCH_RING;
        snprintf(style, sizeof style,
                 "fill=\"%s\" fill-opacity=\"%.2f\" stroke=\"%s\" stroke-width=\"%.1f\" "
                 "stroke-opacity=\"%.2f\"",
                 colour, open ? 0 : 0.25 * opacity, colour, open ? 2.5 : 1.2, opacity);
        cpsi_draw_curve(out, frame, n, x, true, style);
    }
    if (!body->vehicle || body->patch_count < 2) return;
    snprintf(style, sizeof style,
             "fill=\"none\" stroke=\"%s\" stroke-width=\"0.8\" stroke-opacity=\"%.2f\"", colour,
             0.7 * opacity);
    const int n = body->patch_count < 4 ? body->patch_count : 4;
    for (int i = 0; i < n; i++)
        for (int k = i + 1; k < n; k++) {
            const double line[4] = {hub[i][0], hub[i][1], hub[k][0], hub[k][1]};
            cpsi_draw_curve(out, frame, 2, line, false, style);
        }
}

CpsStatus cpsi_draw_plain(CpsStatus (*draw)(void *what, FILE *out, CpsError *err), void *what,
                          FILE *out, CpsError *err) {
    if (!what || !out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "file or out is NULL");
    CpsiNumbers numbers;
    if (!cpsi_numbers_begin(&numbers)) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    const CpsStatus status = draw(what, out, err);
    cpsi_numbers_end(&numbers);
    return status;
}
