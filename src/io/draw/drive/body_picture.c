/* SPDX-License-Identifier: BSD-3-Clause */
/* A body: its limit surface seen along Fy and along M, with the ellipsoid that robotics codes use
 * instead; its outline with pushes and centres of rotation; its path when it is towed. */
#include <math.h>
#include <stdlib.h>

#include "base/math.h"
#include "base/status.h"
#include "capstan/results.h"
#include "io/draw/diagram.h"

enum { AROUND = 360, SIDE = 320, GAP = 120, LEFT = 84, TOP = 96, PATH_HEIGHT = 420, POSES = 9 };

typedef struct BodyPicture {
    const CpsDriveFile *file;
    const CpsDriveBody *body;
    int count;
    const double *pose, *end;
} BodyPicture;

/* ---- limit surface ---- */

/* projection of the set of wrenches onto two components (i, k): points of contact in all directions
 * of their plane */
static CpsStatus shadow(const CpsDriveBody *body, int i, int k, double axis[2], double *point,
                        CpsError *err) {
    double wrench[3];
    CpsSetAnswer answer;
    for (int e = 0; e < 2; e++) {
        double twist[3] = {0, 0, 0};
        twist[e ? k : i] = 1;
        const CpsStatus status =
            cps_planar_dissipation(body->planar, twist, NULL, NULL, &answer, err);
        if (status != CPS_OK) return status;
        axis[e] = answer.value > 0 ? answer.value : 1;
    }
    for (int a = 0; a < AROUND; a++) {
        /* shifted by half a step, so that no direction is normal to an edge along an axis */
        const double angle = 2 * CPSI_PI * (a + 0.5) / AROUND;
        double twist[3] = {0, 0, 0};
        twist[i] = cos(angle) / axis[0];
        twist[k] = sin(angle) / axis[1];
        const CpsStatus status =
            cps_planar_dissipation(body->planar, twist, wrench, NULL, &answer, err);
        if (status != CPS_OK) return status;
        point[2 * a] = wrench[i];
        point[2 * a + 1] = wrench[k];
    }
    return CPS_OK;
}

static CpsStatus draw_surface(FILE *out, const BodyPicture *p, int column, int k, CpsError *err) {
    static const char *const LABEL[] = {"Fx", "Fy", "M"};
    double point[2 * AROUND], ellipse[2 * AROUND], axis[2];
    const CpsStatus status = shadow(p->body, 0, k, axis, point, err);
    if (status != CPS_OK) return status;
    const CpsiUnit ux = cpsi_unit("N", axis[0]), uy = cpsi_unit(k == 2 ? "N m" : "N", axis[1]);
    CpsiFrame frame = {.left = LEFT + column * (SIDE + GAP),
                       .top = TOP,
                       .width = SIDE,
                       .height = SIDE};
    for (int a = 0; a < AROUND; a++) {
        point[2 * a] *= ux.factor;
        point[2 * a + 1] *= uy.factor;
        ellipse[2 * a] = axis[0] * ux.factor * cos(2 * CPSI_PI * a / AROUND);
        ellipse[2 * a + 1] = axis[1] * uy.factor * sin(2 * CPSI_PI * a / AROUND);
    }
    frame.x[0] = -1.15 * axis[0] * ux.factor;
    frame.x[1] = -frame.x[0];
    frame.y[0] = -1.15 * axis[1] * uy.factor;
    frame.y[1] = -frame.y[0];
    cpsi_range_points(frame.x, frame.y, AROUND, point);
    cpsi_range_pad(frame.x, 0.02);
    cpsi_range_pad(frame.y, 0.02);
    char x[40], y[40];
    snprintf(x, sizeof x, "Fx (%s)", ux.name);
    snprintf(y, sizeof y, "%s (%s)", LABEL[k], uy.name);
    cpsi_frame_title(out, &frame,
                     k == 2 ? "limit surface, seen along Fy" : "limit surface, seen along M");
    cpsi_frame_axes(out, &frame, x, y);
    cpsi_frame_begin(out, &frame, 1 + column);
    cpsi_draw_curve(out, &frame, AROUND, ellipse, true,
                    "fill=\"none\" stroke=\"" CPSI_ORANGE
                    "\" stroke-width=\"1.4\" stroke-dasharray=\"6 4\"");
    cpsi_draw_curve(out, &frame, AROUND, point, true,
                    "fill=\"#dfe9f6\" fill-opacity=\"0.7\" stroke=\"" CPSI_BLUE
                    "\" stroke-width=\"1.8\"");
    cpsi_frame_end(out);
    return CPS_OK;
}

/* ---- pushes ---- */

/* extent of a body from its origin, as ranges around its patches */
static void reach(const CpsDriveBody *body, double x[2], double y[2]) {
    x[0] = y[0] = INFINITY;
    x[1] = y[1] = -INFINITY;
    for (int i = 0; i < body->patch_count; i++) {
        const CpsPatch *p = &body->patch[i];
        double r = p->size;
        for (int k = 0; k < p->corner_count; k++)
            r = fmax(r, hypot(p->corner[2 * k], p->corner[2 * k + 1]));
        const double box[4] = {p->position[0] - r, p->position[1] - r, p->position[0] + r,
                               p->position[1] + r};
        cpsi_range_points(x, y, 2, box);
    }
}

/* one push: an arrow, and a line to the centre of rotation */
static void draw_push(FILE *out, const CpsiFrame *frame, const CpsDrivePush *push,
                      const double centre[2], bool turns, double unit, const char *colour) {
    const double along[2] = {push->point_velocity[0] * unit, push->point_velocity[1] * unit};
    char style[80];
    if (push->at_point) cpsi_draw_arrow(out, frame, push->point, along, colour, 2.2);
    if (!turns) return;
    snprintf(style, sizeof style, "fill=\"#fff\" stroke=\"%s\" stroke-width=\"2\"", colour);
    cpsi_draw_dot(out, frame, centre, 5, style);
    if (!push->at_point) return;
    const double line[4] = {push->point[0], push->point[1], centre[0], centre[1]};
    snprintf(style, sizeof style, "fill=\"none\" stroke=\"%s\" stroke-dasharray=\"3 3\"", colour);
    cpsi_draw_curve(out, frame, 2, line, false, style);
}

static CpsStatus draw_pushes(FILE *out, const BodyPicture *p, int column, CpsError *err) {
    CpsiFrame frame = {.left = LEFT + column * (SIDE + GAP),
                       .top = TOP,
                       .width = SIDE,
                       .height = SIDE};
    const int count = p->body->push_count;
    CpsPlanarMotion *motion = malloc(((size_t)count + 1) * sizeof *motion);
    if (!motion) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    reach(p->body, frame.x, frame.y);
    const double size = fmax(fmax(frame.x[1] - frame.x[0], frame.y[1] - frame.y[0]), 1e-9);
    double fastest = 0;
    CpsStatus status = CPS_OK;
    for (int i = 0; i < count && status == CPS_OK; i++) {
        const CpsDrivePush *push = &p->body->push[i];
        status = cps_planar_drive(p->body->planar, push->row_count, push->map, push->velocity,
                                  &motion[i], err);
        if (status != CPS_OK) break;
        if (push->at_point) cpsi_range_points(frame.x, frame.y, 1, push->point);
        /* a centre is shown if it is not too far away */
        if (hypot(motion[i].centre[0], motion[i].centre[1]) < 2 * size)
            cpsi_range_points(frame.x, frame.y, 1, motion[i].centre);
        fastest = fmax(fastest, hypot(push->point_velocity[0], push->point_velocity[1]));
    }
    const double unit = fastest > 0 ? 0.35 * size / fastest : 0;
    for (int i = 0; i < count; i++) {
        const CpsDrivePush *push = &p->body->push[i];
        const double tip[2] = {push->point[0] + unit * push->point_velocity[0],
                               push->point[1] + unit * push->point_velocity[1]};
        if (push->at_point) cpsi_range_points(frame.x, frame.y, 1, tip);
    }
    cpsi_range_pad(frame.x, 0.15);
    cpsi_range_pad(frame.y, 0.15);
    cpsi_frame_equal(&frame);
    cpsi_frame_title(out, &frame, count ? "from above: pushes, centres of rotation" : "from above");
    cpsi_frame_axes(out, &frame, "x (m)", "y (m)");
    cpsi_frame_begin(out, &frame, 1 + column);
    const double here[3] = {0, 0, 0};
    cpsi_draw_body(out, &frame, p->body, here, CPSI_BLUE, 0.9);
    if (status == CPS_OK)
        for (int i = 0; i < count; i++) {
            const CpsiColour colour =
                cpsi_colour(CPSI_SCALE_TENSION, count > 1 ? 0.3 + 0.6 * i / (count - 1) : 0.6);
            const bool turns = hypot(motion[i].centre[0], motion[i].centre[1]) < 1e6 * size;
            draw_push(out, &frame, &p->body->push[i], motion[i].centre, turns, unit, colour.hex);
        }
    cpsi_frame_end(out);
    free(motion);
    return status;
}

/* ---- tow ---- */

static void draw_way(FILE *out, const BodyPicture *p, double width) {
    CpsiFrame frame = {.left = LEFT,
                       .top = TOP + SIDE + 110,
                       .width = width,
                       .height = PATH_HEIGHT};
    double x[2], y[2];
    reach(p->body, x, y);
    const double r = fmax(fmax(fabs(x[0]), fabs(x[1])), fmax(fabs(y[0]), fabs(y[1])));
    frame.x[0] = frame.y[0] = INFINITY;
    frame.x[1] = frame.y[1] = -INFINITY;
    cpsi_range_points(frame.x, frame.y, p->count, p->end);
    for (int i = 0; i < p->count; i++)
        for (int k = -1; k < 2; k += 2) {
            const double corner[2] = {p->pose[3 * (size_t)i] + k * r,
                                      p->pose[3 * (size_t)i + 1] + k * r};
            cpsi_range_points(frame.x, frame.y, 1, corner);
        }
    cpsi_range_pad(frame.x, 0.03);
    cpsi_range_pad(frame.y, 0.03);
    /* as wide as the path, within the sheet */
    frame.width = fmin(width, fmax(SIDE, PATH_HEIGHT * (frame.x[1] - frame.x[0]) /
                                             (frame.y[1] - frame.y[0])));
    cpsi_frame_equal(&frame);
    cpsi_frame_title(out, &frame,
                     p->body->tow.start.rope > 0
                         ? "towed on a rope: the path of its far end, and the body"
                         : "towed: the path of the hitch, and the body");
    cpsi_frame_axes(out, &frame, "x (m)", "y (m)");
    cpsi_frame_begin(out, &frame, 9);
    cpsi_draw_curve(out, &frame, p->count, p->end, false,
                    "fill=\"none\" stroke=\"" CPSI_PLUM "\" stroke-width=\"1.6\"");
    for (int shot = 0; shot < POSES; shot++) {
        const size_t i = (size_t)((long long)(p->count - 1) * shot / (POSES - 1));
        const double *pose = p->pose + 3 * i, *hitch = p->body->tow.start.hitch;
        const double c = cos(pose[2]), s = sin(pose[2]);
        const double line[4] = {pose[0] + c * hitch[0] - s * hitch[1],
                                pose[1] + s * hitch[0] + c * hitch[1], p->end[2 * i],
                                p->end[2 * i + 1]};
        cpsi_draw_body(out, &frame, p->body, pose,
                       cpsi_colour(CPSI_SCALE_STEP, (double)shot / (POSES - 1)).hex, 0.9);
        if (p->body->tow.start.rope > 0)
            cpsi_draw_curve(out, &frame, 2, line, false, "fill=\"none\" stroke=\"#666\"");
        cpsi_draw_dot(out, &frame, line + 2, 2.5, "fill=\"" CPSI_PLUM "\"");
    }
    cpsi_frame_end(out);
}

/* ---- the whole picture ---- */

static CpsStatus draw_body(void *what, FILE *out, CpsError *err) {
    const BodyPicture *p = what;
    const double width = 3 * SIDE + 2 * GAP;
    const bool towed = p->count > 1;
    cpsi_svg_begin(out, LEFT + width + 40, TOP + SIDE + 90 + (towed ? PATH_HEIGHT + 80 : 0),
                   *p->file->title    ? p->file->title
                   : p->body->vehicle ? "vehicle"
                                      : "body on a plane",
                   "what friction can do to it, and what it does when it is driven");
    CpsStatus status = draw_surface(out, p, 0, 2, err);
    if (status == CPS_OK) status = draw_surface(out, p, 1, 1, err);
    if (status == CPS_OK) status = draw_pushes(out, p, 2, err);
    double x = LEFT;
    const double y = TOP + SIDE + 62;
    cpsi_legend(
        out, &x, y,
        "<rect x=\"-11\" y=\"-5\" width=\"22\" height=\"10\" fill=\"#dfe9f6\" stroke=\"" CPSI_BLUE
        "\"/>",
        "forces and torques of friction");
    cpsi_legend(out, &x, y,
                "<path d=\"M-11 0H11\" stroke=\"" CPSI_ORANGE
                "\" stroke-dasharray=\"6 4\" stroke-width=\"1.4\"/>",
                "ellipsoid with the same axes");
    if (p->body->push_count)
        cpsi_legend(out, &x, y,
                    "<circle r=\"5\" fill=\"#fff\" stroke=\"" CPSI_PLUM "\" stroke-width=\"2\"/>",
                    "centre of rotation");
    if (status == CPS_OK && towed) draw_way(out, p, width);
    cpsi_svg_finish(out);
    return status;
}

CpsStatus cps_drive_draw_body(const CpsDriveFile *file, int count, const double *poses,
                              const double *ends, FILE *out, CpsError *err) {
    if (!file || file->kind != CPS_DRIVE_BODY)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the file holds no body");
    if (count < 0) return cpsi_fail(err, CPS_ERR_ARGUMENT, "the number of poses is %d", count);
    BodyPicture picture = {file, &file->body, poses && ends ? count : 0, poses, ends};
    return cpsi_draw_plain(draw_body, &picture, out, err);
}
