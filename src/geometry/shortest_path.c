/* SPDX-License-Identifier: BSD-3-Clause */
/* The least length of a polygonal line round an obstacle (shortest_path.h; docs/theory.md 5).
 *
 * Across the axis, or in the plane of a ball's centre and the two ends, with corners outside the
 * circle of radius R. The part c of an element inside the circle is pushed out to the arc on its
 * side, 2 R asin(c/(2 R)), longer by no more than 1/q, q = (c/(2 R))/asin(c/(2 R)) for the longest
 * c. So the polygon is at least as long as a curve outside the circle whose parts on it count q
 * times. Of those that turn by `turn` and meet the circle, the shortest runs along tangents of the
 * circle of radius q R and on that circle between them: with q R for the radius of a tangent t(r)
 * from distance r, and its angle g(r) at the centre,
 *
 *     t(r_a) + t(r_b) - 2 t(R) + q R (turn - g(r_a) - g(r_b) + 2 g(R)). */
#include "geometry/shortest_path.h"

/* Relative rounding error of coordinates about the obstacle and of arcs: about fifty roundings of
 * 2.2e-16. */
static const double ROUNDING = 1e-14;

/* The tangent to a circle about the origin from a point at the distance r: its length, and the
 * angle at the centre between the two. */
static double tangent(double radius, double r) {
    return r > radius ? sqrt((r - radius) * (r + radius)) : 0;
}
static double angle(double radius, double r) { return atan2(tangent(radius, r), radius); }

/* Least ratio of a chord inside the circle to its arc, for an element. */
static double chord_per_arc(double radius, CpsiPolygon polygon) {
    const double inside = radius > polygon.nearest
                              ? 2 * sqrt((radius - polygon.nearest) * (radius + polygon.nearest))
                              : 0;
    const double sine = fmin(1, 0.5 * fmin(polygon.length, inside) / radius);
    return sine > 0 ? sine / asin(sine) : 1;
}

/* [m] The least length of a curve outside the circle of radius R that meets it, turns by `turn`
 * from the distance ra to rb, and whose parts on the circle count r/R times. */
static double length_round(double R, double r, double ra, double rb, double turn) {
    const double arc = turn - angle(r, ra) - angle(r, rb) + 2 * angle(r, R);
    return tangent(r, ra) + tangent(r, rb) - 2 * tangent(r, R) + r * arc;
}

/* The tangent to the surface at the unit vector e, across the axis in the sense of the turn, or on
 * a ball towards b. */
static Vec3 forward_tangent(const CpsiObstacle *o, Vec3 e, Vec3 b, double turn) {
    if (o->kind == CPS_OBSTACLE_CYLINDER)
        return vec3_scale(turn < 0 ? -1 : 1, vec3_cross(o->frame.axis[2], e));
    Vec3 across = vec3_reject(b, e);
    for (int i = 0; i < 3 && !(vec3_norm(across) > ROUNDING * vec3_norm(b));
         i++) /* opposite points: all directions are equally long */
        across = vec3_reject(o->frame.axis[i], e);
    return vec3_scale(1 / vec3_norm(across), across);
}

bool cpsi_shortest_path(const CpsiObstacle *o, Vec3 a, Vec3 b, double turn, CpsiPolygon polygon,
                        CpsiShortestPath *out) {
    if (!cpsi_obstacle_is_round(o)) return false;
    const bool ball = o->kind == CPS_OBSTACLE_SPHERE;
    const Vec3 from = cpsi_obstacle_spoke(o, a), to = cpsi_obstacle_spoke(o, b);
    const double ra = vec3_norm(from), rb = vec3_norm(to), R = fmin(o->radius, fmin(ra, rb));
    /* an element that may span the whole circle lies on neither side of it */
    if (!(R > 0) || (polygon.nearest <= 0 && polygon.length >= 2 * R)) return false;
    const double round =
        ball ? atan2(vec3_norm(vec3_cross(from, to)), vec3_dot(from, to)) : fabs(turn);
    if (!(round > angle(R, ra) + angle(R, rb))) return false;
    const double q = chord_per_arc(R, polygon), r = q * R;
    const double level = length_round(R, r, ra, rb, round);
    const double rise = ball ? 0 : vec3_dot(vec3_sub(b, a), o->frame.axis[2]);
    const Vec3 e = vec3_scale(1 / ra, from),
               leaves = vec3_axpy(-tangent(R, ra) / ra, e,
                                  vec3_scale(R / ra, forward_tangent(o, e, to, turn)));
    out->length = hypot(level, rise);
    out->rounding = ROUNDING * (vec3_norm(vec3_sub(a, o->frame.point)) +
                                vec3_norm(vec3_sub(b, o->frame.point)) + R * round);
    out->leaves =
        vec3_scale(1 / out->length, vec3_axpy(rise, o->frame.axis[2], vec3_scale(level, leaves)));
    return true;
}

/* The polygon, its parts inside pushed out, meets the half-line at a distance d >= R. Its two
 * pieces turn by the angles between e and the ends, a right angle or more each, so both are longer
 * the larger d is: the least is that of d = R. */
bool cpsi_shortest_path_across(const CpsiObstacle *ball, Vec3 a, Vec3 b, Vec3 e,
                               CpsiPolygon polygon, double *length) {
    const Vec3 from = cpsi_obstacle_spoke(ball, a), to = cpsi_obstacle_spoke(ball, b);
    const double ra = vec3_norm(from), rb = vec3_norm(to), R = fmin(ball->radius, fmin(ra, rb));
    if (!(R > 0 && polygon.nearest > 0 && vec3_dot(from, e) <= 0 && vec3_dot(to, e) <= 0))
        return false;
    const double turn = atan2(vec3_norm(vec3_cross(from, e)), vec3_dot(from, e)) +
                        atan2(vec3_norm(vec3_cross(to, e)), vec3_dot(to, e));
    *length = length_round(R, chord_per_arc(R, polygon) * R, ra, rb, turn);
    return true;
}
