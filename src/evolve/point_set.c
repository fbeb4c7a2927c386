/* SPDX-License-Identifier: BSD-3-Clause */
/* Free points in convex sets (point_set.h).
 *
 * At a solution the reaction S balances the force r of all else, S = -r, and r is in the normal
 * cone of the set K at the place x: x = P(x + r/rho), P the nearest place of K and rho any
 * stiffness. In a trial S = -rho (z - P(z)), z = x + r/rho, which is in the normal cone at P(z);
 * what is left, r + S = rho (P(z) - x), vanishes at the solution alone. Its derivative has that of
 * P. */
#include "evolve/point_set.h"

#include <math.h>

#include "cable/end_set.h"
#include "cable/place_form.h"
#include "evolve/points.h"

/* Differences for the derivative of a projection that is known by its values, per distance from the
 * set and of the coordinates. */
static const double DIFFERENCE = 1e-5;

CpsiEndSet *cpsi_set_of_point(const CpsEvolution *evolution, int index) {
    CpsiEndSet *on = &evolution->points.point[index].on;
    return on->is_there && evolution->points.point[index].kind == CPS_POINT_KIND_FREE ? on : NULL;
}

/* Where the point would go without its set. */
static Vec3 beyond(const CpsiFree *at) { return vec3_axpy(1 / at->yields, at->rest, at->place); }

void cpsi_point_set_hold(CpsiFree *at, double soft) {
    at->yields = fmax(at->stiffness, soft);
    const Vec3 z = beyond(at), near = cpsi_end_set_project(at->on, z);
    double own[3];
    if (at->on->form)
        vec3_store(own, vec3_sub(near, z));
    else
        cpsi_place_set_back(&at->on->set, z, own);
    for (int a = 0; a < 3; a++) own[a] *= at->yields;
    at->hold = cpsi_place_set_from(&at->on->set, own);
    for (int a = 0; a < 3; a++) at->own_hold[a] = own[a];
    at->left = vec3_add(at->rest, at->hold); /* = rho (P(z) - x), and the sum as it is rounded */
}

void cpsi_point_set_derivative(const CpsiFree *at, double out[3][3]) {
    CpsiFree now = *at;
    cpsi_point_set_hold(&now, at->yields);
    const Vec3 z = beyond(&now);
    if (!at->on->form) {
        cpsi_place_set_slopes(&at->on->set, z, out);
        return;
    }
    const double step =
        DIFFERENCE * (vec3_norm(vec3_sub(z, cpsi_end_set_project(at->on, z))) + vec3_norm(z));
    double column[3][3];
    for (int b = 0; b < 3; b++) {
        const Vec3 e = vec3(b == 0, b == 1, b == 2);
        const Vec3 up = cpsi_end_set_project(at->on, vec3_axpy(step, e, z)),
                   down = cpsi_end_set_project(at->on, vec3_axpy(-step, e, z));
        vec3_store(column[b], vec3_scale(0.5 / step, vec3_sub(up, down)));
    }
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) out[a][b] = 0.5 * (column[a][b] + column[b][a]);
}

bool cpsi_point_set_is_kept(const CpsiBalance *balance, const CpsiFree *at) {
    const CpsEvolution *evolution = balance->evolution;
    if (!at->on) return true;
    const double touch = cpsi_trial_touch(balance, at);
    for (int k = 0; k < evolution->obstacle_count; k++)
        if (!(cpsi_obstacle_gap(&evolution->obstacle[k], at->place) >= -touch)) return false;
    return vec3_norm(vec3_sub(cpsi_end_set_project(at->on, at->place), at->place)) <= touch;
}
