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

/* Programs whose change is not below this share of the change before are accelerated. */
static const double SLOW = 0.5;

/* a t t', a symmetric matrix as K of the field. */
static void set_square(double m[6], double a, Vec3 t) {
    const Vec3 s = vec3_scale(a, t);
    m[0] = s.x * t.x;
    m[1] = s.x * t.y;
    m[2] = s.y * t.y;
    m[3] = s.x * t.z;
    m[4] = s.y * t.z;
    m[5] = s.z * t.z;
}

/* Add a (I - q) + b q to the symmetric matrix m, q = t t'. */
static void add_directed(double m[6], double a, double b, const double q[6]) {
    for (int i = 0; i < 6; i++) m[i] += (b - a) * q[i];
    m[0] += a;
    m[2] += a;
    m[5] += a;
}

static void add_vector(double to[3], Vec3 v) { vec3_store(to, vec3_add(vec3_load(to), v)); }

/* The velocity of node j at the place x. */
static Vec3 velocity_of(const CpsiLine *line, const double *x, int j) {
    return vec3_scale(1 / line->inertia.span[j],
                      vec3_sub(vec3_at(x, j), vec3_at(line->reference, j)));
}

/* Add the drag of half an element along t, q = t t', whose pressure is `pressed`, on a node which
 * the water passes with w. */
static void add_drag(const CpsDrag *by, double pressed, Vec3 t, const double q[6], Vec3 w,
                     CpsiWaterForces *out) {
    const double way = vec3_dot(w, t), along = fabs(way);
    const Vec3 across = vec3_axpy(-way, t, w);
    const double fast = vec3_norm(across), normal = pressed * by->normal * fast,
                 tangential = pressed * CPSI_PI * by->tangential * along;
    add_vector(out->drag, vec3_axpy(tangential * way, t, vec3_scale(normal, across)));
    add_directed(out->slope, normal, 2 * tangential, q);
    if (!(fast > 0)) return;
    double more[6];
    set_square(more, normal / (fast * fast), across);
    for (int i = 0; i < 6; i++) out->slope[i] += more[i];
}

/* Add the water at element e of the line at the places x to what acts on its two nodes. */
static inline void see_element(const CpsiLine *line, const double *x, int e,
                               CpsiWaterForces out[2]) {
    const CpsiFlow *flow = line->field.flow;
    const CpsDrag *by = &flow->drag;
    const Vec3 from = vec3_at(x, e), to = vec3_at(x, e + 1), d = vec3_sub(to, from);
    const double size = vec3_norm(d), half = 0.5 * line->natural_length[e];
    const Vec3 t = vec3_scale(size > 0 ? 1 / size : 0, d);
    const double pressed = half * 0.5 * flow->density * by->diameter,
                 moved = half * flow->density * 0.25 * CPSI_PI * by->diameter * by->diameter;
    const CpsiWaterMotion water = cpsi_flow_motion(flow, vec3_scale(0.5, vec3_add(from, to)));
    double q[6], mass[6] = {0}, carried[6] = {0};
    set_square(q, 1, t);
    add_directed(mass, moved * by->added_normal, moved * by->added_tangential, q);
    for (int i = 0; i < 2; i++) {
        add_drag(by, pressed, t, q, vec3_sub(water.velocity, velocity_of(line, x, e + i)), &out[i]);
        for (int k = 0; k < 6; k++) out[i].mass[k] += mass[k];
    }
    if (!flow->waves && !flow->given) return;
    add_directed(carried, moved * (1 + by->added_normal), moved * (1 + by->added_tangential), q);
    const Vec3 wave = cpsi_node_field_product(carried, water.acceleration);
    for (int i = 0; i < 2; i++) add_vector(out[i].wave, wave);
}

/* See what the water does to the line at the places x. */
static void see_water(const CpsiLine *line, const double *x) {
    CpsiWaterForces on[2] = {0};
    for (int e = 0; e + 1 < line->n; e++) {
        see_element(line, x, e, on);
        line->field.seen[e] = on[0];
        on[0] = on[1];
        on[1] = (CpsiWaterForces){0};
    }
    line->field.seen[line->n - 1] = on[0];
}

/* The force of the water that is moved along, at the place x, where it was seen. */
static Vec3 added_force(const CpsiLine *line, const double *x, int j) {
    const Vec3 faster = vec3_sub(velocity_of(line, x, j), vec3_at(line->inertia.rest_velocity, j));
    return vec3_scale(-1 / line->inertia.span[j],
                      cpsi_node_field_product(line->field.seen[j].mass, faster));
}

/* Solve K x = b, K (6) symmetric, by K = L D L'. False where K is not positive definite. */
static bool solve_symmetric(const double k[6], double b[3]) {
    if (!(k[0] > 0)) return false;
    const double yx = k[1] / k[0], zx = k[3] / k[0], y = k[2] - yx * k[1];
    if (!(y > 0)) return false;
    const double zy = (k[4] - zx * k[1]) / y, z = k[5] - zx * k[3] - zy * zy * y;
    if (!(z > 0)) return false;
    b[1] -= yx * b[0];
    b[2] -= zx * b[0] + zy * b[1];
    b[2] /= z;
    b[1] = b[1] / y - zy * b[2];
    b[0] = b[0] / k[0] - yx * b[1] - zx * b[2];
    return true;
}

/* Write the field of inertia and water, which was seen there, about y at node j; returns the size
 * of its forces. */
static double write_node(CpsiLine *line, const double *y, int j) {
    const double span = line->inertia.span[j];
    double own = cpsi_line_set_inertia(line, j, vec3_at(line->reference, j));
    const CpsiWaterForces *water = &line->field.seen[j];
    const Vec3 drag = vec3_load(water->drag), wave = vec3_load(water->wave);
    double *k = &line->field.stiffness[6 * j], *place = &line->field.place[3 * j], by[3];
    const Vec3 off = vec3_sub(vec3_at(y, j), vec3_load(place));
    vec3_store(by, vec3_axpy(1 / span, cpsi_node_field_product(water->slope, off),
                             vec3_add(drag, wave)));
    for (int i = 0; i < 6; i++) k[i] += water->slope[i] / span + water->mass[i] / (span * span);
    if (solve_symmetric(k, by))
        for (int a = 0; a < 3; a++) place[a] += by[a];
    return own + vec3_norm(drag) + vec3_norm(wave);
}

/* Write the field about the places y, where the water was seen. */
static void write(CpsiLine *line, const double *y) {
    const size_t numbers = 3 * (size_t)line->n * sizeof(double);
    memset(line->field.drag, 0, numbers);
    memset(line->field.added, 0, numbers);
    memset(line->field.wave, 0, numbers);
    line->field.size = 0;
    for (int j = 0; j < line->n; j++) line->field.size += write_node(line, y, j);
}

void cpsi_line_begin_swim(CpsiLine *line) {
    double *place = line->field.rounds.from;
    for (int j = 0; j < line->n; j++)
        vec3_store(&place[3 * j], cpsi_line_expected_place(line, j, vec3_at(line->reference, j)));
    cpsi_line_put_held(line, place);
    see_water(line, place);
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
        const CpsiWaterForces *water = &line->field.seen[j];
        const Vec3 now = vec3_add(vec3_add(vec3_load(water->drag), vec3_load(water->wave)),
                                  added_force(line, line->position, j));
        const double span = line->inertia.span[j];
        const Vec3 off = vec3_sub(x, cpsi_line_free_place(line, j, reference)),
                   all = cpsi_line_field_force(line, j, x),
                   used = vec3_axpy(line->inertia.mass[j] / (span * span), off, all);
        changed += vec3_norm(vec3_sub(now, used));
        most = fmax(most, vec3_norm(now));
    }
    *largest = most;
    return changed;
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
        const CpsiWaterForces *water = &line->field.seen[j];
        memcpy(&line->field.drag[3 * j], water->drag, sizeof water->drag);
        vec3_store(&line->field.added[3 * j], added_force(line, x, j));
        memcpy(&line->field.wave[3 * j], water->wave, sizeof water->wave);
        (void)cpsi_line_set_inertia(line, j, vec3_at(line->reference, j));
    }
}

void cpsi_line_settle_swim(CpsiLine *line) {
    see_water(line, line->position);
    cpsi_line_end_swim(line, line->field.left);
}
