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

#include <math.h>
#include <string.h>

#include "base/math.h"
#include "cable/field.h"
#include "cable/flow.h"
#include "cable/held.h"
#include "cable/inertia_field.h"
#include "linalg/dense.h"

/* Programs whose change is not below this share of the change before are accelerated. */
static const double SLOW = 0.5;

/* What the water does to a node. */
typedef struct Water {
    Vec3 drag;       /* [N] */
    double slope[6]; /* [N s/m] C */
    double mass[6];  /* [kg] A */
    Vec3 wave;       /* [N] of the water's own acceleration */
} Water;

/* See the water in the middle of each element at the places x. */
static void see_water(const CpsiLine *line, const double *x) {
    for (int e = 0; e + 1 < line->n; e++) {
        const Vec3 middle = vec3_scale(0.5, vec3_add(vec3_at(x, e), vec3_at(x, e + 1)));
        const CpsiWaterMotion water = cpsi_flow_motion(line->field.flow, middle);
        vec3_store(&line->field.water[3 * e], water.velocity);
        vec3_store(&line->field.water_rate[3 * e], water.acceleration);
    }
}

/* Add a (I - t t') + b t t' to the symmetric matrix m. */
static void add_directed(double m[6], double a, double b, Vec3 t) {
    const double c = b - a;
    m[0] += a + c * t.x * t.x;
    m[1] += c * t.x * t.y;
    m[2] += a + c * t.y * t.y;
    m[3] += c * t.x * t.z;
    m[4] += c * t.y * t.z;
    m[5] += a + c * t.z * t.z;
}

/* Add the water of element e, which has been seen, on one of its nodes, with the velocity v. */
static void add_element(const CpsiLine *line, const double *x, int e, Vec3 v, Water *out) {
    if (e < 0 || e + 1 >= line->n) return;
    const CpsiFlow *flow = line->field.flow;
    const CpsDrag *by = &flow->drag;
    const Vec3 d = vec3_sub(vec3_at(x, e + 1), vec3_at(x, e));
    const double size = vec3_norm(d), half = 0.5 * line->natural_length[e];
    const Vec3 t = vec3_scale(size > 0 ? 1 / size : 0, d);
    const Vec3 w = vec3_sub(vec3_at(line->field.water, e), v), across = vec3_reject(w, t);
    const double fast = vec3_norm(across), along = fabs(vec3_dot(w, t));
    const double pressed = half * 0.5 * flow->density * by->diameter,
                 moved = half * flow->density * 0.25 * CPSI_PI * by->diameter * by->diameter;
    out->drag = vec3_axpy(half, cpsi_flow_drag(flow, w, d), out->drag);
    add_directed(out->slope, pressed * by->normal * fast,
                 2 * pressed * CPSI_PI * by->tangential * along, t);
    if (fast > 0)
        add_directed(out->slope, 0, pressed * by->normal * fast, vec3_scale(1 / fast, across));
    add_directed(out->mass, moved * by->added_normal, moved * by->added_tangential, t);
    if (!flow->waves && !flow->given) return;
    double carried[6] = {0};
    add_directed(carried, moved * (1 + by->added_normal), moved * (1 + by->added_tangential), t);
    out->wave =
        vec3_add(out->wave, cpsi_node_field_product(carried, vec3_at(line->field.water_rate, e)));
}

/* The velocity of node j at the place x. */
static Vec3 velocity_of(const CpsiLine *line, const double *x, int j) {
    return vec3_scale(1 / line->inertia.span[j],
                      vec3_sub(vec3_at(x, j), vec3_at(line->reference, j)));
}

/* What the water that has been seen at the places x does to node j there. */
static Water water_at(const CpsiLine *line, const double *x, int j) {
    Water out = {.drag = {0, 0, 0}};
    const Vec3 v = velocity_of(line, x, j);
    add_element(line, x, j - 1, v, &out);
    add_element(line, x, j, v, &out);
    return out;
}

/* The force of the water that is moved along, at the place x. */
static Vec3 added_force(const CpsiLine *line, const Water *water, const double *x, int j) {
    const Vec3 faster = vec3_sub(velocity_of(line, x, j), vec3_at(line->inertia.rest_velocity, j));
    return vec3_scale(-1 / line->inertia.span[j], cpsi_node_field_product(water->mass, faster));
}

/* Write the field of inertia and water about y at node j; returns the size of its forces. */
static double write_node(CpsiLine *line, const double *y, int j) {
    const double span = line->inertia.span[j];
    double own = cpsi_line_set_inertia(line, j, vec3_at(line->reference, j));
    const Water water = water_at(line, y, j);
    double *k = &line->field.stiffness[6 * j], *place = &line->field.place[3 * j];
    const Vec3 off = vec3_sub(vec3_at(y, j), vec3_load(place)),
               about = vec3_axpy(1 / span, cpsi_node_field_product(water.slope, off),
                                 vec3_add(water.drag, water.wave));
    for (int i = 0; i < 6; i++) k[i] += water.slope[i] / span + water.mass[i] / (span * span);
    double m[9] = {k[0], k[1], k[3], k[1], k[2], k[4], k[3], k[4], k[5]};
    double by[3] = {about.x, about.y, about.z};
    int pivot[3];
    if (cpsi_lu_factor(3, m, pivot)) {
        cpsi_lu_solve(3, m, pivot, by);
        for (int a = 0; a < 3; a++) place[a] += by[a];
    }
    return own + vec3_norm(water.drag) + vec3_norm(water.wave);
}

static void write(CpsiLine *line, const double *y) {
    const size_t numbers = 3 * (size_t)line->n * sizeof(double);
    memset(line->field.drag, 0, numbers);
    memset(line->field.added, 0, numbers);
    memset(line->field.wave, 0, numbers);
    line->field.size = 0;
    see_water(line, y);
    for (int j = 0; j < line->n; j++) line->field.size += write_node(line, y, j);
}

void cpsi_line_begin_swim(CpsiLine *line) {
    double *place = line->field.rounds.from;
    for (int j = 0; j < line->n; j++)
        vec3_store(&place[3 * j], cpsi_line_free_place(line, j, vec3_at(line->reference, j)));
    cpsi_line_put_held(line, place);
    write(line, place);
    line->field.rounds.begun = false;
    line->field.rounds.count = 0;
    line->field.left = INFINITY;
}

double cpsi_line_swim_change(const CpsiLine *line, double *largest) {
    double changed = 0, most = 0;
    see_water(line, line->position);
    for (int j = 0; j < line->n; j++) {
        const Vec3 x = vec3_at(line->position, j), reference = vec3_at(line->reference, j);
        const Water water = water_at(line, line->position, j);
        const Vec3 now = vec3_add(vec3_add(water.drag, water.wave),
                                  added_force(line, &water, line->position, j));
        const double span = line->inertia.span[j];
        const Vec3 off = vec3_sub(x, cpsi_line_free_place(line, j, reference)),
                   all = cpsi_line_field_force(line, j, x),
                   used = vec3_axpy(line->inertia.mass[j] / (span * span), off, all);
        changed += vec3_norm(vec3_sub(now, used));
        most = fmax(most, vec3_norm(now));
    }
    if (largest) *largest = most;
    return changed;
}

void cpsi_line_approach_swim(CpsiLine *line, double left) {
    CpsiAnderson *rounds = &line->field.rounds;
    /* all nodes but the last one count: an element is as long as it is */
    if (rounds->begun || left > SLOW * line->field.left)
        cpsi_anderson_accelerate(rounds, line->n, line->element_length, line->position);
    else
        cpsi_anderson_start(rounds, line->n, line->position);
    line->field.left = left;
    write(line, line->position);
}

void cpsi_line_settle_swim(CpsiLine *line, const double *x) {
    see_water(line, x);
    for (int j = 0; j < line->n; j++) {
        const Water water = water_at(line, x, j);
        vec3_store(&line->field.drag[3 * j], water.drag);
        vec3_store(&line->field.added[3 * j], added_force(line, &water, x, j));
        vec3_store(&line->field.wave[3 * j], water.wave);
        (void)cpsi_line_set_inertia(line, j, vec3_at(line->reference, j));
    }
}
