/* SPDX-License-Identifier: BSD-3-Clause */
/* Parts shared by pictures: frames of equal scales, curves, arrows, driven bodies; lengths are
 * in data units. */
#ifndef CAPSTAN_SRC_IO_DRAW_DIAGRAM_H
#define CAPSTAN_SRC_IO_DRAW_DIAGRAM_H

#include "capstan/io.h"
#include "io/draw/svg.h"

/* Colours of the pictures. */
#define CPSI_BLUE   "#2b5fa8"
#define CPSI_ORANGE "#c98a1b"
#define CPSI_PLUM   "#a03070"
#define CPSI_GREY   "#999"

/* Widen one of a frame's ranges so that both directions have the same scale. */
void cpsi_frame_equal(CpsiFrame *frame);

/* Extend ranges to contain (count, 2) points. */
void cpsi_range_points(double x[2], double y[2], int count, const double *point);

/* A polyline, closed or not; `style` are further attributes. Points nearer than half a pixel are
 * left out. */
void cpsi_draw_curve(FILE *out, const CpsiFrame *frame, int count, const double *point, bool closed,
                     const char *style);

/* An arrow from a point along (dx, dy) in data units, with a head of some pixels. */
void cpsi_draw_arrow(FILE *out, const CpsiFrame *frame, const double from[2], const double along[2],
                     const char *colour, double width);

void cpsi_draw_dot(FILE *out, const CpsiFrame *frame, const double at[2], double radius,
                   const char *style);

/* A heading above a frame. */
void cpsi_frame_title(FILE *out, const CpsiFrame *frame, const char *text);

/* A body's patches at a pose, filled with a pale colour. */
void cpsi_draw_body(FILE *out, const CpsiFrame *frame, const CpsDriveBody *body,
                    const double pose[3], const char *colour, double opacity);

/* Call `draw` in a locale with decimal points. */
CpsStatus cpsi_draw_plain(CpsStatus (*draw)(void *what, FILE *out, CpsError *err), void *what,
                          FILE *out, CpsError *err);

#endif
