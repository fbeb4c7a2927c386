/* SPDX-License-Identifier: BSD-3-Clause */
/* Springs, given loads and drag of a line against its scene. */
#include <math.h>
#include <stdlib.h>

#include "compare.h"
#include "loads.h"

/* [m] What of the length of node j lies between two arc lengths. */
static double common_length(const Record *r, size_t j, double at, double from, double to) {
    const double before = j > 0 ? r->element_length[j - 1] : 0,
                 after = j < r->elements ? r->element_length[j] : 0;
    return fmax(0, fmin(at + after / 2, to) - fmax(at - before / 2, from));
}

/* Is node j, at the arc length `at`, the one that a single spring at s is on? */
static bool is_nearest(const Record *r, size_t j, double at, double s) {
    const double before = j > 0 ? r->element_length[j - 1] : INFINITY,
                 after = j < r->elements ? r->element_length[j] : INFINITY;
    return s >= at - before / 2 && s < at + after / 2;
}

/* Springs of node j: the sum of their stiffness, and of their K a. False: a is where the node
 * starts for some of them, which the file alone knows. */
static bool sum_springs(const CpsLine *line, const Record *r, size_t j, double at,
                        const double *origin, double *k, double *ka) {
    bool known = true;
    for (int i = 0; i < line->loads->spring_count; i++) {
        const CpsSpring *spring = &line->loads->spring[i];
        const double by = spring->from == spring->to
                              ? (is_nearest(r, j, at, spring->from) ? 1 : 0)
                              : common_length(r, j, at, spring->from, spring->to);
        known = known && (by == 0 || !spring->at_start);
        for (int a = 0; a < 3; a++) {
            k[a] += by * spring->stiffness[a];
            ka[a] += by * spring->stiffness[a] * (spring->place[a] - origin[a]);
        }
    }
    return known;
}

static bool compare_springs(Compare *compare, const CpsLine *line, const Record *r, size_t j,
                            double at) {
    static const double NEAR = 1e-9;
    double k[3] = {0}, ka[3] = {0}, most = 0, far = line->length;
    const bool known = sum_springs(line, r, j, at, compare->source.origin, k, ka);
    for (int i = 0; i < line->loads->spring_count; i++)
        for (int a = 0; a < 3; a++) {
            most = fmax(most, line->loads->spring[i].stiffness[a] * fmax(1, line->length));
            far = fmax(far, fabs(line->loads->spring[i].place[a]));
        }
    for (int a = 0; a < 3; a++) {
        const double found = r->loads->stiffness[j][a];
        const double pull = found * r->loads->place[j][a];
        if (fabs(found - k[a]) <= NEAR * most &&
            (!known || fabs(pull - ka[a]) <= NEAR * most * far))
            continue;
        find(compare, "springs of %s at node %zu: %.17g N/m, in the scene %.17g N/m", line->name, j,
             found, k[a]);
        return false;
    }
    return true;
}

void compare_node_loads(Compare *compare, const CpsLine *line, const Record *r, size_t step) {
    const CpsLineLoads *given = line->loads;
    const bool springs = given && given->spring_count > 0,
               drag = given && given->drag.diameter > 0 && compare->scene->current,
               forces = given && (given->force_count > 0 || drag);
    const Loads *loads = r->loads;
    if (springs != (loads && loads->stiffness) || forces != (loads && loads->given)) {
        find(compare, "springs or loads of %s", line->name);
        return;
    }
    if (drag != (loads && loads->has_drag)) find(compare, "drag of %s", line->name);
    double at = 0, off = 0, sizes = 0;
    if (!loads) return;
    for (size_t j = 0; j < r->nodes; j++) {
        at += j > 0 ? r->element_length[j - 1] : 0;
        if (springs && !compare_springs(compare, line, r, j, at)) return;
        if (!forces) continue;
        Real left[3];
        loads_drag(r, r->position, j, left);
        for (int a = 0; a < 3; a++) {
            left[a] -= loads->given[j][a];
            for (int i = 0; i < given->force_count; i++)
                left[a] += common_length(r, j, at, given->force[i].from, given->force[i].to) *
                           given->force[i].force[a];
            sizes += fabs(loads->given[j][a]);
        }
        off += (double)sqrtl(left[0] * left[0] + left[1] * left[1] + left[2] * left[2]);
    }
    /* what certified steps have used differs from what is there by no more than they say */
    const bool certified = r->outcome == OUTCOME_SOLVED || r->outcome == OUTCOME_TAUT;
    if (certified && forces && !(off <= 1.001 * loads->residual + 1e-10 * sizes))
        find(compare, "loads of %s, step %zu, are off by %.17g N where they are, said %.17g N",
             line->name, step, off, loads->residual);
}
