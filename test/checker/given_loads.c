/* SPDX-License-Identifier: BSD-3-Clause */
/* Springs, given loads and drag of a line against its scene. */
#include <math.h>
#include <stdlib.h>

#include "compare.h"
#include "inertia.h"
#include "loads.h"

/* Of the water's motion: rounding of places far from the origin. */
static const double WATER = 1e-9;

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

/* The six numbers of K as a matrix. */
static void fill(const double *k, const double *c, double by, double m[3][3]) {
    const int row[3] = {0, 0, 1}, column[3] = {1, 2, 2};
    for (int a = 0; a < 3; a++) {
        m[a][a] += by * k[a];
        m[row[a]][column[a]] += by * c[a];
        m[column[a]][row[a]] += by * c[a];
    }
}

/* Springs of node j: the sum of their stiffness, and of their K a. False: a is where the node
 * starts for some of them, which the file alone knows. */
static bool sum_springs(const CpsLine *line, const Record *r, size_t j, double at,
                        const double *origin, double k[3][3], double *ka) {
    bool known = true;
    for (int i = 0; i < line->loads->spring_count; i++) {
        const CpsSpring *spring = &line->loads->spring[i];
        const double by = spring->from == spring->to
                              ? (is_nearest(r, j, at, spring->from) ? 1 : 0)
                              : common_length(r, j, at, spring->from, spring->to);
        double own[3][3] = {{0}};
        known = known && (by == 0 || !spring->at_start);
        fill(spring->stiffness, spring->coupling, by, own);
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) {
                k[a][b] += own[a][b];
                ka[a] += own[a][b] * (spring->place[b] - origin[b]);
            }
    }
    return known;
}

static bool compare_springs(Compare *compare, const CpsLine *line, const Record *r, size_t j,
                            double at) {
    static const double NEAR = 1e-9;
    double k[3][3] = {{0}}, found[3][3] = {{0}}, ka[3] = {0}, most = 0, far = line->length;
    const bool known = sum_springs(line, r, j, at, compare->source.origin, k, ka);
    for (int i = 0; i < line->loads->spring_count; i++)
        for (int a = 0; a < 3; a++) {
            most = fmax(most, line->loads->spring[i].stiffness[a] * fmax(1, line->length));
            far = fmax(far, fabs(line->loads->spring[i].place[a]));
        }
    fill(r->loads->stiffness[j], r->loads->coupling[j], 1, found);
    for (int a = 0; a < 3; a++) {
        double pull = 0;
        for (int b = 0; b < 3; b++) pull += found[a][b] * r->loads->place[j][b];
        bool same = !known || fabs(pull - ka[a]) <= NEAR * most * far;
        for (int b = 0; b < 3; b++) same = same && fabs(found[a][b] - k[a][b]) <= NEAR * most;
        if (same) continue;
        find(compare, "springs of %s at node %zu: %.17g N/m, in the scene %.17g N/m", line->name, j,
             found[a][a], k[a][a]);
        return false;
    }
    return true;
}

static void compare_drag(Compare *compare, const CpsLine *line, const Loads *loads) {
    const CpsDrag *drag = &line->loads->drag;
    const CpsCurrent *current = compare->scene->current;
    same_number(compare, "diameter in the current", line->name, loads->drag[0], drag->diameter);
    same_number(compare, "drag across", line->name, loads->drag[1], drag->normal);
    same_number(compare, "drag along", line->name, loads->drag[2], drag->tangential);
    same_number(compare, "water moved along across", line->name, loads->added[0],
                drag->added_normal);
    same_number(compare, "water moved along along", line->name, loads->added[1],
                drag->added_tangential);
    same_number(compare, "density about", line->name, loads->density, current->density);
    if (loads->rows != (size_t)current->row_count) {
        find(compare, "current: %zu rows, in the scene %d", loads->rows, current->row_count);
        return;
    }
    for (size_t k = 0; k < loads->rows; k++) {
        const CpsCurrentRow *row = &current->row[k];
        same_number(compare, "height of a row of the current", line->name, loads->row[4 * k],
                    row->z - compare->source.origin[2]);
        for (int a = 0; a < 3; a++)
            same_number(compare, "velocity in a row of the current", line->name,
                        loads->row[4 * k + 1 + (size_t)a], row->velocity[a]);
    }
}

void compare_waves(Compare *compare, const Sea *sea) {
    static const Real TAU = 6.283185307179586476925286766559L;
    const CpsCurrent *current = compare->scene->current;
    const CpsWaves *waves = current ? current->waves : NULL;
    if (sea->waves != (waves ? (size_t)waves->wave_count : 0)) {
        find(compare, "waves: %zu, in the scene %d", sea->waves, waves ? waves->wave_count : 0);
        return;
    }
    if (!waves) return;
    if (!(sea->depth == waves->depth)) find(compare, "depth of the waves");
    same_number(compare, "surface of the waves about", "the water", sea->surface,
                compare->scene->water_surface - compare->source.origin[2]);
    same_number(compare, "ramp of the waves about", "the water", sea->ramp, waves->ramp);
    for (size_t k = 0; k < sea->waves; k++) {
        const Wave *wave = &sea->wave[k];
        const CpsWave *of = &waves->wave[k];
        same_number(compare, "amplitude of a wave about", "the water", (double)wave->amplitude,
                    of->amplitude);
        same_number(compare, "period of a wave about", "the water", (double)(TAU / wave->frequency),
                    of->period);
        same_number(compare, "heading of a wave along x about", "the water",
                    (double)wave->heading[0], (double)cosl(of->direction));
        same_number(compare, "heading of a wave along y about", "the water",
                    (double)wave->heading[1], (double)sinl(of->direction));
        same_number(compare, "phase of a wave about", "the water", (double)wave->phase, of->phase);
    }
}

/* Add what the scene's function gives at a node. */
static void add_potential(Compare *compare, const CpsLine *line, const Record *r, size_t j,
                          double at, Real *sum) {
    const CpsPotential *given = &line->loads->potential;
    const double share = common_length(r, j, at, given->from, given->to);
    double x[3], gradient[3], second[6];
    for (int a = 0; a < 3; a++) x[a] = r->position[j][a] + compare->source.origin[a];
    const double energy = share * given->function(given->user, x, gradient, second);
    for (int a = 0; a < 3; a++) sum[a] -= (Real)share * gradient[a];
    if (!(fabs(energy - r->loads->energy[j]) <= 1e-9 * fabs(energy)))
        find(compare, "potential of %s: %.17g J at node %zu, by the scene %.17g J", line->name,
             r->loads->energy[j], j, energy);
}

/* The water of the file is that of current, waves and function. */
static void compare_water(Compare *compare, const CpsLine *line, const Record *r, size_t step) {
    const CpsCurrent *current = compare->scene->current;
    const bool given = current && current->function && r->loads->has_drag;
    if (given != (r->loads->water != NULL)) {
        find(compare, "water that a function moves about %s", line->name);
        return;
    }
    double off = 0, sizes = 0;
    const size_t elements = given && in_time(r) ? r->elements : 0;
    for (size_t i = 0; i < elements; i++) {
        Real middle[3], waves[3] = {0, 0, 0}, faster[3] = {0, 0, 0}, rows[3];
        double x[3], v[3] = {0, 0, 0}, rate[3] = {0, 0, 0};
        for (int a = 0; a < 3; a++) {
            middle[a] = ((Real)r->position[i][a] + r->position[i + 1][a]) / 2;
            x[a] = (double)(middle[a] + compare->source.origin[a]);
        }
        sea_motion(&r->loads->sea, r->time, middle, waves, faster);
        loads_current(r->loads, middle[2], rows);
        current->function(current->user, r->time, x, v, rate);
        for (int a = 0; a < 3; a++) {
            off = fmax(off, fabs((double)(waves[a] + rows[a]) + v[a] - r->loads->water[i][a]));
            off = fmax(off, fabs((double)faster[a] + rate[a] - r->loads->water_rate[i][a]));
            sizes = fmax(sizes, fmax(fabs(v[a]), fabs(rate[a])) + fabs(r->loads->water[i][a]));
        }
    }
    if (!(off <= WATER * sizes))
        find(compare, "water about %s, step %zu, is off by %.9g", line->name, step, off);
}

/* Add what the scene's function gives along the line at a node. */
static void add_function(const CpsLine *line, const Record *r, size_t j, double at, Real *sum) {
    double force[3] = {0, 0, 0};
    line->loads->force_function(line->loads->force_user, r->time, at, force);
    for (int a = 0; a < 3; a++) sum[a] += (Real)common_length(r, j, at, 0, line->length) * force[a];
}

void compare_node_loads(Compare *compare, const CpsLine *line, const Record *r, size_t step) {
    bool soft = false;
    for (int k = 0; k < compare->scene->obstacle_count; k++)
        soft = soft || compare->scene->obstacle[k].stiffness > 0;
    if (soft && step == 0)
        same_number(compare, "bearing width", line->name, r->bearing_width, line->bearing_width);
    const CpsLineLoads *given = line->loads;
    const bool potential = given && given->potential.function,
               springs = given && (given->spring_count > 0 || potential),
               drag = given && given->drag.diameter > 0 && compare->scene->current,
               forces =
                   given && (given->force_count > 0 || drag || potential || given->force_function);
    const Loads *loads = r->loads;
    if (springs != (loads && loads->stiffness) || forces != (loads && loads->given)) {
        find(compare, "springs or loads of %s", line->name);
        return;
    }
    if (potential != (loads && loads->pull)) find(compare, "potential of %s", line->name);
    if (drag != (loads && loads->has_drag)) find(compare, "drag of %s", line->name);
    if (drag && loads && loads->has_drag && step == 0) {
        compare_drag(compare, line, loads);
        compare_waves(compare, &loads->sea);
    }
    double at = 0, off = 0, sizes = 0;
    if (!loads) return;
    compare_water(compare, line, r, step);
    for (size_t j = 0; j < r->nodes; j++) {
        at += j > 0 ? r->element_length[j - 1] : 0;
        if (springs && !compare_springs(compare, line, r, j, at)) return;
        if (!forces) continue;
        Real left[3];
        loads_drag(r, r->position, j, left);
        if (in_time(r)) {
            const Flow flow = loads_flow(r, j);
            for (int a = 0; a < 3; a++) left[a] = flow.drag[a] + flow.added[a] + flow.wave[a];
        }
        if (potential && loads->pull) add_potential(compare, line, r, j, at, left);
        if (given->force_function) add_function(line, r, j, at, left);
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
    const double rounding = in_time(r) ? loads_rounding(r) : 0;
    if (certified && (drag || potential) &&
        !(loads->residual <=
          1.001 * compare->scene->solver.tolerance * r->claim[CLAIM_LARGEST_FORCE] + rounding))
        find(compare, "drag or potential of %s, step %zu: certified, but said to be off by %.17g N",
             line->name, step, loads->residual);
    if (certified && forces && !(off <= 1.001 * loads->residual + 1e-10 * sizes))
        find(compare, "loads of %s, step %zu, are off by %.17g N where they are, said %.17g N",
             line->name, step, off, loads->residual);
}
