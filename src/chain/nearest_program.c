/* SPDX-License-Identifier: BSD-3-Clause */
/* The two kinds of element that the nearest point adds to a chain (nearest_program.h).
 *
 * Spring: the objective, a stiffness h/V at each node. An axis that is not free gets so large a
 * stiffness that no direction has a part along it, and its residual does not count.
 *
 * Half-space: s = g + n.u >= 0 with dual z >= 0, s z = 0. Linearised dz = q - (z/s) ds, ds = n.du +
 * rho, rho = g + n.u - s. */
#include "chain/nearest_program.h"

#include <math.h>

#include "base/larger.h"

/* Stiffness of an axis that is not free, beside springs of order one and links of up to 1e16: the
 * remaining displacement along it is below the rounding of the others. */
static const double BLOCKED = 1e40;

static inline CpsiNearestProgram *nearest(CpsiProgram *base) { return (CpsiNearestProgram *)base; }

/* spring --------------------------------------------------------------------------------------- */

static void spring_start(CpsiProgram *base, double mu, double margin) {
    (void)base;
    (void)mu;
    (void)margin;
}

static void spring_measure(CpsiProgram *base, CpsiSums *sums) {
    const CpsiNearestProgram *program = nearest(base);
    for (int j = 0; j < program->chain.n; j++)
        for (int a = 0; a < 3; a++) {
            double *residual = &base->residual[3 * j + a];
            *residual = a < program->freedom[j]
                            ? *residual - program->weight[j] / program->size * base->u[3 * j + a]
                            : 0;
        }
    sums->bound +=
        1; /* a bounded dual, as friction has: the loop then takes its refinement steps */
}

static void spring_scale(CpsiProgram *base) {
    static const int DIAGONAL[3] = {0, 2, 5};
    const CpsiNearestProgram *program = nearest(base);
    for (int j = 0; j < program->chain.n; j++)
        for (int a = 0; a < 3; a++)
            program->chain.matrix.diagonal[6 * j + DIAGONAL[a]] +=
                a < program->freedom[j] ? program->weight[j] / program->size : BLOCKED;
}

static void spring_load(CpsiProgram *base, double keep) {
    (void)base;
    (void)keep;
}

static void spring_direct(CpsiProgram *base, double keep, bool predictor, CpsiSums *sums) {
    (void)base;
    (void)keep;
    (void)predictor;
    (void)sums;
}

static void spring_aim(CpsiProgram *base, double target) {
    (void)base;
    (void)target;
}

static const CpsiKind spring = {spring_start,  spring_measure, spring_scale, NULL,      spring_load,
                                spring_direct, spring_aim,     spring_aim,   spring_aim};

/* half-space ----------------------------------------------------------------------------------- */

static inline double rise(const CpsiHalfSpace *half, int k, const double *u) {
    const double *n = half->normal[k], *v = &u[3 * half->node[k]];
    return n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
}

static inline double residual_of(const CpsiNearestProgram *program, int k) {
    return program->half.gap[k] + rise(&program->half, k, program->chain.base.u) -
           program->half.s[k];
}

static inline void add_to_node(const CpsiHalfSpace *half, int k, double by, double *force) {
    for (int a = 0; a < 3; a++) force[3 * half->node[k] + a] += by * half->normal[k][a];
}

static void half_start(CpsiProgram *base, double mu, double margin) {
    CpsiHalfSpace *half = &nearest(base)->half;
    for (int k = 0; k < half->count; k++) {
        const double distance = half->gap[k] + rise(half, k, base->u);
        half->s[k] = distance > margin ? distance : margin;
        half->z[k] = mu / half->s[k];
    }
}

static void half_measure(CpsiProgram *base, CpsiSums *sums) {
    const CpsiNearestProgram *program = nearest(base);
    const CpsiHalfSpace *half = &program->half;
    for (int k = 0; k < half->count; k++) {
        const double rho = residual_of(program, k);
        sums->weight += half->weight[k];
        sums->sz += half->weight[k] * half->s[k] * half->z[k];
        sums->ray -= half->weight[k] * half->z[k] * (half->s[k] + rho);
        sums->residual = cpsi_max_nan(sums->residual, fabs(rho));
        sums->largest = cpsi_max_nan(sums->largest, half->z[k]);
        add_to_node(half, k, half->weight[k] * half->z[k], base->residual);
    }
}

static void half_scale(CpsiProgram *base) {
    const CpsiNearestProgram *program = nearest(base);
    const CpsiHalfSpace *half = &program->half;
    for (int k = 0; k < half->count; k++) {
        const double by = half->weight[k] * half->z[k] / half->s[k], *n = half->normal[k];
        const double outer[6] = {n[0] * n[0], n[0] * n[1], n[1] * n[1],
                                 n[0] * n[2], n[1] * n[2], n[2] * n[2]};
        for (int a = 0; a < 6; a++)
            program->chain.matrix.diagonal[6 * half->node[k] + a] += by * outer[a];
        half->q[k] = -half->z[k];
    }
}

static void half_load(CpsiProgram *base, double keep) {
    const CpsiNearestProgram *program = nearest(base);
    const CpsiHalfSpace *half = &program->half;
    for (int k = 0; k < half->count; k++)
        add_to_node(half, k,
                    half->weight[k] *
                        (half->q[k] - half->z[k] / half->s[k] * keep * residual_of(program, k)),
                    base->du);
}

static void half_direct(CpsiProgram *base, double keep, bool predictor, CpsiSums *sums) {
    CpsiNearestProgram *program = nearest(base);
    CpsiHalfSpace *half = &program->half;
    for (int k = 0; k < half->count; k++) {
        const double s = half->s[k], z = half->z[k];
        half->ds[k] = rise(half, k, base->du) + keep * residual_of(program, k);
        half->dz[k] = half->q[k] - z / s * half->ds[k];
        if (predictor) half->q[k] = half->ds[k] * half->dz[k] / s;
        sums->inverse_step =
            cpsi_max_nan(sums->inverse_step, cpsi_max_nan(-half->ds[k] / s, -half->dz[k] / z));
    }
}

static void half_aim(CpsiProgram *base, double target, bool second_order) {
    CpsiHalfSpace *half = &nearest(base)->half;
    for (int k = 0; k < half->count; k++)
        half->q[k] = -half->z[k] + target / half->s[k] - (second_order ? half->q[k] : 0);
}

static void half_correct(CpsiProgram *base, double target) { half_aim(base, target, true); }

static void half_centre(CpsiProgram *base, double target) { half_aim(base, target, false); }

static void half_advance(CpsiProgram *base, double alpha) {
    CpsiHalfSpace *half = &nearest(base)->half;
    for (int k = 0; k < half->count; k++) {
        half->s[k] += alpha * half->ds[k];
        half->z[k] += alpha * half->dz[k];
    }
}

static const CpsiKind half_space = {half_start,  half_measure, half_scale,  NULL,        half_load,
                                    half_direct, half_correct, half_centre, half_advance};

void cpsi_nearest_program_layout(CpsiNearestProgram *program, CpsiArena *arena, int n, int halves,
                                 const CpsiLinsysOps *ops) {
    /* the spring comes last: it clears the residuals of axes that are not free */
    static const CpsiKind *const kinds[] = {&cpsi_segment, &half_space, &spring};
    cpsi_chain_program_layout(&program->chain, arena, n, 1, false, NULL, ops);
    program->chain.base.kind = kinds;
    program->chain.base.kind_count = sizeof kinds / sizeof *kinds;
    program->chain.disc.count = program->chain.unilateral.count = program->chain.conic.count = 0;
    CpsiHalfSpace *half = &program->half;
    half->capacity = halves;
    half->node = CPSI_TAKE(arena, halves, int);
    half->weight = CPSI_TAKE(arena, halves, double);
    half->gap = CPSI_TAKE(arena, halves, double);
    half->normal = cpsi_arena_take(arena, (size_t)halves, sizeof *half->normal);
    half->s = CPSI_TAKE(arena, halves, double);
    half->z = CPSI_TAKE(arena, halves, double);
    half->q = CPSI_TAKE(arena, halves, double);
    half->ds = CPSI_TAKE(arena, halves, double);
    half->dz = CPSI_TAKE(arena, halves, double);
    program->weight = CPSI_TAKE(arena, n, double);
    program->freedom = CPSI_TAKE(arena, n, int);
}
