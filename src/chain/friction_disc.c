/* SPDX-License-Identifier: BSD-3-Clause */
/* Friction disc: dry friction with the disc of radius A as its set of forces, the cone (t, u) in Q3
 * with energy A t.
 *
 * u = o + B v, v the node's displacement, B zero along the normal: the set of forces on v is the
 * disc mapped by B^T, an ellipse, or a segment where B is singular; several discs on one node add
 * up to the sum of their sets. The equations below are in terms of u.
 *
 * t belongs to the element alone and is linear in the energy, so the first dual is A itself, dual
 * pair (A, F) in Q3: |F| <= A. Eliminating t from dz + H ds = q leaves, omega = |w1|^2, c = 2 w0/(1
 * + 2 omega):
 *
 *     dF = Q - M du - c w1 dA,     M = g (I - 2 w1 w1^T/(1 + 2 omega)),     Q = q1 + c w1 q0
 *     dt = ((q0 - dA)/g + 2 w0 w1.du)/(1 + 2 omega)
 *
 * M is stiff while the node sticks. Once it slips, the stiffness is g = A/|u| across the slip and
 * almost zero along it.
 *
 * There are two kinds of bound. With a fixed A (the frozen friction of S90), dA = 0 and the problem
 * is convex. With a coupled bound A = f R, where R is the dual of the unilateral contact, dA = f
 * dR and dR = q_R - (R/s)(n.du + rho), which is known once du is. This is Coulomb's law itself,
 * which is not the minimum of an energy: it adds c w1 f R/s times n to the node's block on the
 * right, rows x, y in the column z for n = z, and nothing on the left. */
#include <stdbool.h>

#include "base/larger.h"
#include "chain/elements.h"
#include "ipm/cone.h"

/* Where bounds are coupled: the direction of the bound f R of disc k, without the part that is
 * linear in n.du, and (bound_direction) all of it. */
static inline double bound_load(const CpsiChainProgram *program, int k, double keep) {
    const int i = program->disc.unilateral[k];
    if (!program->bounds_coupled) return 0;
    const CpsiUnilateral *unilateral = &program->unilateral;
    return program->disc.friction[k] *
           (unilateral->q[i] -
            unilateral->z[i] / unilateral->s[i] * keep * cpsi_unilateral_residual(program, i));
}

static inline double bound_direction(const CpsiChainProgram *program, int k) {
    const int i = program->disc.unilateral[k];
    return !program->bounds_coupled ? 0 : program->disc.friction[k] * program->unilateral.dz[i];
}

/* B where map is NULL. */
static const double PLAIN[6] = {1, 0, 0, 0, 1, 0};

/* u = o + B v (`whole`) or du = B v of disc k, for the displacement v of its node. */
static inline void slide(const CpsiFrictionDisc *disc, int k, const double v[3], bool whole,
                         double u[2]) {
    u[0] = v[0];
    u[1] = v[1];
    if (disc->map) {
        const double *b = disc->map[k];
        for (int a = 0; a < 2; a++)
            u[a] = b[3 * a] * v[0] + b[3 * a + 1] * v[1] + b[3 * a + 2] * v[2];
    }
    if (whole && disc->offset) {
        u[0] += disc->offset[k][0];
        u[1] += disc->offset[k][1];
    }
}

/* Add weight x B^T f to the node's force. */
static inline void add_to_node(const CpsiFrictionDisc *disc, int k, const double f[2],
                               double *force) {
    const double weight = disc->weight[k];
    if (disc->map) {
        const double *b = disc->map[k];
        for (int a = 0; a < 3; a++) force[a] += weight * (b[a] * f[0] + b[3 + a] * f[1]);
    } else {
        force[0] += weight * f[0];
        force[1] += weight * f[1];
    }
}

static void start(CpsiProgram *base, double mu, double margin) {
    CpsiChainProgram *program = cpsi_chain(base);
    (void)margin; /* mu and the iterate fix the pair */
    CpsiFrictionDisc *disc = &program->disc;
    for (int k = 0; k < disc->count; k++) {
        if (program->bounds_coupled)
            disc->z[k][0] = disc->friction[k] * program->unilateral.z[disc->unilateral[k]];
        const double bound = disc->z[k][0];
        double u[2];
        slide(disc, k, &base->u[3 * disc->node[k]], true, u);
        /* F = -beta A u/|u| with s o z = mu e:  |u| = mu beta/(A (1 - beta^2)),  t = mu/(A (1 -
         * beta^2)) */
        const double size = sqrt(u[0] * u[0] + u[1] * u[1]), ratio = 2 * size * bound / mu;
        const double beta = ratio / (1 + sqrt(1 + ratio * ratio)),
                     pull = size > 0 ? -beta * bound / size : 0;
        disc->s[k][0] = mu / (bound * (1 - beta) * (1 + beta));
        for (int a = 0; a < 2; a++) {
            disc->s[k][1 + a] = u[a];
            disc->z[k][1 + a] = pull * u[a];
        }
    }
}

static void measure(CpsiProgram *base, CpsiSums *sums) {
    const CpsiFrictionDisc *disc = &cpsi_chain(base)->disc;
    for (int k = 0; k < disc->count; k++) {
        const double *s = disc->s[k], *z = disc->z[k], weight = disc->weight[k];
        sums->weight += weight;
        sums->sz += weight * (s[0] * z[0] + s[1] * z[1] + s[2] * z[2]);
        sums->scale += weight * s[0] * z[0];
        sums->bound += weight * z[0];
        add_to_node(disc, k, &z[1], &base->residual[3 * disc->node[k]]);
    }
}

static void scale(CpsiProgram *base) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiFrictionDisc *disc = &program->disc;
    for (int k = 0; k < disc->count; k++) {
        const CpsiSocScaling scaling = cpsi_soc_scaling(disc->s[k], disc->z[k], 3);
        const double *w = scaling.w, g = scaling.g, weight = disc->weight[k];
        const double share = 1 / (1 + 2 * (w[1] * w[1] + w[2] * w[2]));
        const int node = disc->node[k], i = disc->unilateral[k];
        double *diagonal = &program->matrix.diagonal[6 * node];
        const double m[3] = {1 + 2 * w[2] * w[2], -2 * w[1] * w[2], 1 + 2 * w[1] * w[1]};
        if (disc->map)
            cpsi_add_mapped(diagonal, weight * g * share, disc->map[k], m);
        else
            for (int a = 0; a < 3; a++) diagonal[a] += weight * g * share * m[a];
        if (program->bounds_coupled) {
            const double *b = disc->map ? disc->map[k] : PLAIN;
            double across[3];
            for (int a = 0; a < 3; a++)
                across[a] = -2 * share * w[0] * (b[a] * w[1] + b[3 + a] * w[2]);
            cpsi_unilateral_couple_bound(program, i, weight, disc->friction[k], across);
        }
        for (int a = 0; a < 3; a++) disc->w[k][a] = w[a];
        disc->g[k] = g;
    }
}

static void predict(CpsiProgram *base) {
    CpsiFrictionDisc *disc = &cpsi_chain(base)->disc;
    for (int k = 0; k < disc->count; k++)
        for (int a = 0; a < 3; a++) disc->q[k][a] = -disc->z[k][a];
}

static void load(CpsiProgram *base, double keep) {
    const CpsiChainProgram *program = cpsi_chain(base);
    const CpsiFrictionDisc *disc = &program->disc;
    for (int k = 0; k < disc->count; k++) {
        const double *w = disc->w[k], *q = disc->q[k];
        const double pull = 2 * w[0] * (q[0] - bound_load(program, k, keep)) /
                            (1 + 2 * (w[1] * w[1] + w[2] * w[2]));
        const double force[2] = {q[1] + pull * w[1], q[2] + pull * w[2]};
        add_to_node(disc, k, force, &base->du[3 * disc->node[k]]);
    }
}

static void direct(CpsiProgram *base, double keep, bool predictor, CpsiSums *sums) {
    CpsiChainProgram *program = cpsi_chain(base);
    (void)keep; /* the direction of the unilateral element, already known, contains it */
    CpsiFrictionDisc *disc = &program->disc;
    for (int k = 0; k < disc->count; k++) {
        const double *w = disc->w[k], *q = disc->q[k], *z = disc->z[k];
        double du[2];
        slide(disc, k, &base->du[3 * disc->node[k]], false, du);
        const double g = disc->g[k], share = 1 / (1 + 2 * (w[1] * w[1] + w[2] * w[2]));
        double ds[3], dz[3];
        dz[0] = bound_direction(program, k);
        const double wu = w[1] * du[0] + w[2] * du[1],
                     pull = 2 * share * (w[0] * (q[0] - dz[0]) + g * wu);
        ds[0] = share * ((q[0] - dz[0]) / g + 2 * w[0] * wu);
        for (int a = 0; a < 2; a++) {
            ds[1 + a] = du[a];
            dz[1 + a] = q[1 + a] - g * du[a] + pull * w[1 + a];
        }
        if (!predictor)
            for (int a = 0; a < 3; a++) {
                disc->ds[k][a] = ds[a];
                disc->dz[k][a] = dz[a];
            }
        const double step = cpsi_soc_step(disc->q[k], predictor, w, g, z, ds, dz, 3);
        sums->inverse_step = cpsi_max_nan(sums->inverse_step, step);
    }
}

static void aim(CpsiProgram *base, double target, bool second_order) {
    CpsiFrictionDisc *disc = &cpsi_chain(base)->disc;
    for (int k = 0; k < disc->count; k++)
        cpsi_soc_correct(disc->q[k], disc->s[k], disc->z[k], target, second_order, 3);
}

static void advance(CpsiProgram *base, double alpha) {
    CpsiFrictionDisc *disc = &cpsi_chain(base)->disc;
    cpsi_cone_advance(3 * (size_t)disc->count, alpha, disc->s[0], disc->ds[0], disc->z[0],
                      disc->dz[0]);
}

const CpsiKind cpsi_friction_disc = {start, measure, scale, predict, load, direct, aim, advance};
