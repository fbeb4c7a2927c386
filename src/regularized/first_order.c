/* SPDX-License-Identifier: BSD-3-Clause */
/* P10.1 for given multipliers: gradient and Hessian (see first_order.h). */
#include "regularized/first_order.h"

#include <math.h>
#include <string.h>

#include "regularized/band_blocks.h"

void cpsi_first_order_store(CpsiFirstOrder *f, const double *u) {
    memcpy(f->u + 3, u, (size_t)f->unknowns * sizeof(double));
}

static Vec3 slope(const CpsiFirstOrder *f, int i) {
    return vec3_scale(1 / f->step->own.width[i], vec3_sub(vec3_at(f->u, i + 1), vec3_at(f->u, i)));
}

/* (84), plus the tension of the reference */
static Vec3 tension(const CpsiFirstOrder *f, int i) {
    const double k = 1 / f->step->compliance, s = f->stretch[i], e = f->strain[i];
    const Vec3 du = slope(f, i), t = vec3_at(f->tangent, i);
    return vec3_axpy(k * (e + vec3_dot(t, du) / s), t, vec3_scale(k * e / s, du));
}

void cpsi_first_order_slope(const CpsiFirstOrder *f, int element, double out[3]) {
    vec3_store(out, slope(f, element));
}

void cpsi_first_order_tension(const CpsiFirstOrder *f, int element, double out[3]) {
    vec3_store(out, tension(f, element));
}

/* ---- friction and contact ---- */

/* q + r u_T before its projection onto the disc, and R - r (n.u + gap) before it is limited to R >=
 * 0 */
static Vec3 pressed(const CpsiFirstOrder *f, int j, double *push) {
    const CpsiCells *c = &f->step->own;
    const Vec3 u = vec3_at(f->u, j), n = vec3_at(c->normal, j);
    const double across = vec3_dot(u, n), r = f->augment * c->share[j];
    *push = isfinite(f->gap[j]) ? f->push[j] - r * (across + f->gap[j]) : 0;
    return vec3_axpy(r, vec3_axpy(-across, n, u), vec3_at(f->friction_force, j));
}

void cpsi_first_order_multipliers(const CpsiFirstOrder *f, int j, double friction_force[3],
                                  double *push) {
    Vec3 z = pressed(f, j, push);
    const double length = vec3_norm(z), bound = f->step->own.bound[j];
    if (length > bound) z = vec3_scale(bound / length, z);
    vec3_store(friction_force, z);
    *push = fmax(0, *push);
}

/* ---- gradient ---- */

static void gradient(void *user, const double *x, double *g) {
    CpsiFirstOrder *f = user;
    const CpsiCells *c = &f->step->own;
    cpsi_first_order_store(f, x);
    memset(f->gradient, 0, 3 * ((size_t)c->cells + 1) * sizeof(double));
    for (int i = 0; i < c->cells; ++i) {
        const Vec3 pull = tension(f, i);
        cpsi_add(f->gradient, i, -1, pull);
        cpsi_add(f->gradient, i + 1, 1, pull);
    }
    for (int j = 0; j <= c->cells; ++j) {
        double friction_force[3], push;
        cpsi_first_order_multipliers(f, j, friction_force, &push);
        cpsi_add(f->gradient, j, -1, vec3_at(c->load, j));
        cpsi_add(f->gradient, j, 1, vec3_load(friction_force));
        cpsi_add(f->gradient, j, -push, vec3_at(c->normal, j));
        cpsi_add(f->gradient, j, f->anchor * c->share[j],
                 vec3_sub(vec3_at(f->u, j), vec3_at(f->before, j)));
    }
    memcpy(g, f->gradient + 3, (size_t)f->unknowns * sizeof(double));
}

/* ---- Hessian ---- */

static void add_block(const CpsiFirstOrder *f, double *a, int i, int j, double k, double l,
                      Vec3 d) {
    cpsi_add_block(a, CPSI_FIRST_ORDER_BAND, f->unknowns, i, j, k, l, d);
}

static void node_blocks(const CpsiFirstOrder *f, int j, double *a) {
    const CpsiCells *c = &f->step->own;
    double push;
    const Vec3 z = pressed(f, j, &push), n = vec3_at(c->normal, j);
    const double length = vec3_norm(z), r = f->augment * c->share[j];
    add_block(f, a, j, j, f->anchor * c->share[j], 0, n);
    if (push > 0) add_block(f, a, j, j, 0, r, n);
    if (c->bound[j] > 0) {
        const double k = length > c->bound[j] ? r * c->bound[j] / length : r;
        add_block(f, a, j, j, k, -k, n);
        if (length > c->bound[j]) add_block(f, a, j, j, 0, -k / (length * length), z);
    }
}

static void hessian(void *user, const double *x, double damping, double *a) {
    CpsiFirstOrder *f = user;
    const CpsiCells *c = &f->step->own;
    cpsi_first_order_store(f, x);
    for (int i = 0; i < c->cells; ++i) {
        const double k = 1 / f->step->compliance / f->stretch[i] / c->width[i];
        const double across = k * f->strain[i] + damping / c->width[i];
        const Vec3 t = vec3_at(f->tangent, i);
        add_block(f, a, i, i, across, k, t);
        add_block(f, a, i + 1, i + 1, across, k, t);
        add_block(f, a, i + 1, i, -across, -k, t);
    }
    for (int j = 1; j <= c->cells; ++j) node_blocks(f, j, a);
}

CpsiSmooth cpsi_first_order_smooth(CpsiFirstOrder *f) {
    return (CpsiSmooth){.unknowns = f->unknowns,
                        .band = CPSI_FIRST_ORDER_BAND,
                        .user = f,
                        .gradient = gradient,
                        .hessian = hessian,
                        .damping_unit = 1 / f->step->compliance};
}
