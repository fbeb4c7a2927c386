/* SPDX-License-Identifier: BSD-3-Clause */
/* The nodes of a line along its start shape (see start.h). */
#include "evolve/start.h"

#include "evolve/ranges.h"

static Vec3 shape_point(const CpsLine *line, int i) { return vec3_at(line->start.point, i); }

double cpsi_start_length(const CpsLine *line) {
    if (line->start.kind == CPS_START_ARC || line->start.kind == CPS_START_STATIC)
        return cpsi_length_off_drums(line);
    double length = 0;
    for (int i = 1; i < line->start.point_count; i++)
        length += vec3_norm(vec3_sub(shape_point(line, i), shape_point(line, i - 1)));
    return length;
}

CpsiArc cpsi_start_arc(const CpsLine *line) {
    const Vec3 first = shape_point(line, 0), given = shape_point(line, 1);
    const Vec3 axis = vec3_load(line->start.axis), unit = vec3_scale(1 / vec3_norm(axis), axis);

    /* the circle's plane passes through the first node: move the centre along the axis into it */
    const Vec3 centre = vec3_axpy(vec3_dot(vec3_sub(first, given), unit), unit, given);
    const Vec3 spoke = vec3_sub(first, centre);
    const double radius = vec3_norm(spoke);
    const Vec3 e1 = vec3_scale(1 / radius, spoke);
    return (CpsiArc){.centre = centre, .e1 = e1, .e2 = vec3_cross(unit, e1), .radius = radius};
}

static bool is_placed(const CpsEnd *end) { return end->kind == CPS_END_KIND_HELD; }

/* ends of the first guess of a static line, of which at least one is held */
static void statics_guess(const CpsLine *line, Vec3 guess[2]) {
    for (int k = 0; k < 2; k++) guess[k] = vec3_load(line->end[k].value);
    for (int k = 0; k < 2; k++) {
        if (is_placed(&line->end[k])) continue;
        /* the value of a free end is its force; one without force hangs down */
        const double force = vec3_norm(guess[k]);
        const Vec3 pull = force > 0 ? vec3_scale(1 / force, guess[k]) : vec3(0, 0, -1);
        guess[k] = vec3_axpy(cpsi_length_off_drums(line), pull, guess[1 - k]);
    }
}

CpsiStartWalk cpsi_start_walk(const CpsLine *line) {
    CpsiStartWalk walk = {.line = line,
                          .stretch = cpsi_start_length(line) / cpsi_length_off_drums(line)};
    if (line->start.kind == CPS_START_ARC) walk.arc = cpsi_start_arc(line);
    if (line->start.kind == CPS_START_STATIC) {
        Vec3 guess[2];
        statics_guess(line, guess);
        walk.from = guess[0];
        walk.to = guess[1];
    }
    return walk;
}

/* [m] Natural length from end A to the next node, of what is off the drums. */
static double off_drums(const CpsiStartWalk *walk) {
    const CpsLine *line = walk->line;
    const double at = walk->natural - line->winch[CPS_END_A].stored;
    return fmin(fmax(at, 0), cpsi_length_off_drums(line));
}

/* the point of a polyline at the walk's abscissa, which never decreases; the last node is exactly
 * the last point */
static Vec3 polyline_point(CpsiStartWalk *walk) {
    const CpsLine *line = walk->line;
    const double target = off_drums(walk) * walk->stretch;
    for (; walk->piece + 1 < line->start.point_count; walk->piece++) {
        const Vec3 a = shape_point(line, walk->piece), b = shape_point(line, walk->piece + 1);
        const double length = vec3_norm(vec3_sub(b, a));
        if (walk->node < line->element_count && target <= walk->behind + length)
            return vec3_axpy(length > 0 ? (target - walk->behind) / length : 0, vec3_sub(b, a), a);
        walk->behind += length;
    }
    return shape_point(line, line->start.point_count - 1);
}

static Vec3 arc_point(const CpsiArc *arc, double angle) {
    const Vec3 x = vec3_axpy(arc->radius * cos(angle), arc->e1, arc->centre);
    return vec3_axpy(arc->radius * sin(angle), arc->e2, x);
}

/* On to the next node. Equal elements: by a product, so that the abscissa does not drift. */
static void go_on(CpsiStartWalk *walk) {
    const CpsLine *line = walk->line;
    const double l = cpsi_element_length(line, walk->node), before = off_drums(walk);
    walk->node++;
    walk->natural =
        line->element_length ? walk->natural + l : line->length * walk->node / line->element_count;
    if (line->start.kind != CPS_START_ARC) return;
    const bool has_winch = line->winch[CPS_END_A].is_there || line->winch[CPS_END_B].is_there;
    const double off = has_winch ? off_drums(walk) - before : l;
    walk->angle += 2 * asin(off / (2 * walk->arc.radius));
}

Vec3 cpsi_start_next(CpsiStartWalk *walk) {
    const CpsLine *line = walk->line;
    Vec3 x = {0, 0, 0};
    switch (line->start.kind) {
    case CPS_START_STRAIGHT:
    case CPS_START_POLYLINE: x = polyline_point(walk); break;
    case CPS_START_ARC: x = arc_point(&walk->arc, walk->angle); break;
    case CPS_START_NODES: x = shape_point(line, walk->node); break;
    case CPS_START_STATIC:
        x = vec3_axpy(off_drums(walk) / cpsi_length_off_drums(line), vec3_sub(walk->to, walk->from),
                      walk->from);
        if (walk->node == line->element_count) x = walk->to;
        break;
    }

    if (walk->node < line->element_count) go_on(walk);
    return x;
}

/* On to the last node, without the places of those before. */
static void to_last(CpsiStartWalk *walk) {
    while (walk->node < walk->line->element_count) go_on(walk);
}

void cpsi_start_place(const CpsLine *line, double *position) {
    CpsiStartWalk walk = cpsi_start_walk(line);
    for (int i = 0; i <= line->element_count; i++)
        vec3_store(&position[3 * i], cpsi_start_next(&walk));
}

void cpsi_start_end(const CpsLine *line, int end, double position[3]) {
    if (is_placed(&line->end[end])) {
        for (int i = 0; i < 3; i++) position[i] = line->end[end].value[i];
        return;
    }
    CpsiStartWalk walk = cpsi_start_walk(line);
    if (end == CPS_END_B) to_last(&walk);
    vec3_store(position, cpsi_start_next(&walk));
}
