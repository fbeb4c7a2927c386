/* SPDX-License-Identifier: BSD-3-Clause */
/* Obstacles that give (soft.h). */
#include "cable/soft.h"

bool cpsi_line_has_soft(const CpsiLine *line) {
    for (int k = 0; k < line->obstacle_count; k++)
        if (line->obstacle[k].stiffness > 0) return true;
    return false;
}

/* [N/m] What obstacle o opposes to node j. */
static double stiffness_at(const CpsiLine *line, const CpsiObstacle *o, int j) {
    return o->stiffness * line->bearing_width * cpsi_line_share(line, j);
}

/* The node of contact c: a third contact of a node is that of the element before it. */
static int node_at(const CpsiLine *line, int c) {
    const int e = cpsi_line_element(line, c);
    return e < 0 ? cpsi_line_node(line, c) : e + 1;
}

/* [m] How far the ground below contact c rises in the span of the step. */
static double rise_at(const CpsiLine *line, int c) {
    const int k = line->has_local_axes ? line->obstacle_index[c] : 0;
    if (!cpsi_line_is_shifted(line, k)) return 0;
    const Vec3 x = vec3_at(line->position, node_at(line, c));
    return vec3_dot(cpsi_shift_to(&line->shift[k], x), vec3_at(line->normal, c));
}

CpsiSoft cpsi_soft_damp(const CpsiObstacle *obstacle, double stiffness, double span, double past) {
    const double viscous = stiffness * (obstacle->damping / obstacle->stiffness) / span,
                 all = stiffness + viscous;
    return (CpsiSoft){all, all > 0 ? viscous / all * past : 0};
}

CpsiSoft cpsi_soft_spring(const CpsiLine *line, int c) {
    const CpsiObstacle *o = cpsi_line_obstacle(line, c);
    if (!o || !(o->stiffness > 0)) return (CpsiSoft){0};
    const int j = node_at(line, c);
    const double own = stiffness_at(line, o, j);
    if (!(o->damping > 0) || !line->inertia.is_moving) return (CpsiSoft){own, 0};
    const double past = fmax(0, -(line->gap[c] + rise_at(line, c)));
    return cpsi_soft_damp(o, own, line->inertia.span[j], isfinite(past) ? past : 0);
}

/* The place of node j on the obstacle as it is now, of where it was before the step. */
static Vec3 place_before(const CpsiLine *line, int k, int j, double length) {
    if (!cpsi_line_is_shifted(line, k)) return vec3_at(line->inertia.start, j);
    const double ratio = length / line->inertia.span[j];
    const CpsiShift whole = cpsi_shift_part(&line->shift[k], 1 - ratio, 1);
    return cpsi_shift_carry(&whole, vec3_at(line->inertia.start, j));
}

double cpsi_soft_depth(const CpsiObstacle *obstacle, Vec3 x) {
    return fmax(0, -cpsi_obstacle_gap(obstacle, x));
}

bool cpsi_soft_crosses(const CpsiObstacle *obstacle, Vec3 before, Vec3 now) {
    return obstacle->stiffness > 0 &&
           (cpsi_soft_depth(obstacle, now) > 0) != (cpsi_soft_depth(obstacle, before) > 0);
}

bool cpsi_soft_is_crossed(const CpsiLine *line, int j, double length) {
    bool crossed = false;
    for (int k = 0; k < line->obstacle_count; k++)
        crossed = crossed || cpsi_soft_crosses(&line->obstacle[k], place_before(line, k, j, length),
                                               vec3_at(line->position, j));
    return crossed;
}

double cpsi_soft_growth(const CpsiLine *line, int j, double length) {
    double sum = 0;
    for (int k = 0; k < line->obstacle_count && !cpsi_line_is_held(line, j); k++) {
        const CpsiObstacle *o = &line->obstacle[k];
        if (!(o->stiffness > 0)) continue;
        const double now = cpsi_soft_depth(o, vec3_at(line->position, j)),
                     was = cpsi_soft_depth(o, place_before(line, k, j, length));
        sum += 0.5 * stiffness_at(line, o, j) * (now - was) * (now + was);
    }
    return sum;
}

double cpsi_soft_damped(const CpsiLine *line, int c, double length) {
    const CpsiObstacle *o = cpsi_line_obstacle(line, c);
    if (!o || !(o->damping > 0)) return 0;
    const int j = node_at(line, c);
    const double now = cpsi_soft_depth(o, vec3_at(line->position, j)),
                 was = cpsi_soft_depth(o, place_before(line, (int)(o - line->obstacle), j, length));
    return (line->reaction[c] - stiffness_at(line, o, j) * now) * (now - was);
}

double cpsi_soft_way_depth(const CpsiObstacle *obstacle, Vec3 x) {
    const double depth = cpsi_soft_depth(obstacle, x);
    return cpsi_obstacle_kind_has_radius(obstacle->kind) ? fmin(depth, 0.5 * obstacle->radius) : 0;
}

double cpsi_soft_missed(const CpsiLine *line, int j) {
    double least = INFINITY;
    for (int k = 0; k < line->obstacle_count; k++) {
        if (!(line->obstacle[k].stiffness > 0)) continue;
        bool bears = false;
        for (int c = j; c < cpsi_line_contacts(line); c += line->n)
            bears = bears || cpsi_line_obstacle(line, c) == &line->obstacle[k];
        if (line->element_contacts > 0 && j > 0) {
            const int third = cpsi_line_contacts(line) + j - 1;
            bears = bears || (cpsi_line_is_third(line, third) && line->obstacle_index[third] == k);
        }
        if (!bears)
            least = fmin(least, cpsi_obstacle_gap(&line->obstacle[k], vec3_at(line->position, j)));
    }
    return least;
}

double cpsi_soft_per_length(const CpsiLine *line, int j, bool before) {
    const Vec3 at = vec3_at(line->position, j);
    double sum = 0;
    for (int k = 0; k < line->obstacle_count && !cpsi_line_is_held(line, j); k++) {
        const CpsiObstacle *o = &line->obstacle[k];
        if (!(o->stiffness > 0)) continue;
        const double depth =
            cpsi_soft_depth(o, before ? cpsi_shift_carry(&line->shift[k], at) : at);
        sum += 0.5 * o->stiffness * line->bearing_width * depth * depth;
    }
    return sum;
}

double cpsi_soft_energy(const CpsiLine *line, bool before) {
    double sum = 0;
    for (int j = 0; j < line->n; j++)
        sum += cpsi_line_share(line, j) * cpsi_soft_per_length(line, j, before);
    return sum;
}
