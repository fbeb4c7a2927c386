/* SPDX-License-Identifier: BSD-3-Clause */
/* Drawing graphs as SVG 1.1: a sheet with titles, frames with axes, curves, colour bars and
 * legends.
 *
 * Sheets are self-contained: no script, no external style, generic fonts. Lengths are pixels at 96
 * per inch, with y pointing down; a frame maps data to them. All user text is escaped. */
#ifndef CAPSTAN_SRC_IO_DRAW_SVG_H
#define CAPSTAN_SRC_IO_DRAW_SVG_H

#include <stdbool.h>
#include <stdio.h>

/* Part of a sheet that shows the data ranges x[0]..x[1] and y[0]..y[1]. */
typedef struct CpsiFrame {
    double left, top, width, height;
    double x[2], y[2];
} CpsiFrame;

/* Colour scales with visually equal steps. */
typedef enum CpsiScale {
    CPSI_SCALE_TENSION, /* yellow to violet */
    CPSI_SCALE_STEP     /* green to blue */
} CpsiScale;

/* "#rrggbb" at t in 0..1. */
typedef struct CpsiColour {
    char hex[8];
} CpsiColour;
CpsiColour cpsi_colour(CpsiScale scale, double t);

/* A unit with a prefix that suits values up to `largest`: "kN", 1e-3. */
typedef struct CpsiUnit {
    char name[8];
    double factor;
} CpsiUnit;
CpsiUnit cpsi_unit(const char *base, double largest);

typedef enum CpsiAnchor { CPSI_START, CPSI_MIDDLE, CPSI_END } CpsiAnchor;

void cpsi_svg_begin(FILE *out, double width, double height, const char *title,
                    const char *subtitle);
void cpsi_svg_finish(FILE *out);
/* `style` are further attributes of the text element, "" for none. */
void cpsi_svg_text(FILE *out, double x, double y, CpsiAnchor anchor, const char *style,
                   const char *text);

double cpsi_frame_x(const CpsiFrame *frame, double x);
double cpsi_frame_y(const CpsiFrame *frame, double y);

/* Widen a range by a share of its length on both sides; a range of length 0 or one that is not
 * finite is made drawable. */
void cpsi_range_pad(double range[2], double share);
void cpsi_range_include(double range[2], double x);

/* Background; then axes with grid, ticks and labels; everything drawn between begin and end is
 * clipped to the frame. */
void cpsi_frame_axes(FILE *out, const CpsiFrame *frame, const char *x_label, const char *y_label);
void cpsi_frame_begin(FILE *out, const CpsiFrame *frame, int id);
void cpsi_frame_end(FILE *out);

/* A colour bar to the right of the frame, values lo..hi; one per sheet. */
void cpsi_frame_bar(FILE *out, const CpsiFrame *frame, CpsiScale scale, double lo, double hi,
                    const char *label);

/* One entry of a legend that extends to the right: a sample drawn from `mark` (an SVG element
 * around 0,0, 22 wide) and a text; advances *x. */
void cpsi_legend(FILE *out, double *x, double y, const char *mark, const char *text);

#endif
