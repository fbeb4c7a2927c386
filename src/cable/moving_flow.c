/* SPDX-License-Identifier: BSD-3-Clause */
/* The forces of the water on a line that moves (moving_flow.h).
 *
 * An element of length l and direction t has, for each of its nodes, half of Morison's drag with
 * w = U - v the velocity of the water in its middle relative to the node,
 *
 *     f = (l/2) (rho/2) d ( C_n |w_n| w_n + pi C_t |w_t| w_t ),
 *
 * whose negative derivative by v, C, is symmetric and nowhere negative, half of the mass A of the
 * water that is moved along, and with the mass M of the water that it displaces and the water's
 * acceleration b in waves half of (M + A) b. With v = (x - x*)/k all are written about a place y, t
 * and the water being those of y,
 *
 *     f(y) + (M + A) b(y) - (C/k) (x - y) - (A/k) ((x - x*)/k - v*),
 *
 * and added to the field of inertia. That is Newton's method in the velocity; the directions t
 * follow from one program to the next. The last forces are given loads of the step, whose
 * certificate is that with them; what they differ by from those of the last program is a load that
 * inertia takes up. */
#include "cable/moving_flow.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/larger.h"
#include "base/math.h"
#include "cable/field.h"
#include "cable/flow.h"
#include "cable/held.h"
#include "cable/inertia_field.h"
#include "linalg/symmetric.h"

/* Programs whose change is not below this share of the change before are accelerated. */
static const double SLOW = 0.5;
/* Roundings of places in the force of a field: half a unit each of the node's, and of three that
 * add up to the field's. */
static const double ROUNDINGS = 2;

/* The velocity of node j at the place x. */
static inline Vec3 velocity_of(const CpsiLine *line, const double *x, int j) {
    return vec3_scale(1 / line->inertia.span[j],
                      vec3_sub(vec3_at(x, j), vec3_at(line->reference, j)));
}

static inline void put(CpsiLane to[3], int l, Vec3 v) {
    to[0][l] = v.x;
    to[1][l] = v.y;
    to[2][l] = v.z;
}

static inline Vec3 take(const CpsiLane from[3], int l) {
    return vec3(from[0][l], from[1][l], from[2][l]);
}

/* What element e is like: where there is none, nothing. */
typedef struct Element {
    Vec3 t;
    CpsiWaterMotion water;
    double half; /* [m] of its length */
} Element;

static inline Element element_of(const CpsiLine *line, const double *x, int e) {
    if (e + 1 >= line->n) return (Element){.half = 0};
    const Vec3 from = vec3_at(x, e), to = vec3_at(x, e + 1), d = vec3_sub(to, from);
    const double size = vec3_norm(d);
    return (Element){vec3_scale(size > 0 ? 1 / size : 0, d),
                     cpsi_flow_motion(line->field.flow, vec3_scale(0.5, vec3_add(from, to))),
                     0.5 * line->natural_length[e]};
}

static inline void put_half(CpsiHalfElements *half, int l, const Element *element,
                            bool accelerated) {
    put(half->t, l, element->t);
    put(half->velocity, l, element->water.velocity);
    if (accelerated) put(half->acceleration, l, element->water.acceleration);
    half->length[l] = element->half;
}

CpsiWaterShare cpsi_water_share(const CpsiFlow *flow) {
    const CpsDrag *by = &flow->drag;
    const double pressed = 0.5 * flow->density * by->diameter,
                 displaced = 0.25 * CPSI_PI * flow->density * by->diameter * by->diameter;
    return (CpsiWaterShare){.across = pressed * by->normal,
                            .along = pressed * CPSI_PI * by->tangential,
                            .moved_across = displaced * by->added_normal,
                            .moved_along = displaced * by->added_tangential,
                            .displaced = displaced,
                            .is_accelerated = flow->waves || flow->given};
}

/* See what the water does to the line at the places x. */
static void see_water(const CpsiLine *line, const double *x) {
    const CpsiWaterShare share = cpsi_water_share(line->field.flow);
    CpsiNodesInWater nodes = {.velocity = {{0}}};
    Element before = {.half = 0};
    for (int first = 0; first < line->n; first += CPSI_LANES) {
        const int count = cpsi_lanes_count(line->n - first);
        for (int l = 0; l < count; l++) {
            const Element behind = element_of(line, x, first + l);
            put(nodes.velocity, l, velocity_of(line, x, first + l));
            put_half(&nodes.half[0], l, &before, share.is_accelerated);
            put_half(&nodes.half[1], l, &behind, share.is_accelerated);
            before = behind;
        }
        line->field.see(&nodes, &share, &line->field.seen[first / CPSI_LANES]);
    }
}

/* What was seen at one node. */
typedef struct NodeInWater {
    Vec3 drag, wave;
    double mass[6];
} NodeInWater;

static inline NodeInWater seen_at(const CpsiLine *line, int j) {
    const CpsiWaterForces *of = &line->field.seen[j / CPSI_LANES];
    const int l = j % CPSI_LANES;
    NodeInWater out = {take(of->drag, l), take(of->wave, l), {0}};
    for (int i = 0; i < 6; i++) out.mass[i] = of->mass[i][l];
    return out;
}

/* The force of the water that is moved along on node j, which is faster than v* by `faster`. */
static inline Vec3 added_force(const NodeInWater *seen, double rate, Vec3 faster) {
    return vec3_scale(-rate, cpsi_node_field_product(seen->mass, faster));
}

void cpsi_line_add_water_stiffness(const CpsiLine *line, int j, double k[6]) {
    const CpsiWaterForces *of = &line->field.seen[j / CPSI_LANES];
    const int l = j % CPSI_LANES;
    const double rate = 1 / line->inertia.span[j];
    for (int i = 0; i < 6; i++) k[i] += rate * (of->slope[i][l] + rate * of->mass[i][l]);
}

/* Write the field of inertia and water, which was seen there, about y at node j. */
static void write_node(CpsiLine *line, const double *y, int j) {
    const double rate = 1 / line->inertia.span[j];
    const NodeInWater seen = seen_at(line, j);
    const CpsiWaterForces *of = &line->field.seen[j / CPSI_LANES];
    double *k = &line->field.stiffness[6 * j], *place = &line->field.place[3 * j], slope[6], by[3];
    (void)cpsi_line_set_inertia(line, j, vec3_at(line->reference, j));
    const Vec3 off = vec3_sub(vec3_at(y, j), vec3_load(place));
    for (int i = 0; i < 6; i++) slope[i] = of->slope[i][j % CPSI_LANES];
    cpsi_line_add_water_stiffness(line, j, k);
    vec3_store(by, vec3_axpy(rate, cpsi_node_field_product(slope, off),
                             vec3_add(seen.drag, seen.wave)));
    if (cpsi_symmetric_solve(k, by))
        for (int a = 0; a < 3; a++) place[a] += by[a];
}

/* Write the field about the places y, where the water was seen. */
static void write(CpsiLine *line, const double *y) {
    for (int j = 0; j < line->n; j++) write_node(line, y, j);
}

void cpsi_line_see_swim(CpsiLine *line, const double *y) {
    see_water(line, y);
    write(line, y);
}

/* The size of the forces of inertia and water on node j. */
static double size_at(const CpsiLine *line, int j) {
    const CpsiInertia *inertia = &line->inertia;
    const NodeInWater seen = seen_at(line, j);
    const Vec3 change =
        vec3_sub(vec3_at(inertia->rest_velocity, j), vec3_at(inertia->start_velocity, j));
    return inertia->mass[j] / inertia->span[j] * vec3_norm(change) + vec3_norm(seen.drag) +
           vec3_norm(seen.wave);
}

void cpsi_line_begin_swim(CpsiLine *line) {
    const size_t numbers = 3 * (size_t)line->n * sizeof(double);
    double *place = line->field.rounds.from;
    memset(line->field.drag, 0, numbers); /* the programs have these forces in their field */
    memset(line->field.added, 0, numbers);
    memset(line->field.wave, 0, numbers);
    for (int j = 0; j < line->n; j++)
        vec3_store(&place[3 * j], cpsi_line_expected_place(line, j, vec3_at(line->reference, j)));
    cpsi_line_put_held(line, place);
    cpsi_line_see_swim(line, place);
    line->field.size = 0;
    for (int j = 0; j < line->n; j++) line->field.size += size_at(line, j);
    line->field.rounds.begun = false;
    line->field.rounds.count = 0;
    line->field.left = INFINITY;
}

double cpsi_line_swim_change(const CpsiLine *line, double *largest) {
    double changed = 0, most = 0;
    see_water(line, line->position);
    for (int j = 0; j < line->n; j++) {
        const NodeInWater seen = seen_at(line, j);
        const double rate = 1 / line->inertia.span[j];
        const Vec3 x = vec3_at(line->position, j),
                   v = vec3_scale(rate, vec3_sub(x, vec3_at(line->reference, j))),
                   faster = vec3_sub(v, vec3_at(line->inertia.rest_velocity, j)),
                   now = vec3_add(vec3_add(seen.drag, seen.wave), added_force(&seen, rate, faster)),
                   used = vec3_axpy(rate * line->inertia.mass[j], faster,
                                    cpsi_line_field_force(line, j, x));
        changed += vec3_norm(vec3_sub(now, used));
        most = cpsi_max_nan(most, vec3_norm(now));
    }
    *largest = most;
    return changed;
}

double cpsi_line_swim_rounding(const CpsiLine *line) {
    double sum = 0;
    for (int j = 0; j < line->n; j++) {
        const double *x = &line->position[3 * j], rate = 1 / line->inertia.span[j],
                     own = line->inertia.mass[j] * rate * rate;
        double k[6] = {own, 0, own, 0, 0, own};
        cpsi_line_add_water_stiffness(line, j, k);
        for (int i = 0; i < 6; i++) k[i] = fabs(k[i]);
        const Vec3 far = vec3(fabs(x[0]), fabs(x[1]), fabs(x[2]));
        sum += ROUNDINGS * DBL_EPSILON * vec3_norm(cpsi_node_field_product(k, far));
    }
    return sum;
}

void cpsi_line_approach_swim(CpsiLine *line, double left) {
    CpsiAnderson *rounds = &line->field.rounds;
    /* all nodes but the last one count: an element is as long as it is */
    if (rounds->begun || left > SLOW * line->field.left) {
        cpsi_anderson_accelerate(rounds, line->n, line->element_length, line->position);
        see_water(line, line->position);
    } else {
        cpsi_anderson_start(rounds, line->n, line->position);
    }
    line->field.left = left;
    write(line, line->position);
}

void cpsi_line_end_swim(CpsiLine *line, double left) {
    const double *x = line->position;
    line->field.left = left;
    for (int j = 0; j < line->n; j++) {
        const NodeInWater seen = seen_at(line, j);
        const Vec3 faster =
            vec3_sub(velocity_of(line, x, j), vec3_at(line->inertia.rest_velocity, j));
        vec3_store(&line->field.drag[3 * j], seen.drag);
        vec3_store(&line->field.added[3 * j],
                   added_force(&seen, 1 / line->inertia.span[j], faster));
        vec3_store(&line->field.wave[3 * j], seen.wave);
        (void)cpsi_line_set_inertia(line, j, vec3_at(line->reference, j));
    }
}

void cpsi_line_settle_swim(CpsiLine *line) {
    see_water(line, line->position);
    cpsi_line_end_swim(line, line->field.left);
}
