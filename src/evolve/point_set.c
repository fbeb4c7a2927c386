/* SPDX-License-Identifier: BSD-3-Clause */
/* Free points in convex sets (point_set.h).
 *
 * At a solution the reaction S balances the force r of all else, S = -r, and r is in the normal
 * cone of the set K at the place x: x = P(x + r/rho), P the nearest place of K and rho any
 * stiffness. In a trial S = -rho (z - P(z)), z = x + r/rho, which is in the normal cone at P(z);
 * what is left, r + S = rho (P(z) - x), vanishes at the solution alone. Its derivative has that of
 * P. */
#include "evolve/point_set.h"

#include "cable/end_set.h"

/* Differences for the derivative of a projection that is known by its values, per distance from the
 * set and of the coordinates. */
static const double DIFFERENCE = 1e-5;

/* Where the point would go without its set. */
static Vec3 beyond(const CpsiInSet *in) { return vec3_axpy(1 / in->yields, in->rest, in->place); }

Vec3 cpsi_in_set_hold(CpsiInSet *in) {
    const Vec3 z = beyond(in);
    if (in->on->form)
        vec3_store(in->own, vec3_sub(cpsi_end_set_project(in->on, z), z));
    else
        cpsi_place_set_back(&in->on->set, z, in->own);
    for (int a = 0; a < 3; a++) in->own[a] *= in->yields;
    in->reaction = cpsi_place_set_from(&in->on->set, in->own);
    return vec3_add(in->rest, in->reaction); /* rho (P(z) - x), as the sum is rounded */
}

void cpsi_in_set_slopes(const CpsiInSet *in, double out[3][3]) {
    const Vec3 z = beyond(in);
    if (!in->on->form) {
        cpsi_place_set_slopes(&in->on->set, z, out);
        return;
    }
    const double step =
        DIFFERENCE * (vec3_norm(vec3_sub(z, cpsi_end_set_project(in->on, z))) + vec3_norm(z));
    double column[3][3];
    for (int b = 0; b < 3; b++) {
        const Vec3 e = vec3(b == 0, b == 1, b == 2);
        const Vec3 up = cpsi_end_set_project(in->on, vec3_axpy(step, e, z)),
                   down = cpsi_end_set_project(in->on, vec3_axpy(-step, e, z));
        vec3_store(column[b], vec3_scale(0.5 / step, vec3_sub(up, down)));
    }
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) out[a][b] = 0.5 * (column[a][b] + column[b][a]);
}
