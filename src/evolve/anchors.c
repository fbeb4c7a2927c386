/* SPDX-License-Identifier: BSD-3-Clause */
/* Anchors (anchors.h). */
#include "evolve/anchors.h"

#include <math.h>

#include "geometry/obstacle.h"

Vec3 cpsi_anchor_normal(const CpsEvolution *evolution, int point) {
    const CpsiPoint *at = &evolution->points.point[point];
    const double touch = CPS_TOUCH * at->length;
    for (int k = 0; k < evolution->obstacle_count; k++) {
        const CpsiObstacle *on = &evolution->obstacle[k];
        if (!cpsi_obstacle_is_round(on) && cpsi_obstacle_gap(on, vec3_load(at->position)) <= touch)
            return cpsi_obstacle_normal(on, vec3_load(at->position));
    }
    const Vec3 down = vec3_load(evolution->gravity_given);
    const double size = vec3_norm(down);
    return size > 0 ? vec3_scale(-1 / size, down) : vec3(0, 0, 1);
}

void cpsi_anchor_use(const CpsEvolution *evolution, int point, Vec3 support,
                     CpsPointReport *report) {
    const CpsPoint *given = &evolution->points.given[point];
    if (!given->has_holding_capacity && !given->has_uplift_limit) return;
    const Vec3 normal = cpsi_anchor_normal(evolution, point);
    if (given->has_holding_capacity)
        report->capacity_used = vec3_norm(vec3_reject(support, normal)) / given->holding_capacity;
    if (given->has_uplift_limit)
        report->uplift_used = fmax(0, -vec3_dot(support, normal)) / given->uplift_limit;
}
