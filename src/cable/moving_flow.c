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

#include "base/larger.h"
#include "base/math.h"
#include "cable/field.h"
#include "cable/flow.h"
#include "cable/held.h"
#include "cable/inertia_field.h"
#include "chain/halves.h"
#include "linalg/symmetric.h"

/* Programs whose change is not below this share of the change before are accelerated. */
static const double SLOW = 0.5;

/* The velocity of node j at the place x. */
static inline Vec3 velocity_of(const CpsiLine *line, const double *x, int j) {
    return vec3_scale(1 / line->inertia.span[j],
                      vec3_sub(vec3_at(x, j), vec3_at(line->reference, j)));
}

/* What acts on the two nodes of an element, side by side; the rest is the same for both. */
typedef struct OfElement {
    CpsiHalves drag[3], slope[6];
    double mass[6], wave[3];
} OfElement;

/* Half an element: its direction, and the drag across and along per velocity squared. */
typedef struct HalfElement {
    CpsiHalves t[3];
    double across, along; /* [kg/m] */
} HalfElement;

/* m = a I + b s s' + c t t', a symmetric matrix as K of the field. */
CPSI_HALVES_FUNCTION void set_slope(CpsiHalves m[6], CpsiHalves a, CpsiHalves b,
                                    const CpsiHalves s[3], CpsiHalves c, const CpsiHalves t[3]) {
    static const int ROW[6] = {0, 1, 1, 2, 2, 2}, COLUMN[6] = {0, 0, 1, 0, 1, 2};
    CpsiHalves bs[3], ct[3];
    for (int i = 0; i < 3; i++) {
        bs[i] = b * s[i];
        ct[i] = c * t[i];
    }
    for (int i = 0; i < 6; i++) m[i] = bs[ROW[i]] * s[COLUMN[i]] + ct[ROW[i]] * t[COLUMN[i]];
    m[0] += a;
    m[2] += a;
    m[5] += a;
}

/* The drag of half an element on its nodes, which the water passes with w. */
CPSI_HALVES_FUNCTION void set_drag(const HalfElement *half, const CpsiHalves w[3], OfElement *out) {
    const CpsiHalves none = {0, 0}, way = cpsi_halves_dot(w, half->t);
    CpsiHalves across[3];
    for (int i = 0; i < 3; i++) across[i] = w[i] - way * half->t[i];
    const CpsiHalves square = cpsi_halves_dot(across, across),
                     fast = {sqrt(square[0]), sqrt(square[1])}, normal = half->across * fast,
                     tangential = half->along * cpsi_halves_abs(way), along = tangential * way,
                     over = cpsi_halves_choose(fast > none, half->across / fast, none);
    for (int i = 0; i < 3; i++) out->drag[i] = along * half->t[i] + normal * across[i];
    set_slope(out->slope, normal, over, across, 2 * tangential - normal, half->t);
}

/* The water at element e of the line at the places x, whose nodes have the velocities v. */
static inline void see_element(const CpsiLine *line, const double *x, int e, const Vec3 v[2],
                               OfElement *out) {
    const CpsiFlow *flow = line->field.flow;
    const CpsDrag *by = &flow->drag;
    const Vec3 from = vec3_at(x, e), to = vec3_at(x, e + 1), d = vec3_sub(to, from);
    const double size = vec3_norm(d), length = 0.5 * line->natural_length[e] * flow->density,
                 pressed = length * 0.5 * by->diameter,
                 moved = length * 0.25 * CPSI_PI * by->diameter * by->diameter,
                 across = moved * by->added_normal, along = moved * by->added_tangential;
    const Vec3 t = vec3_scale(size > 0 ? 1 / size : 0, d);
    const CpsiWaterMotion water = cpsi_flow_motion(flow, vec3_scale(0.5, vec3_add(from, to)));
    const Vec3 w[2] = {vec3_sub(water.velocity, v[0]), vec3_sub(water.velocity, v[1])};
    const HalfElement half = {{{t.x, t.x}, {t.y, t.y}, {t.z, t.z}},
                              pressed * by->normal,
                              pressed * CPSI_PI * by->tangential};
    const CpsiHalves passes[3] = {{w[0].x, w[1].x}, {w[0].y, w[1].y}, {w[0].z, w[1].z}};
    set_drag(&half, passes, out);
    const Vec3 more = vec3_scale(along - across, t);
    const double mass[6] = {across + more.x * t.x, more.x * t.y, across + more.y * t.y,
                            more.x * t.z,          more.y * t.z, across + more.z * t.z};
    memcpy(out->mass, mass, sizeof mass);
    if (!flow->waves && !flow->given) return;
    const Vec3 b = water.acceleration;
    vec3_store(out->wave, vec3_axpy(moved, b, cpsi_node_field_product(mass, b)));
}

/* See what the water does to the line at the places x. */
static void see_water(const CpsiLine *line, const double *x) {
    OfElement of[2] = {0};
    Vec3 v[2] = {velocity_of(line, x, 0)};
    for (int j = 0; j < line->n; j++) {
        const OfElement *before = &of[(j + 1) % 2], *after = &of[j % 2];
        CpsiWaterForces *seen = &line->field.seen[j];
        if (j + 1 < line->n) {
            v[1] = velocity_of(line, x, j + 1);
            see_element(line, x, j, v, &of[j % 2]);
            v[0] = v[1];
        } else {
            of[j % 2] = (OfElement){0};
        }
        for (int i = 0; i < 3; i++) {
            seen->drag[i] = before->drag[i][1] + after->drag[i][0];
            seen->wave[i] = before->wave[i] + after->wave[i];
        }
        for (int i = 0; i < 6; i++) {
            seen->slope[i] = before->slope[i][1] + after->slope[i][0];
            seen->mass[i] = before->mass[i] + after->mass[i];
        }
    }
}

/* The force of the water that is moved along, at the place x, where it was seen. */
static Vec3 added_force(const CpsiLine *line, const double *x, int j) {
    const Vec3 faster = vec3_sub(velocity_of(line, x, j), vec3_at(line->inertia.rest_velocity, j));
    return vec3_scale(-1 / line->inertia.span[j],
                      cpsi_node_field_product(line->field.seen[j].mass, faster));
}

/* Write the field of inertia and water, which was seen there, about y at node j; returns the size
 * of its forces. */
static double write_node(CpsiLine *line, const double *y, int j) {
    const double rate = 1 / line->inertia.span[j];
    const double own = cpsi_line_set_inertia(line, j, vec3_at(line->reference, j));
    const CpsiWaterForces *water = &line->field.seen[j];
    const Vec3 drag = vec3_load(water->drag), wave = vec3_load(water->wave);
    double *k = &line->field.stiffness[6 * j], *place = &line->field.place[3 * j], by[3];
    const Vec3 off = vec3_sub(vec3_at(y, j), vec3_load(place));
    vec3_store(by,
               vec3_axpy(rate, cpsi_node_field_product(water->slope, off), vec3_add(drag, wave)));
    for (int i = 0; i < 6; i++) k[i] += rate * (water->slope[i] + rate * water->mass[i]);
    if (cpsi_symmetric_solve(k, by))
        for (int a = 0; a < 3; a++) place[a] += by[a];
    return own + vec3_norm(drag) + vec3_norm(wave);
}

/* Write the field about the places y, where the water was seen. */
static void write(CpsiLine *line, const double *y) {
    line->field.size = 0;
    for (int j = 0; j < line->n; j++) line->field.size += write_node(line, y, j);
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
        const CpsiWaterForces *water = &line->field.seen[j];
        const double rate = 1 / line->inertia.span[j];
        const Vec3 x = vec3_at(line->position, j),
                   v = vec3_scale(rate, vec3_sub(x, vec3_at(line->reference, j))),
                   faster = vec3_sub(v, vec3_at(line->inertia.rest_velocity, j)),
                   moved = cpsi_node_field_product(water->mass, faster),
                   seen = vec3_add(vec3_load(water->drag), vec3_load(water->wave)),
                   now = vec3_axpy(-rate, moved, seen),
                   used = vec3_axpy(rate * line->inertia.mass[j], faster,
                                    cpsi_line_field_force(line, j, x));
        changed += vec3_norm(vec3_sub(now, used));
        most = cpsi_max_nan(most, vec3_norm(now));
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
