/* SPDX-License-Identifier: BSD-3-Clause */
/* Obstacles in plan views and elevations.
 *
 * A plane seen from above fills the frame and shows its slope; otherwise its intersection with the
 * paper is shown. Cylinders and balls are shown by their silhouettes: a circle, or the band of a
 * cylinder seen from its side, which has no ends; so are capsules, tori, cones and boxes
 * (shapes.c). What lines are inside of is white. Ground has a picture of its own (ground.c);
 * surfaces given as functions are not shown. An obstacle that turns and is seen along its axis
 * has a spoke that turns with it. One that moves is shown where it is after the step, and lightly
 * where it was before. The water is what is below its surface, in elevations. */
#include <math.h>
#include <string.h>

#include "base/math.h"
#include "io/draw/run/run_picture.h"

static const char FILL[] = "#efe7d6", ROUND_FILL[] = "#e6dcc4", INSIDE[] = "#ffffff",
                  EDGE[] = "#b9a67c", SEEN_FROM_ABOVE[] = "#faf7f0", TEXT[] = "#9a8350",
                  WATER[] = "#edf5fb", SURFACE[] = "#5b8fbf";

/* A cylinder whose axis is this short on paper is shown as a circle. */
static const double END_ON = 0.1;

enum { CORNERS = 8 };

/* What is round is solid, or hollow. */
static const char *fill_of(const CpsObstacle *obstacle) {
    return obstacle->shape.inside ? INSIDE : ROUND_FILL;
}

static double degrees(double angle) { return angle * 180 / CPSI_PI; }

static Vec3 unit(const double given[3]) {
    const Vec3 a = vec3_load(given);
    return vec3_scale(1 / vec3_norm(a), a);
}

/* A convex polygon. */
typedef struct Polygon {
    int count;
    double corner[CORNERS][2];
} Polygon;

static Polygon whole(const CpsiFrame *frame) {
    return (Polygon){4,
                     {{frame->x[0], frame->y[0]},
                      {frame->x[1], frame->y[0]},
                      {frame->x[1], frame->y[1]},
                      {frame->x[0], frame->y[1]}}};
}

/* The part of the polygon in the half-plane a x + b y <= c. */
static Polygon cut(const Polygon *from, double a, double b, double c) {
    Polygon out = {0};
    for (int i = 0; i < from->count; ++i) {
        const double *p = from->corner[i], *q = from->corner[(i + 1) % from->count];
        const double dp = a * p[0] + b * p[1] - c, dq = a * q[0] + b * q[1] - c;
        if (dp <= 0) memcpy(out.corner[out.count++], p, sizeof out.corner[0]);
        if ((dp <= 0) == (dq <= 0)) continue;
        const double t = dp / (dp - dq);
        for (int k = 0; k < 2; ++k) out.corner[out.count][k] = p[k] + t * (q[k] - p[k]);
        out.count++;
    }
    return out;
}

static void draw_polygon(const CpsiFrame *frame, const Polygon *polygon, const char *fill,
                         const char *edge, FILE *out) {
    if (polygon->count == 0) return;
    fprintf(out, "<polygon fill=\"%s\" stroke=\"%s\" points=\"", fill, edge);
    for (int i = 0; i < polygon->count; ++i)
        fprintf(out, "%.1f,%.1f ", cpsi_frame_x(frame, polygon->corner[i][0]),
                cpsi_frame_y(frame, polygon->corner[i][1]));
    fputs("\"/>\n", out);
}

/* an arrow down the slope: the horizontal part of the normal */
static void draw_slope(const CpsiFrame *frame, double a, double b, FILE *out) {
    char label[48];
    const double x = frame->left + 46, y = frame->top + 46;
    snprintf(label, sizeof label, "downhill, %.3g\xC2\xB0", degrees(asin(hypot(a, b))));
    fprintf(out,
            "<path transform=\"translate(%.1f %.1f) rotate(%.2f)\" d=\"M-22,0 H20 M12,-5 L20,0 "
            "L12,5\" fill=\"none\" stroke=\"%s\" stroke-width=\"1.5\"/>",
            x, y, degrees(atan2(-b, a)), TEXT);
    cpsi_svg_text(out, x + 34, y + 4, CPSI_START, "fill=\"#9a8350\" font-size=\"11\"", label);
}

static void draw_plane(const CpsObstacle *plane, const CpsiView *view, const CpsiFrame *frame,
                       FILE *out) {
    const Vec3 normal = unit(plane->normal);
    const double a = vec3_dot(normal, view->right), b = vec3_dot(normal, view->up),
                 tilt = hypot(a, b);
    const bool from_above = view->plan && tilt < 0.9;
    const double c =
        vec3_dot(normal, vec3_load(plane->point)) - vec3_dot(normal, view->toward) * view->cut;
    const Polygon all = whole(frame), section = cut(&all, a, b, c);
    if (from_above)
        draw_polygon(frame, &all, SEEN_FROM_ABOVE, "none", out);
    else
        draw_polygon(frame, &section, FILL, EDGE, out);
    if (from_above && tilt >= 1e-3) draw_slope(frame, a, b, out);
}

/* A spoke that was upright at the start, and the angle turned since then. */
static void draw_spoke(const CpsObstacle *obstacle, double turned, const CpsiView *view,
                       const CpsiFrame *frame, FILE *out) {
    const Vec3 axis = unit(obstacle->axis), centre = vec3_load(obstacle->point);
    const Vec3 upright = vec3_reject(view->up, axis);
    const Vec3 spoke =
        vec3_axpy(cos(turned), upright, vec3_scale(sin(turned), vec3_cross(axis, upright)));
    const Vec3 rim = vec3_axpy(obstacle->radius / vec3_norm(upright), spoke, centre);
    const double x = cpsi_frame_x(frame, vec3_dot(view->right, centre)),
                 y = cpsi_frame_y(frame, vec3_dot(view->up, centre));
    char label[32];
    fprintf(
        out,
        "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"1.5\"/>"
        "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"2.5\" fill=\"%s\"/>\n",
        x, y, cpsi_frame_x(frame, vec3_dot(view->right, rim)),
        cpsi_frame_y(frame, vec3_dot(view->up, rim)), TEXT, x, y, TEXT);
    snprintf(label, sizeof label, "turned %.4g\xC2\xB0", degrees(turned));
    /* the text is placed where the spoke is not */
    const bool down = vec3_dot(view->up, spoke) < 0;
    cpsi_svg_text(out, x, down ? y - 8 : y + 16, CPSI_MIDDLE, "fill=\"#9a8350\" font-size=\"11\"",
                  label);
}

static void draw_circle(const CpsObstacle *obstacle, const CpsiView *view, const CpsiFrame *frame,
                        FILE *out) {
    const Vec3 centre = vec3_load(obstacle->point);
    const double x = vec3_dot(view->right, centre), y = vec3_dot(view->up, centre),
                 r = obstacle->radius;
    fprintf(
        out,
        "<ellipse cx=\"%.2f\" cy=\"%.2f\" rx=\"%.2f\" ry=\"%.2f\" fill=\"%s\" stroke=\"%s\"/>\n",
        cpsi_frame_x(frame, x), cpsi_frame_y(frame, y),
        cpsi_frame_x(frame, x + r) - cpsi_frame_x(frame, x),
        cpsi_frame_y(frame, y) - cpsi_frame_y(frame, y + r), fill_of(obstacle), EDGE);
}

/* The band of a cylinder seen from its side. */
static void draw_band(const CpsObstacle *obstacle, double along_x, double along_y,
                      const CpsiView *view, const CpsiFrame *frame, FILE *out) {
    const Vec3 centre = vec3_load(obstacle->point);
    const double size = hypot(along_x, along_y), a = -along_y / size, b = along_x / size;
    const double c = a * vec3_dot(view->right, centre) + b * vec3_dot(view->up, centre);
    const Polygon all = whole(frame), half = cut(&all, a, b, c + obstacle->radius);
    const Polygon band = cut(&half, -a, -b, obstacle->radius - c);
    draw_polygon(frame, &band, fill_of(obstacle), EDGE, out);
}

bool cpsi_obstacle_is_circle(const CpsObstacle *obstacle, const CpsiView *view) {
    if (obstacle->kind == CPS_OBSTACLE_SPHERE) return true;
    const Vec3 axis = unit(obstacle->axis);
    return obstacle->kind == CPS_OBSTACLE_CYLINDER &&
           hypot(vec3_dot(axis, view->right), vec3_dot(axis, view->up)) < END_ON;
}

static bool ever_turns(const CpsResults *results, int k) {
    for (int i = 0; i < results->row_count; ++i)
        if (cpsi_results_turns(results, i, k)) return true;
    return false;
}

/* The water below its surface, seen from the side. */
static void draw_water(const CpsResults *results, const CpsiView *view, const CpsiFrame *frame,
                       FILE *out) {
    if (!results->has_water_surface || view->plan) return;
    const Polygon all = whole(frame), below = cut(&all, 0, 1, results->water_surface * view->up.z);
    draw_polygon(frame, &below, WATER, SURFACE, out);
}

static bool is_shape(const CpsObstacle *obstacle) {
    int rows, columns;
    cpsi_shape_grid(obstacle, &rows, &columns);
    return rows > 0;
}

static void draw_round(const CpsObstacle *obstacle, const CpsiView *view, const CpsiFrame *frame,
                       FILE *out) {
    if (is_shape(obstacle)) {
        cpsi_picture_shape(obstacle, fill_of(obstacle), EDGE, view, frame, out);
        return;
    }
    const Vec3 axis = unit(obstacle->axis);
    if (cpsi_obstacle_is_circle(obstacle, view))
        draw_circle(obstacle, view, frame, out);
    else
        draw_band(obstacle, vec3_dot(axis, view->right), vec3_dot(axis, view->up), view, frame,
                  out);
}

/* Where what moves was before it came to its place after a step. */
static void draw_former(const CpsResults *results, const CpsiView *view, const CpsiFrame *frame,
                        int step, bool planes, FILE *out) {
    for (int k = 0; k < results->obstacle_count; ++k) {
        const CpsObstacle was = cpsi_results_obstacle(results, step, k);
        if (!was.moves || (was.kind == CPS_OBSTACLE_PLANE) != planes) continue;
        fputs("<g opacity=\"0.4\">", out);
        if (planes)
            draw_plane(&was, view, frame, out);
        else
            draw_round(&was, view, frame, out);
        fputs("</g>\n", out);
    }
}

void cpsi_picture_obstacles(const CpsResults *results, const CpsiView *view, const CpsiFrame *frame,
                            int step, FILE *out) {
    /* of all steps: where they end, and lightly where they began */
    const int now = step >= 0 ? step : results->row_count - 1, former = step >= 0 ? step - 1 : -1;
    draw_water(results, view, frame, out);
    draw_former(results, view, frame, former, true, out);
    for (int k = 0; k < results->obstacle_count; ++k) {
        const CpsObstacle obstacle = cpsi_results_obstacle(results, now, k);
        if (obstacle.kind == CPS_OBSTACLE_PLANE) draw_plane(&obstacle, view, frame, out);
        if (obstacle.kind == CPS_OBSTACLE_GROUND) cpsi_picture_ground(&obstacle, view, frame, out);
    }
    draw_former(results, view, frame, former, false, out);
    for (int k = 0; k < results->obstacle_count; ++k) {
        const CpsObstacle obstacle = cpsi_results_obstacle(results, now, k);
        if (obstacle.kind != CPS_OBSTACLE_CYLINDER && obstacle.kind != CPS_OBSTACLE_SPHERE &&
            !is_shape(&obstacle))
            continue;
        const Vec3 axis = unit(obstacle.axis);
        draw_round(&obstacle, view, frame, out);
        const bool end_on = hypot(vec3_dot(axis, view->right), vec3_dot(axis, view->up)) < END_ON;
        if (step >= 0 && end_on && !is_shape(&obstacle) && ever_turns(results, k))
            draw_spoke(&obstacle, cpsi_results_turned(results, step, k), view, frame, out);
    }
}
