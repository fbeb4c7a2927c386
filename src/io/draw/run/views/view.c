/* SPDX-License-Identifier: BSD-3-Clause */
/* The directions of view of the pictures: plan views against gravity; elevations across the
 * direction in which bodies move, or the lines spread most, along a slope, which is then a straight
 * line, or along the axis of a cylinder, which is then a circle. All pictures of a run have the
 * same ones, so that steps can be compared; and one picture has each line in the vertical plane in
 * which its ends are after the first step. */
#include <math.h>
#include <string.h>

#include "io/draw/run/run_picture.h"

/* A widest direction this close to an axis is replaced by the axis: pictures of moorings then show
 * plain x or y. */
static const double SNAP_COSINE = 0.985; /* 10 degrees */

/* A plane with a smaller slope is drawn as level: the slope is not visible in a picture. */
static const double LEVEL = 1e-3;

/* A direction with no larger part along another one is across it. */
static const double ACROSS = 1e-9;

/* A cylinder counts as horizontal when its axis is at least this long as seen from above: at most
 * 25 degrees from the horizontal. */
static const double HORIZONTAL = 0.9;

/* A way of a body that is shorter than this share of the lines' spread is not visible. */
static const double VISIBLE = 1e-3;

/* Silhouettes up to this many times as wide as the lines are shown whole ... */
static const double MOST_ROUND = 2;
/* ... if they are no farther away than this share of the lines' spread. */
static const double NEAR = 0.5;

static Vec3 unit(Vec3 a) { return vec3_scale(1 / vec3_norm(a), a); }

/* against gravity; z without gravity */
static Vec3 upward(const CpsResults *results) {
    const Vec3 gravity = vec3_load(results->gravity);
    return vec3_norm(gravity) > 0 ? unit(vec3_scale(-1, gravity)) : vec3(0, 0, 1);
}

/* the horizontal part of x, or of y where x is vertical */
static Vec3 horizontal_x(Vec3 up) {
    const Vec3 axis = fabs(up.x) < 0.9 ? vec3(1, 0, 0) : vec3(0, 1, 0);
    return unit(vec3_reject(axis, up));
}

static void label_axis(char *out, size_t size, Vec3 a, const char *otherwise) {
    static const char *const NAME[] = {"x (m)", "y (m)", "z (m)"};
    const double component[] = {a.x, a.y, a.z};
    for (int i = 0; i < 3; ++i) {
        if (component[i] > 1 - 1e-12) {
            snprintf(out, size, "%s", NAME[i]);
            return;
        }
    }
    snprintf(out, size, "%s (%.2f, %.2f, %.2f) (m)", otherwise, a.x + 0.0, a.y + 0.0, a.z + 0.0);
}

/* Distance of a range from c - r .. c + r. */
static double apart(const double range[2], double c, double r) {
    return fmax(0, fmax(range[0] - (c + r), (c - r) - range[1]));
}

static bool is_round(const CpsObstacle *obstacle) {
    return obstacle->kind == CPS_OBSTACLE_CYLINDER || obstacle->kind == CPS_OBSTACLE_SPHERE;
}

/* A capsule, torus, cone or box, unless the lines would be too small beside it. */
static void include_shape(const CpsObstacle *obstacle, double spread, CpsiView *view) {
    CpsiView with = *view;
    view->true_scale = true;
    cpsi_shape_extend(obstacle, &with);
    if (hypot(with.x[1] - with.x[0], with.y[1] - with.y[0]) > 2 * MOST_ROUND * spread) return;
    memcpy(view->x, with.x, sizeof view->x);
    memcpy(view->y, with.y, sizeof view->y);
}

/* include round silhouettes where they are after a step, unless the lines would be too small beside
 * them */
static void include_round_at(const CpsResults *results, int step, double spread, CpsiView *view) {
    for (int k = 0; k < results->obstacle_count; ++k) {
        const CpsObstacle now = cpsi_results_obstacle(results, step, k), *obstacle = &now;
        int rows, columns;
        cpsi_shape_grid(obstacle, &rows, &columns);
        if (rows > 0) include_shape(obstacle, spread, view);
        if (!is_round(obstacle)) continue;
        view->true_scale = true;
        const Vec3 centre = vec3_load(obstacle->point);
        const double x = vec3_dot(view->right, centre), y = vec3_dot(view->up, centre),
                     r = obstacle->radius;
        const double away = hypot(apart(view->x, x, r), apart(view->y, y, r));
        if (!cpsi_obstacle_is_circle(obstacle, view) || r > MOST_ROUND * spread ||
            away > NEAR * spread)
            continue;
        cpsi_range_include(view->x, x - r);
        cpsi_range_include(view->x, x + r);
        cpsi_range_include(view->y, y - r);
        cpsi_range_include(view->y, y + r);
    }
}

/* ... at the start, and where lines are drawn */
static void include_round(const CpsResults *results, CpsiView *view) {
    const double spread = hypot(view->x[1] - view->x[0], view->y[1] - view->y[0]);
    cpsi_view_include_sets(results, MOST_ROUND * spread, view);
    include_round_at(results, -1, spread, view);
    for (int s = 0; s < results->snapshot_count; ++s)
        include_round_at(results, results->snapshot[s].step, spread, view);
}

/* Of one line, or of all (-1) the bodies at which it ends. */
static void include_bodies(const CpsResults *results, const CpsiRow *row, int line,
                           CpsiView *view) {
    for (int i = 0; i < results->body_count; ++i) {
        if (line >= 0 && !cpsi_results_is_on_body(results, row, line, i)) continue;
        const int corners = cpsi_body_corner_count(results, i);
        for (int k = 0; k < corners; ++k) {
            const Vec3 place = cpsi_body_corner(results, &row->body[i].report, i, k);
            cpsi_range_include(view->x, vec3_dot(view->right, place));
            cpsi_range_include(view->y, vec3_dot(view->up, place));
        }
    }
}

/* ranges over all snapshots, of the configurations and of the initial ones of their steps, of one
 * line or of all (-1) */
static void measure(const CpsResults *results, int line, CpsiView *view) {
    view->x[0] = view->y[0] = INFINITY;
    view->x[1] = view->y[1] = -INFINITY;
    double sum = 0, count = 0;
    for (int s = 0; s < results->snapshot_count; ++s) {
        for (int l = line < 0 ? 0 : line; l < (line < 0 ? results->line_count : line + 1); ++l) {
            const CpsiShape *shape = &results->snapshot[s].shape[l];
            for (size_t i = 0; i < (size_t)shape->points; ++i) {
                const Vec3 place = vec3_load(shape->position + 3 * i),
                           start = vec3_load(shape->reference + 3 * i);
                cpsi_range_include(view->x, vec3_dot(view->right, place));
                cpsi_range_include(view->x, vec3_dot(view->right, start));
                cpsi_range_include(view->y, vec3_dot(view->up, place));
                cpsi_range_include(view->y, vec3_dot(view->up, start));
                sum += vec3_dot(view->toward, place);
                count += 1;
            }
        }
        include_bodies(results, &results->row[results->snapshot[s].step], line, view);
    }
    view->cut = sum / count;
    if (results->has_water_surface && !view->plan)
        cpsi_range_include(view->y, results->water_surface * view->up.z);
    include_round(results, view);
}

CpsiView cpsi_view_plan(const CpsResults *results) {
    CpsiView view = {.plan = true, .toward = upward(results)};
    view.right = horizontal_x(view.toward);
    view.up = vec3_cross(view.toward, view.right);
    label_axis(view.x_label, sizeof view.x_label, view.right, "along");
    label_axis(view.y_label, sizeof view.y_label, view.up, "along");
    measure(results, -1, &view);
    return view;
}

/* angle of the widest spread in the plane (right, up): the main axis of the second moments of all
 * points */
static double widest_angle(const CpsResults *results, Vec3 right, Vec3 up) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    const Vec3 origin = vec3_load(results->snapshot[0].shape[0].position);
    for (int s = 0; s < results->snapshot_count; ++s) {
        for (int l = 0; l < results->line_count; ++l) {
            const CpsiShape *shape = &results->snapshot[s].shape[l];
            for (size_t i = 0; i < (size_t)shape->points; ++i) {
                const Vec3 place = vec3_sub(vec3_load(shape->position + 3 * i), origin);
                const double a = vec3_dot(right, place), b = vec3_dot(up, place);
                n += 1;
                x += a;
                y += b;
                xx += a * a;
                xy += a * b;
                yy += b * b;
            }
        }
    }
    return 0.5 * atan2(2 * (xy - x * y / n), (xx - x * x / n) - (yy - y * y / n));
}

/* the farthest way that a body is from where it was at the first step */
static Vec3 farthest_way(const CpsResults *results) {
    Vec3 farthest = vec3(0, 0, 0);
    for (int r = 1; r < results->row_count; ++r)
        for (int i = 0; i < results->body_count; ++i) {
            const Vec3 way = vec3_sub(vec3_load(results->row[r].body[i].report.position),
                                      vec3_load(results->row[0].body[i].report.position));
            if (vec3_norm(way) > vec3_norm(farthest)) farthest = way;
        }
    return farthest;
}

/* the longest straight distance between the ends of a line at the first step */
static double longest_chord(const CpsResults *results) {
    double longest = 0;
    for (int l = 0; l < results->line_count; ++l) {
        const CpsiShape *shape = &results->snapshot[0].shape[l];
        const double *last = shape->position + 3 * (size_t)(shape->points - 1);
        longest = fmax(longest, vec3_norm(vec3_sub(vec3_load(last), vec3_load(shape->position))));
    }
    return longest;
}

/* the direction of a slope, across a horizontal cylinder, of the bodies' way, or of the widest
 * spread, as an angle from east */
static double elevation_angle(const CpsResults *results, Vec3 east, Vec3 north) {
    /* at the start, and then where what moves ends */
    for (int i = 0; i < 2 * results->obstacle_count; ++i) {
        const int k = i % results->obstacle_count,
                  step = i < results->obstacle_count ? -1 : results->row_count - 1;
        const CpsObstacle now = cpsi_results_obstacle(results, step, k), *obstacle = &now;
        if ((obstacle->kind != CPS_OBSTACLE_PLANE && obstacle->kind != CPS_OBSTACLE_CYLINDER) ||
            obstacle->shape.inside)
            continue;
        const bool plane = obstacle->kind == CPS_OBSTACLE_PLANE;
        const Vec3 d = unit(vec3_load(plane ? obstacle->normal : obstacle->axis));
        const double e = vec3_dot(d, east), n = vec3_dot(d, north), x = plane ? e : n,
                     y = plane ? n : -e;
        if (hypot(x, y) > (plane ? LEVEL : HORIZONTAL)) return x < 0 ? atan2(-y, -x) : atan2(y, x);
    }
    const Vec3 way = farthest_way(results);
    const double e = vec3_dot(way, east), n = vec3_dot(way, north);
    if (hypot(e, n) > VISIBLE * longest_chord(results)) return e < 0 ? atan2(-n, -e) : atan2(n, e);
    return widest_angle(results, east, north);
}

CpsiView cpsi_view_elevation(const CpsResults *results) {
    CpsiView view = {.up = upward(results)};
    const Vec3 east = horizontal_x(view.up), north = vec3_cross(view.up, east);
    const double angle = elevation_angle(results, east, north);
    const double c = cos(angle), s = sin(angle);
    view.right = vec3_axpy(c, east, vec3_scale(s, north));
    if (c > SNAP_COSINE) view.right = east;
    if (fabs(s) > SNAP_COSINE) view.right = north;
    view.toward = vec3_cross(view.right, view.up);
    label_axis(view.x_label, sizeof view.x_label, view.right, "distance along");
    label_axis(view.y_label, sizeof view.y_label, view.up, "height along");
    measure(results, -1, &view);
    return view;
}

CpsiView cpsi_view_line(const CpsResults *results, int line) {
    CpsiView view = {.up = upward(results)};
    const Vec3 east = horizontal_x(view.up), north = vec3_cross(view.up, east);
    const CpsiShape *shape = &results->snapshot[0].shape[line];
    const Vec3 chord = vec3_sub(vec3_load(shape->position + 3 * (size_t)(shape->points - 1)),
                                vec3_load(shape->position)),
               level = vec3_reject(chord, view.up);
    view.right = vec3_norm(level) > LEVEL * vec3_norm(chord) ? unit(level) : east;
    const double e = vec3_dot(view.right, east);
    if (e < -ACROSS || (e < ACROSS && vec3_dot(view.right, north) < 0))
        view.right = vec3_scale(-1, view.right);
    view.toward = vec3_cross(view.right, view.up);
    label_axis(view.x_label, sizeof view.x_label, view.right, "distance along");
    label_axis(view.y_label, sizeof view.y_label, view.up, "height along");
    measure(results, line, &view);
    return view;
}
