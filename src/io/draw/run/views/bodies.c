/* SPDX-License-Identifier: BSD-3-Clause */
/* Rigid bodies in plan views and elevations: the outline around the points on the body, its
 * reference point and its centres, and its own axes at the reference point; and the names of points
 * and bodies, each where there is space. */
#include <math.h>
#include <string.h>

#include "base/rotation.h"
#include "io/draw/run/run_picture.h"

enum { AXIS = 26, CHARACTER = 6, LINE = 12, LABEL_GAP = 9 }; /* in pixels */

static const char *const AXIS_COLOUR[] = {"#c0392b", "#2e8b57", "#2d6cb5"};

/* ---- outline ---- */

int cpsi_body_corner_count(const CpsResults *results, int body) {
    int count = 3;
    for (int i = 0; i < results->point_count; ++i)
        count += results->point[i].kind == CPS_POINT_KIND_ON_BODY && results->point[i].body == body;
    return count;
}

/* In the body's axes: the points on it, and then its reference point and its centres, which count
 * where they have a force. */
static Vec3 corner_on_body(const CpsResults *results, int body, int corner) {
    const CpsBody *of = &results->body[body];
    for (int i = 0; i < results->point_count; ++i) {
        if (results->point[i].kind != CPS_POINT_KIND_ON_BODY || results->point[i].body != body)
            continue;
        if (corner-- == 0) return vec3_load(results->point[i].position);
    }
    if (corner == 1 && of->weight > 0) return vec3_load(of->centre_of_gravity);
    if (corner == 2 && of->buoyancy > 0) return vec3_load(of->centre_of_buoyancy);
    return vec3(0, 0, 0);
}

Vec3 cpsi_body_corner(const CpsResults *results, const CpsBodyReport *report, int body,
                      int corner) {
    const Vec3 place = vec3_sub(vec3_load(report->position), vec3_load(results->origin));
    return vec3_add(place, rotation_apply(rotation_load(report->rotation),
                                          corner_on_body(results, body, corner)));
}

/* A place on paper. */
typedef struct Spot {
    double x, y;
} Spot;

static Spot on_paper(const CpsiView *view, const CpsiFrame *frame, Vec3 place) {
    return (Spot){cpsi_frame_x(frame, vec3_dot(view->right, place)),
                  cpsi_frame_y(frame, vec3_dot(view->up, place))};
}

/* Twice the area of a triangle, with its sense. */
static double area(Spot a, Spot b, Spot c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/* The convex outline of a body as the points of a polygon: from a corner to the one that has all
 * others on one side, until it closes. */
static void write_outline(const CpsResults *results, const CpsiView *view, const CpsiFrame *frame,
                          const CpsBodyReport *report, int body, FILE *out) {
    const int count = cpsi_body_corner_count(results, body);
    int first = 0;
    Spot from = {INFINITY, 0};
    for (int i = 0; i < count; ++i) {
        const Spot at = on_paper(view, frame, cpsi_body_corner(results, report, body, i));
        if (at.x < from.x || (at.x == from.x && at.y < from.y)) {
            from = at;
            first = i;
        }
    }
    const Spot start = from;
    int here = first;
    for (int turn = 0; turn < count; ++turn) {
        fprintf(out, "%.1f,%.1f ", from.x, from.y);
        Spot next = from;
        int to = here;
        for (int i = 0; i < count; ++i) {
            const Spot at = on_paper(view, frame, cpsi_body_corner(results, report, body, i));
            const double side = area(from, next, at);
            const bool is_farther =
                hypot(at.x - from.x, at.y - from.y) > hypot(next.x - from.x, next.y - from.y);
            if (side < 0 || (side == 0 && is_farther)) {
                next = at;
                to = i;
            }
        }
        if (to == here || to == first || (next.x == start.x && next.y == start.y)) break;
        from = next;
        here = to;
    }
}

void cpsi_picture_outline(const CpsResults *results, const CpsiView *view, const CpsiFrame *frame,
                          const CpsBodyReport *report, int body, const char *style, FILE *out) {
    fprintf(out, "<polygon %s stroke-linejoin=\"round\" points=\"", style);
    write_outline(results, view, frame, report, body, out);
    fputs("\"/>\n", out);
}

/* ---- axes ---- */

void cpsi_picture_axes(const CpsResults *results, const CpsiView *view, const CpsiFrame *frame,
                       const CpsBodyReport *report, FILE *out) {
    static const Vec3 ALONG[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const Rotation turn = rotation_load(report->rotation);
    const Vec3 place = vec3_sub(vec3_load(report->position), vec3_load(results->origin));
    const Spot at = on_paper(view, frame, place);
    for (int a = 0; a < 3; ++a) {
        const Vec3 axis = rotation_apply(turn, ALONG[a]);
        fprintf(out,
                "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" "
                "stroke-width=\"2\"/>\n",
                at.x, at.y, at.x + AXIS * vec3_dot(view->right, axis),
                at.y - AXIS * vec3_dot(view->up, axis), AXIS_COLOUR[a]);
    }
    fprintf(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\" fill=\"#222\"/>\n", at.x, at.y);
}

/* ---- names ---- */

static bool is_apart(const CpsiLabels *labels, const double box[4]) {
    for (int i = 0; i < labels->count; ++i) {
        const double *other = labels->box[i];
        if (box[0] < other[2] && other[0] < box[2] && box[1] < other[3] && other[1] < box[3])
            return false;
    }
    return true;
}

void cpsi_label_put(CpsiLabels *labels, const CpsiFrame *frame, double x, double y,
                    const char *name, FILE *out) {
    const double width = CHARACTER * (double)strlen(name);
    const bool is_left = x > frame->left + 0.8 * frame->width;
    /* above, below, and farther away; on the side where there is space, then on the other */
    for (int attempt = 0; attempt < 12; ++attempt) {
        const bool left = (attempt / 2) % 2 == 0 ? is_left : !is_left;
        const int row = attempt / 4;
        const double base = y + (attempt % 2 == 0 ? -LABEL_GAP - row * LINE
                                                  : LABEL_GAP + LINE - 3 + row * LINE),
                     at = left ? x - LABEL_GAP : x + LABEL_GAP,
                     box[4] = {left ? at - width : at, base - LINE + 2, left ? at : at + width,
                               base + 2};
        if (!is_apart(labels, box) && attempt < 11) continue;
        if (labels->count < CPSI_LABELS) memcpy(labels->box[labels->count++], box, sizeof box);
        cpsi_svg_text(out, at, base, left ? CPSI_END : CPSI_START,
                      "font-size=\"11\" paint-order=\"stroke\" stroke=\"#fff\" "
                      "stroke-width=\"3\"",
                      name);
        return;
    }
}
