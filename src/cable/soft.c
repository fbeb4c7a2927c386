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

double cpsi_soft_stiffness(const CpsiLine *line, int c) {
    const CpsiObstacle *o = cpsi_line_obstacle(line, c);
    const int e = cpsi_line_element(line, c);
    if (!o || !(o->stiffness > 0)) return 0;
    /* a third contact of a node is that of the element before it */
    return stiffness_at(line, o, e < 0 ? cpsi_line_node(line, c) : e + 1);
}

double cpsi_soft_way_depth(const CpsiObstacle *obstacle, Vec3 x) {
    const double depth = fmax(0, -cpsi_obstacle_gap(obstacle, x));
    return cpsi_obstacle_kind_has_radius(obstacle->kind) && depth < 0.5 * obstacle->radius ? depth
                                                                                           : 0;
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

double cpsi_soft_energy(const CpsiLine *line, bool before) {
    double sum = 0;
    for (int k = 0; k < line->obstacle_count; k++) {
        const CpsiObstacle *o = &line->obstacle[k];
        for (int j = 0; j < line->n && o->stiffness > 0; j++) {
            const Vec3 at = vec3_at(line->position, j),
                       x = before ? cpsi_shift_carry(&line->shift[k], at) : at;
            const double depth = -cpsi_obstacle_gap(o, x);
            if (depth > 0 && !cpsi_line_is_held(line, j))
                sum += 0.5 * stiffness_at(line, o, j) * depth * depth;
        }
    }
    return sum;
}
