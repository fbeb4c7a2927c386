/* SPDX-License-Identifier: BSD-3-Clause */
/* Too short to reach round an obstacle (shortfall.h). The line does not pass the obstacle
 * (obstacle_side.h), so its turn about the axis of a cylinder is the turn at the beginning of the
 * step plus the angles of the held ends on their straight paths. A single element may be too long
 * to go round, whatever the side: then the rest of the line does not let it out of the way. */
#include "cable/shortfall.h"

#include "base/math.h"
#include "cable/contact.h"
#include "cable/line_solve.h"
#include "geometry/shortest_path.h"

/* The side of an element that comes nearer to the axis than this share of the radius is not
 * determined; the elements of a solution stay beyond three quarters. */
static const double TOO_NEAR = 0.5;

static const double ROUND = 2 * CPSI_PI;

/* Relative rounding error of coordinates about the obstacle: about fifty roundings of 2.2e-16. */
static const double ROUNDING = 1e-14;
/* Parts into which a share is narrowed down, each two thirds of the one before. */
enum { PARTS = 60 };

/* Does the obstacle keep a line out, and is it round? What gives does not. */
static bool is_hard_and_round(const CpsiObstacle *o) {
    return cpsi_obstacle_is_round(o) && !(o->stiffness > 0);
}

static Vec3 held_at(const CpsiLine *line, int end) { return vec3_load(line->end[end].value); }

/* Add the angle about the axis of obstacle o from one point to the next; false where the straight
 * path between them does not determine the side. */
static bool add_angle(const CpsiObstacle *o, Vec3 from, Vec3 to, double *sum) {
    if (!(cpsi_obstacle_depth(o, from, to) <= (1 - TOO_NEAR) * o->radius)) return false;
    *sum += cpsi_obstacle_angle(o, cpsi_obstacle_normal(o, from), cpsi_obstacle_normal(o, to));
    return true;
}

/* [rad] By which the line turns about the axis of a cylinder from A to B, where its ends are to be.
 * Whole turns are counted along the line, so that only the remainder has rounding. */
static bool turn_about(const CpsiLine *line, const CpsiObstacle *o, bool statics, double *turn) {
    const Vec3 a = held_at(line, CPS_END_A), b = held_at(line, CPS_END_B);
    const double rest =
        cpsi_obstacle_angle(o, cpsi_obstacle_normal(o, a), cpsi_obstacle_normal(o, b));
    double sum = 0;
    *turn = rest;
    if (statics || o->kind != CPS_OBSTACLE_CYLINDER) return true;
    Vec3 at = a;
    for (int j = 0; j < line->n; j++) {
        const Vec3 next = vec3_at(line->position, j);
        if (!add_angle(o, at, next, &sum)) return false;
        at = next;
    }
    if (!add_angle(o, at, b, &sum)) return false;
    *turn = rest + ROUND * round((sum - rest) / ROUND);
    return true;
}

/* [m] How far the point at a share of an element may be from the axis or centre. The straight line
 * between the held ends a and b has a point at the same share; each end of the element is no
 * farther from its end of that line than the elements in between are long. */
static double farthest(const CpsiObstacle *o, Vec3 a, Vec3 b, const double beside[2],
                       double share) {
    const Vec3 x = vec3_axpy(share, vec3_sub(b, a), a);
    return vec3_norm(cpsi_obstacle_spoke(o, x)) + (1 - share) * beside[0] + share * beside[1];
}

/* [m] The least of these over the element, by thirds: it is a convex function of the share, and
 * every value of it is a bound. */
static double farthest_of_nearest(const CpsiObstacle *o, Vec3 a, Vec3 b, const double beside[2]) {
    double low = 0, high = 1;
    for (int i = 0; i < PARTS; i++) {
        const double third = (high - low) / 3;
        if (farthest(o, a, b, beside, low + third) < farthest(o, a, b, beside, high - third))
            high -= third;
        else
            low += third;
    }
    return farthest(o, a, b, beside, 0.5 * (low + high));
}

/* Find the element that stays deepest in an obstacle: deeper than elements may, wherever its ends
 * are (docs/theory.md 5). With the ends outside the obstacle, only an element longer than the slack
 * of the line, its length less the distance of its ends, can be so. */
static void find_long_element(const CpsiLine *line, Vec3 a, Vec3 b, CpsiShortfall *out) {
    const double slack = line->length - vec3_norm(vec3_sub(b, a));
    for (int k = 0; k < line->obstacle_count; k++) {
        const CpsiObstacle *o = &line->obstacle[k];
        if (!is_hard_and_round(o)) continue;
        const double rounding = ROUNDING * (vec3_norm(vec3_sub(a, o->frame.point)) +
                                            vec3_norm(vec3_sub(b, o->frame.point)) + o->radius);
        for (int e = 0; e + 1 < line->n; e++) {
            const double l = line->element_length[e];
            if (!(l > slack)) continue;
            const double beside[2] = {line->arc_length[e], line->length - line->arc_length[e + 1]};
            const double deep =
                o->radius - cpsi_obstacle_allowance(o, l) - farthest_of_nearest(o, a, b, beside);
            if (deep > 2 * CPSI_TOUCH * line->length + rounding && deep > out->missing)
                *out = (CpsiShortfall){k, deep, vec3(0, 0, 0)};
        }
    }
}

bool cpsi_line_falls_short(const CpsiLine *line, const CpsiStepOptions *options,
                           CpsiShortfall *out) {
    if (line->compliance > 0 || !cpsi_line_both_ends(line, CPS_END_KIND_HELD) ||
        options->contact_policy != CPS_CONTACT_POLICY_REACHED)
        return false;
    const Vec3 a = held_at(line, CPS_END_A), b = held_at(line, CPS_END_B);
    const double allowed = line->length * (1 + CPSI_TAUT);
    if (vec3_norm(vec3_sub(b, a)) > allowed) return false;
    double longest = 0;
    for (int e = 0; e + 1 < line->n; e++) longest = fmax(longest, line->element_length[e]);
    *out = (CpsiShortfall){.obstacle = CPS_NO_OBSTACLE};
    for (int k = 0; k < line->obstacle_count; k++) {
        const CpsiObstacle *o = &line->obstacle[k];
        CpsiPolygon polygon = {longest, line->element_contacts > 0
                                            ? o->radius - cpsi_obstacle_allowance(o, longest)
                                            : 0};
        CpsiShortestPath path;
        double turn;
        if (!is_hard_and_round(o) || !turn_about(line, o, options->frictionless, &turn)) continue;
        if (!cpsi_shortest_path(o, a, b, turn, polygon, &path)) continue;
        const double missing = path.length - line->length;
        if (path.length - path.rounding > allowed && missing > out->missing)
            *out = (CpsiShortfall){k, missing, path.leaves};
    }
    if (out->obstacle < 0 && line->element_contacts > 0) find_long_element(line, a, b, out);
    return out->obstacle >= 0;
}
