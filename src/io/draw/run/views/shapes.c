/* SPDX-License-Identifier: BSD-3-Clause */
/* Capsules, tori, cones and boxes in plan views and elevations: the silhouette, as the union of the
 * quadrilaterals of the surface (history.h). A wide outline of all of them is painted first and
 * their fill on top of it, so that the outline of the union is left. */
#include <math.h>

#include "io/draw/run/run_picture.h"

/* [m] How far the cone is shown beyond its tip, along its axis: to the far side of the frame. */
static double end_of(const CpsiFrame *frame) {
    return 2 * hypot(frame->x[1] - frame->x[0], frame->y[1] - frame->y[0]);
}

/* The quadrilateral of a row and a column on paper, its corners in one sense of rotation for all of
 * them, so that where two cover each other nothing is left out. */
static void write_cell(const CpsObstacle *o, double end, const CpsiView *view,
                       const CpsiFrame *frame, int row, int column, FILE *out) {
    static const int DOWN[4] = {0, 0, 1, 1}, ALONG[4] = {0, 1, 1, 0};
    double x[4], y[4], area = 0;
    for (int i = 0; i < 4; ++i) {
        const Vec3 p = cpsi_shape_point(o, end, 0, row + DOWN[i], column + ALONG[i]);
        x[i] = cpsi_frame_x(frame, vec3_dot(view->right, p));
        y[i] = cpsi_frame_y(frame, vec3_dot(view->up, p));
    }
    for (int i = 0; i < 4; ++i) area += x[i] * y[(i + 1) % 4] - x[(i + 1) % 4] * y[i];
    for (int i = 0; i < 4; ++i) {
        const int k = area < 0 ? 3 - i : i;
        fprintf(out, "%c%.1f,%.1f", i ? 'L' : 'M', x[k], y[k]);
    }
    fputs("Z", out);
}

static void write_cells(const CpsObstacle *o, const CpsiView *view, const CpsiFrame *frame,
                        FILE *out) {
    int rows, columns;
    const double end = end_of(frame);
    cpsi_shape_grid(o, &rows, &columns);
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            write_cell(o, end, view, frame, row, column, out);
}

void cpsi_picture_shape(const CpsObstacle *obstacle, const char *fill, const char *edge,
                        const CpsiView *view, const CpsiFrame *frame, FILE *out) {
    const char *const paint[2] = {edge, fill};
    for (int i = 0; i < 2; ++i) {
        fprintf(out,
                "<path fill=\"%s\" stroke=\"%s\" stroke-width=\"%s\" stroke-linejoin=\"round\" "
                "d=\"",
                paint[i], paint[i], i ? "0.4" : "2.4");
        write_cells(obstacle, view, frame, out);
        fputs("\"/>\n", out);
    }
}

void cpsi_shape_extend(const CpsObstacle *obstacle, CpsiView *view) {
    int rows, columns;
    cpsi_shape_grid(obstacle, &rows, &columns);
    if (obstacle->kind == CPS_OBSTACLE_CONE) return; /* it has no end */
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column <= columns; ++column) {
            const Vec3 p = cpsi_shape_point(obstacle, 0, 0, row, column);
            cpsi_range_include(view->x, vec3_dot(view->right, p));
            cpsi_range_include(view->y, vec3_dot(view->up, p));
        }
}
