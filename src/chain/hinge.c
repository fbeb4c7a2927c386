/* SPDX-License-Identifier: BSD-3-Clause */
/* Hinges (network_program.h): an energy A max(0, h), h = d.x - gap, of a joint, whose force -R d
 * has R anywhere in [0, A] where h is 0.
 *
 * The private unknown p is to be at least 0 and at least h, and costs A p. The pairs are (p, A - R)
 * and (p - h, R); the two duals keep their sum A. Linearised, with rho = p - h - s of the second
 * pair,
 *
 *     dR (s0/z0 + s1/z1) = d.dx - rho + (s1/z1) q1 - (s0/z0) q0,
 *
 * so the joint's block gains w d d' over the bracket. */
#include <math.h>

#include "base/larger.h"
#include "chain/network_program.h"
#include "ipm/cone.h"

static CpsiHinges *hinges_of(CpsiProgram *program) {
    return &((CpsiNetworkProgram *)program)->hinges;
}

static double along(const CpsiHinges *hinges, int k, const double *u) {
    const double *x = &u[hinges->first[k]], *d = hinges->direction[k];
    return d[0] * x[0] + d[1] * x[1] + d[2] * x[2];
}

static void add(const CpsiHinges *hinges, int k, double by, double *force) {
    for (int a = 0; a < 3; a++) force[hinges->first[k] + a] += by * hinges->direction[k][a];
}

static double residual(const CpsiHinges *hinges, int k, const double *u) {
    return hinges->s[k][0] - (along(hinges, k, u) - hinges->gap[k]) - hinges->s[k][1];
}

/* 1 over s0/z0 + s1/z1 */
static double stiffness(const CpsiHinges *hinges, int k) {
    const double *s = hinges->s[k], *z = hinges->z[k];
    return 1 / (s[0] / z[0] + s[1] / z[1]);
}

/* What dR has beside d.dx. */
static double other(const CpsiHinges *hinges, int k, const double *u, double keep) {
    const double *s = hinges->s[k], *z = hinges->z[k], *q = hinges->q[k];
    return s[1] / z[1] * q[1] - s[0] / z[0] * q[0] - keep * residual(hinges, k, u);
}

/* The pairs with s z = mu at the iterate: mu/(A - R) - mu/R = h. */
static void start(CpsiProgram *program, double mu, double margin) {
    CpsiHinges *hinges = hinges_of(program);
    (void)margin; /* mu and the iterate fix the pairs */
    for (int k = 0; k < hinges->count; k++) {
        const double bound = hinges->bound[k],
                     t = (along(hinges, k, program->u) - hinges->gap[k]) * bound / mu,
                     root = hypot(t, 2);
        const int small = t > 0 ? 0 : 1; /* the smaller of the two duals */
        hinges->z[k][small] = bound * (1 + 2 / (root + fabs(t))) / (root + 2);
        hinges->z[k][1 - small] = bound - hinges->z[k][small];
        for (int i = 0; i < 2; i++) hinges->s[k][i] = mu / hinges->z[k][i];
    }
}

static void advance(const CpsiHinges *hinges, double alpha) {
    for (int k = 0; k < hinges->count; k++)
        cpsi_cone_advance(2, alpha, hinges->s[k], hinges->ds[k], hinges->z[k], hinges->dz[k]);
}

static void measure(CpsiProgram *program, double alpha, CpsiSums *sums) {
    const CpsiHinges *hinges = hinges_of(program);
    if (alpha != 0) advance(hinges, alpha);
    for (int k = 0; k < hinges->count; k++) {
        const double *s = hinges->s[k], *z = hinges->z[k], w = hinges->weight[k];
        add(hinges, k, -w * z[1], program->residual);
        sums->weight += 2 * w;
        sums->sz += w * (s[0] * z[0] + s[1] * z[1]);
        sums->scale += w * s[0] * hinges->bound[k];
        sums->bound += w * hinges->bound[k];
        sums->residual = cpsi_max_nan(sums->residual, fabs(residual(hinges, k, program->u)));
        sums->largest = cpsi_max_nan(sums->largest, hinges->bound[k]);
    }
}

static void scale(CpsiProgram *program) { (void)program; /* cpsi_hinges_factor does */ }

static void load(CpsiProgram *program, const CpsiIpmAim *aim) {
    const CpsiHinges *hinges = hinges_of(program);
    for (int k = 0; k < hinges->count; k++) {
        for (int i = 0; i < 2; i++)
            hinges->q[k][i] =
                cpsi_cone_aim_half_line(aim, hinges->s[k][i], hinges->z[k][i], hinges->q[k][i]);
        add(hinges, k,
            -hinges->weight[k] * stiffness(hinges, k) * other(hinges, k, program->u, aim->keep),
            program->du);
    }
}

static void direct(CpsiProgram *program, const CpsiIpmAim *aim, CpsiSums *sums) {
    CpsiHinges *hinges = hinges_of(program);
    for (int k = 0; k < hinges->count; k++) {
        double *s = hinges->s[k], *z = hinges->z[k], *q = hinges->q[k], *ds = hinges->ds[k],
               *dz = hinges->dz[k];
        dz[1] = stiffness(hinges, k) *
                (along(hinges, k, program->du) + other(hinges, k, program->u, aim->keep));
        dz[0] = -dz[1];
        for (int i = 0; i < 2; i++) {
            ds[i] = s[i] / z[i] * (q[i] - dz[i]);
            sums->inverse_step =
                cpsi_max_nan(sums->inverse_step, cpsi_max_nan(-ds[i] / s[i], -dz[i] / z[i]));
            if (aim->kind == CPSI_IPM_AIM_PREDICT) q[i] = ds[i] * dz[i] / s[i];
        }
    }
}

const CpsiKind cpsi_hinge = {start, measure, scale, load, direct};

void cpsi_hinges_add(const CpsiHinges *hinges, CpsiGraphMatrix *matrix) {
    for (int k = 0; k < hinges->count; k++) {
        const double by = hinges->weight[k] * stiffness(hinges, k), *d = hinges->direction[k];
        const int joint = hinges->first[k] / 3;
        const CpsiGraphBlock own = cpsi_graph_matrix_block(matrix, joint, joint);
        for (size_t i = 0; i < 3; i++)
            for (size_t j = 0; j < 3; j++) own.at[i * own.stride + j] += by * d[i] * d[j];
    }
}

void cpsi_hinges_layout(CpsiHinges *hinges, CpsiArena *arena, int count) {
    *hinges = (CpsiHinges){0};
    CPSI_PLACE(arena, hinges->first, count);
    CPSI_PLACE(arena, hinges->direction, count);
    CPSI_PLACE(arena, hinges->bound, count);
    CPSI_PLACE(arena, hinges->weight, count);
    CPSI_PLACE(arena, hinges->gap, count);
    CPSI_PLACE(arena, hinges->s, count);
    CPSI_PLACE(arena, hinges->z, count);
    CPSI_PLACE(arena, hinges->q, count);
    CPSI_PLACE(arena, hinges->ds, count);
    CPSI_PLACE(arena, hinges->dz, count);
}
