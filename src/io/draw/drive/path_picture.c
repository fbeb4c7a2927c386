/* SPDX-License-Identifier: BSD-3-Clause */
/* A planimeter on its curve; a block on a spring, its path in the plane or its loop in one
 * component. */
#include <math.h>
#include <stdlib.h>

#include "base/status.h"
#include "capstan/results.h"
#include "io/draw/diagram.h"

enum { LEFT = 84, TOP = 96, SIDE = 520 };

static const char PATH_STYLE[] = "fill=\"none\" stroke=\"" CPSI_PLUM "\" stroke-width=\"1.4\"";

/* ---- planimeter ---- */

typedef struct TracePicture {
    const CpsDriveFile *file;
    const CpsPlanimeterReading *reading;
} TracePicture;

/* the hinge, on the side of the elbow */
static void find_hinge(const CpsPlanimeter *p, const double tracer[2], double hinge[2]) {
    const double dx = tracer[0] - p->pole[0], dy = tracer[1] - p->pole[1], d2 = dx * dx + dy * dy;
    const double along =
        0.5 * (1 + (p->pole_arm * p->pole_arm - p->tracer_arm * p->tracer_arm) / d2);
    const double across =
        sqrt(fmax(p->pole_arm * p->pole_arm / d2 - along * along, 0)) * (p->left_elbow ? 1 : -1);
    hinge[0] = p->pole[0] + along * dx - across * dy;
    hinge[1] = p->pole[1] + along * dy + across * dx;
}

static CpsStatus draw_trace(void *what, FILE *out, CpsError *err) {
    (void)err;
    const TracePicture *p = what;
    const CpsDrivePlanimeter *d = &p->file->planimeter;
    const CpsPlanimeter *m = &d->planimeter;
    CpsiFrame frame = {.left = LEFT, .top = TOP, .width = SIDE, .height = SIDE};
    const double *tracer = d->point;
    double hinge[2];
    find_hinge(m, tracer, hinge);
    const double t = m->wheel / m->tracer_arm;
    const double wheel[2] = {hinge[0] + t * (tracer[0] - hinge[0]),
                             hinge[1] + t * (tracer[1] - hinge[1])};
    const double arms[6] = {m->pole[0], m->pole[1], hinge[0], hinge[1], tracer[0], tracer[1]};
    frame.x[0] = frame.x[1] = m->pole[0];
    frame.y[0] = frame.y[1] = m->pole[1];
    cpsi_range_points(frame.x, frame.y, d->point_count, d->point);
    cpsi_range_points(frame.x, frame.y, 3, arms);
    cpsi_range_points(frame.x, frame.y, 1, wheel);
    cpsi_range_pad(frame.x, 0.08);
    cpsi_range_pad(frame.y, 0.08);
    cpsi_frame_equal(&frame);
    char text[200];
    snprintf(text, sizeof text,
             "area by the wheel %.9g m\xC2\xB2, of the curve %.9g m\xC2\xB2, difference %.2g",
             p->reading->area, p->reading->exact, p->reading->area - p->reading->exact);
    cpsi_svg_begin(out, LEFT + SIDE + 40, TOP + SIDE + 90,
                   *p->file->title ? p->file->title : "polar planimeter", text);
    cpsi_frame_axes(out, &frame, "x (m)", "y (m)");
    cpsi_frame_begin(out, &frame, 1);
    cpsi_draw_curve(out, &frame, d->point_count, d->point, true,
                    "fill=\"#dfe9f6\" stroke=\"" CPSI_BLUE "\" stroke-width=\"1.6\"");
    cpsi_draw_curve(out, &frame, 3, arms, false,
                    "fill=\"none\" stroke=\"#555\" stroke-width=\"3\"");
    cpsi_draw_dot(out, &frame, m->pole, 6, "fill=\"#333\"");
    cpsi_draw_dot(out, &frame, hinge, 4, "fill=\"#fff\" stroke=\"#555\" stroke-width=\"2\"");
    cpsi_draw_dot(out, &frame, tracer, 4, "fill=\"" CPSI_PLUM "\"");

    /* the wheel, perpendicular to its arm */
    const double nx = -(tracer[1] - hinge[1]) / m->tracer_arm,
                 ny = (tracer[0] - hinge[0]) / m->tracer_arm;
    const double half = 0.06 * (frame.x[1] - frame.x[0]) * 0.6;
    const double rim[4] = {wheel[0] - half * nx, wheel[1] - half * ny, wheel[0] + half * nx,
                           wheel[1] + half * ny};
    cpsi_draw_curve(out, &frame, 2, rim, false, "stroke=\"" CPSI_ORANGE "\" stroke-width=\"7\"");
    cpsi_frame_end(out);
    double x = LEFT;
    const double y = TOP + SIDE + 62;
    cpsi_legend(out, &x, y, "<circle r=\"6\" fill=\"#333\"/>", "pole");
    cpsi_legend(out, &x, y, "<path d=\"M-8 0H8\" stroke=\"" CPSI_ORANGE "\" stroke-width=\"7\"/>",
                "wheel");
    cpsi_legend(out, &x, y, "<circle r=\"4\" fill=\"" CPSI_PLUM "\"/>",
                "tracer, at the first point");
    cpsi_svg_finish(out);
    return CPS_OK;
}

CpsStatus cps_drive_draw_planimeter(const CpsDriveFile *file, const CpsPlanimeterReading *reading,
                                    FILE *out, CpsError *err) {
    if (!file || file->kind != CPS_DRIVE_PLANIMETER || file->planimeter.point_count < 3 || !reading)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the file holds no planimeter, or there is no reading");
    TracePicture picture = {file, reading};
    return cpsi_draw_plain(draw_trace, &picture, out, err);
}

/* ---- sweep ---- */

typedef struct SweepPicture {
    const CpsDriveFile *file;
    int count;
    const double *end, *position, *force;
} SweepPicture;

/* one component: a value over the moved end */
static void draw_loop(FILE *out, const SweepPicture *p, int column, const double *value,
                      const char *label, const char *colour, double *scratch) {
    CpsiFrame frame = {.left = LEFT + column * (SIDE - 60.0),
                       .top = TOP,
                       .width = SIDE - 160,
                       .height = SIDE - 160};
    frame.x[0] = frame.y[0] = INFINITY;
    frame.x[1] = frame.y[1] = -INFINITY;
    char style[80];
    for (int i = 0; i < p->count; i++) {
        scratch[2 * (size_t)i] = p->end[i];
        scratch[2 * (size_t)i + 1] = value[i];
    }
    cpsi_range_points(frame.x, frame.y, p->count, scratch);
    cpsi_range_pad(frame.x, 0.08);
    cpsi_range_pad(frame.y, 0.08);
    cpsi_frame_axes(out, &frame, "moved end of the spring (m)", label);
    cpsi_frame_begin(out, &frame, 1 + column);
    snprintf(style, sizeof style, "fill=\"none\" stroke=\"%s\" stroke-width=\"2\"", colour);
    cpsi_draw_curve(out, &frame, p->count, scratch, false, style);
    cpsi_draw_dot(out, &frame, scratch, 4, "fill=\"#333\"");
    cpsi_frame_end(out);
}

/* two components: the paths of the block and of the end, with springs */
static void draw_plane(FILE *out, const SweepPicture *p) {
    CpsiFrame frame = {.left = LEFT, .top = TOP, .width = SIDE, .height = SIDE};
    frame.x[0] = frame.y[0] = INFINITY;
    frame.x[1] = frame.y[1] = -INFINITY;
    cpsi_range_points(frame.x, frame.y, p->count, p->end);
    cpsi_range_points(frame.x, frame.y, p->count, p->position);
    cpsi_range_pad(frame.x, 0.08);
    cpsi_range_pad(frame.y, 0.08);
    cpsi_frame_equal(&frame);
    cpsi_frame_axes(out, &frame, "x (m)", "y (m)");
    cpsi_frame_begin(out, &frame, 1);
    for (int shot = 0; shot <= 12; shot++) {
        const size_t i = (size_t)((long long)(p->count - 1) * shot / 12);
        const double line[4] = {p->position[2 * i], p->position[2 * i + 1], p->end[2 * i],
                                p->end[2 * i + 1]};
        cpsi_draw_curve(out, &frame, 2, line, false,
                        "fill=\"none\" stroke=\"" CPSI_GREY "\" stroke-dasharray=\"2 2\"");
        cpsi_draw_dot(out, &frame, line, 3, "fill=\"" CPSI_BLUE "\"");
    }
    cpsi_draw_curve(out, &frame, p->count, p->end, false, PATH_STYLE);
    cpsi_draw_curve(out, &frame, p->count, p->position, false,
                    "fill=\"none\" stroke=\"" CPSI_BLUE "\" stroke-width=\"2\"");
    cpsi_frame_end(out);
    double x = LEFT;
    const double y = TOP + SIDE + 62;
    cpsi_legend(out, &x, y, "<path d=\"M-11 0H11\" stroke=\"" CPSI_BLUE "\" stroke-width=\"2\"/>",
                "block");
    cpsi_legend(out, &x, y, "<path d=\"M-11 0H11\" stroke=\"" CPSI_PLUM "\" stroke-width=\"1.4\"/>",
                "moved end");
    cpsi_legend(out, &x, y,
                "<path d=\"M-11 0H11\" stroke=\"" CPSI_GREY "\" stroke-dasharray=\"2 2\"/>",
                "spring");
}

static CpsStatus draw_sweep(void *what, FILE *out, CpsError *err) {
    const SweepPicture *p = what;
    const bool plane = p->file->sweep.space == 2;
    double *scratch = malloc(2 * (size_t)p->count * sizeof *scratch);
    if (!scratch) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    cpsi_svg_begin(out, LEFT + SIDE + (plane ? 40 : SIDE - 160),
                   TOP + (plane ? SIDE + 90 : SIDE - 90),
                   *p->file->title ? p->file->title : "block on a spring",
                   plane
                       ? "a block dragged by a spring: friction lets it follow only where the "
                         "spring pulls hard enough"
                       : "the play operator: position and force over the moved end of the spring");
    if (plane) {
        draw_plane(out, p);
    } else {
        draw_loop(out, p, 0, p->position, "block (m)", CPSI_BLUE, scratch);
        draw_loop(out, p, 1, p->force, "friction on the block (N)", CPSI_PLUM, scratch);
    }
    cpsi_svg_finish(out);
    free(scratch);
    return CPS_OK;
}

CpsStatus cps_drive_draw_sweep(const CpsDriveFile *file, int count, const double *end,
                               const double *position, const double *force, FILE *out,
                               CpsError *err) {
    if (!file || file->kind != CPS_DRIVE_SWEEP || !file->sweep.law || count < 1 || !end ||
        !position || !force)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the file holds no sweep, or there are no steps");
    SweepPicture picture = {file, count, end, position, force};
    return cpsi_draw_plain(draw_sweep, &picture, out, err);
}
