/* SPDX-License-Identifier: BSD-3-Clause */
/* Ground in plan views and elevations (run_picture.h).
 *
 * In an elevation it is what is below the section of its surface with the paper. From above it
 * fills the frame, with contours at round heights: in each of many small squares a contour is the
 * straight line between the places where the height on two sides is that of the contour. Beyond the
 * edges of a grid that is not extended there is nothing. */
#include <math.h>

#include "io/draw/run/run_picture.h"

static const char FILL[] = "#efe7d6", EDGE[] = "#b9a67c", SEEN_FROM_ABOVE[] = "#faf7f0",
                  CONTOUR[] = "#d9c9a3", TEXT[] = "#9a8350";

enum { SECTION = 240, SQUARES = CPSI_SQUARES, CONTOURS = 12 };
/* Up must be so nearly z that heights are seen as such. */
static const double UPRIGHT = 0.99;

/* [m] Height at a place of the plan; NaN where there is none. */
static double height_at(const CpsObstacle *o, Vec3 x) {
    const CpsGroundGrid grid = cps_ground_grid(o->ground);
    const double a = x.x - o->point[0], b = x.y - o->point[1];
    if (!grid.extends && !(a >= grid.x[0] && a <= grid.x[grid.x_count - 1] && b >= grid.y[0] &&
                           b <= grid.y[grid.y_count - 1]))
        return NAN;
    return cps_ground_height(o->ground, a, b, NULL) + o->point[2];
}

/* The place at (a, b) of the paper, at coordinate c towards the eye. */
static Vec3 place_of(const CpsiView *view, double a, double b, double c) {
    return vec3_axpy(a, view->right, vec3_axpy(b, view->up, vec3_scale(c, view->toward)));
}

static void draw_section(const CpsObstacle *o, const CpsiView *view, const CpsiFrame *frame,
                         FILE *out) {
    double first = NAN, last = NAN;
    for (int i = 0; i <= SECTION; ++i) {
        const double a = frame->x[0] + (frame->x[1] - frame->x[0]) * i / SECTION;
        const double z = height_at(o, place_of(view, a, 0, view->cut)) * view->up.z;
        if (isnan(z)) continue;
        const double px = cpsi_frame_x(frame, a),
                     py = cpsi_frame_y(frame, fmin(frame->y[1], fmax(frame->y[0], z)));
        if (isnan(first)) {
            first = px;
            fprintf(out, "<polygon fill=\"%s\" stroke=\"%s\" points=\"", FILL, EDGE);
        }
        fprintf(out, "%.1f,%.1f ", px, py);
        last = px;
    }
    const double bottom = cpsi_frame_y(frame, frame->y[0]);
    if (!isnan(first)) fprintf(out, "%.1f,%.1f %.1f,%.1f\"/>\n", last, bottom, first, bottom);
}

static CpsiRelief relief_of(const CpsObstacle *o, const CpsiView *view, const CpsiFrame *frame) {
    CpsiRelief relief = {.low = INFINITY, .high = -INFINITY};
    for (int j = 0; j <= SQUARES; ++j)
        for (int i = 0; i <= SQUARES; ++i) {
            const double a = frame->x[0] + (frame->x[1] - frame->x[0]) * i / SQUARES,
                         b = frame->y[0] + (frame->y[1] - frame->y[0]) * j / SQUARES;
            const double z = relief.z[j][i] = height_at(o, place_of(view, a, b, 0));
            relief.low = fmin(relief.low, z); /* NaN is ignored */
            relief.high = fmax(relief.high, z);
        }
    return relief;
}

/* The contour of one height, as a path of short lines. */
static void draw_contour(const CpsiRelief *relief, double height, const CpsiFrame *frame,
                         FILE *out) {
    static const int CORNER[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
    const double wide = (frame->x[1] - frame->x[0]) / SQUARES,
                 high = (frame->y[1] - frame->y[0]) / SQUARES;
    fprintf(out, "<path fill=\"none\" stroke=\"%s\" d=\"", CONTOUR);
    for (int j = 0; j < SQUARES; ++j)
        for (int i = 0; i < SQUARES; ++i) {
            int found = 0;
            for (int side = 0; side < 4; ++side) {
                const int *p = CORNER[side], *q = CORNER[side + 1];
                const double at = relief->z[j + p[1]][i + p[0]] - height,
                             next = relief->z[j + q[1]][i + q[0]] - height;
                if (isnan(at) || isnan(next) || (at < 0) == (next < 0)) continue;
                const double t = at / (at - next),
                             a = frame->x[0] + wide * (i + p[0] + t * (q[0] - p[0])),
                             b = frame->y[0] + high * (j + p[1] + t * (q[1] - p[1]));
                fprintf(out, "%s%.1f,%.1f", found++ % 2 ? "L" : "M", cpsi_frame_x(frame, a),
                        cpsi_frame_y(frame, b));
            }
        }
    fputs("\"/>\n", out);
}

/* 1, 2 or 5 times a power of ten, so that there are at most CONTOURS. */
static double interval_of(double range) {
    const double least = range / CONTOURS, unit = pow(10, floor(log10(least)));
    return unit * (least <= unit ? 1 : least <= 2 * unit ? 2 : least <= 5 * unit ? 5 : 10);
}

void cpsi_picture_contours(const CpsiRelief *relief, const CpsiFrame *frame, FILE *out) {
    const double left = cpsi_frame_x(frame, frame->x[0]), top = cpsi_frame_y(frame, frame->y[1]);
    const double range = relief->high - relief->low;
    if (!(range > 1e-9 * (fabs(relief->low) + fabs(relief->high)))) return; /* level, or nothing */
    const double interval = interval_of(range);
    for (double k = ceil(relief->low / interval); k * interval <= relief->high; ++k)
        draw_contour(relief, k * interval, frame, out);
    char label[64];
    snprintf(label, sizeof label, "contours every %.3g m", interval);
    char style[64];
    snprintf(style, sizeof style, "fill=\"%s\" font-size=\"11\"", TEXT);
    cpsi_svg_text(out, left + 8, top + 16, CPSI_START, style, label);
}

static void draw_plan(const CpsObstacle *o, const CpsiView *view, const CpsiFrame *frame,
                      FILE *out) {
    const double left = cpsi_frame_x(frame, frame->x[0]), top = cpsi_frame_y(frame, frame->y[1]);
    fprintf(out, "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\"/>\n", left,
            top, cpsi_frame_x(frame, frame->x[1]) - left, cpsi_frame_y(frame, frame->y[0]) - top,
            SEEN_FROM_ABOVE);
    const CpsiRelief relief = relief_of(o, view, frame);
    cpsi_picture_contours(&relief, frame, out);
}

void cpsi_picture_ground(const CpsObstacle *ground, const CpsiView *view, const CpsiFrame *frame,
                         FILE *out) {
    if (view->plan) {
        if (fabs(view->toward.z) > UPRIGHT) draw_plan(ground, view, frame, out);
    } else if (fabs(view->up.z) > UPRIGHT) {
        draw_section(ground, view, frame, out);
    }
}
