/* SPDX-License-Identifier: BSD-3-Clause */
/* Unilateral contact along the normal n: s = gap + n.u >= 0 with reaction z >= 0, s z = 0.
 *
 * On a curved obstacle the reaction turns with the normal as the node moves along it (`curvature`,
 * see chain_program.h).
 *
 * Linearised: dz = q - (z/s) ds, ds = n.du + rho, rho = gap + n.u - s. So the node's block gains w
 * (z/s) n n^T: for a first contact in its entry zz, for a second contact as a second direction
 * (chain_system.h), or in all its entries where the matrix has no second directions. */
#include <math.h>

#include "base/larger.h"
#include "chain/elements.h"
#include "ipm/cone.h"

static void start(CpsiProgram *base, double mu, double margin) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiUnilateral *unilateral = &program->unilateral;
    for (int k = 0; k < unilateral->count; k++) {
        const double distance = unilateral->gap[k] + cpsi_unilateral_rise(unilateral, k, base->u);
        unilateral->s[k] = distance > margin ? distance : margin;
        unilateral->z[k] = mu / unilateral->s[k];
    }
}

/* Add by x n to the node's force. */
static inline void add_to_node(const CpsiUnilateral *unilateral, int k, double by, double *force) {
    double *f = &force[3 * unilateral->node[k]];
    if (!unilateral->normal || !unilateral->second[k])
        f[2] += by;
    else
        for (int a = 0; a < 3; a++) f[a] += by * unilateral->normal[k][a];
}

static void measure(CpsiProgram *base, CpsiSums *sums) {
    CpsiChainProgram *program = cpsi_chain(base);
    const CpsiUnilateral *unilateral = &program->unilateral;
    for (int k = 0; k < unilateral->count; k++) {
        const double rho = fabs(cpsi_unilateral_residual(program, k));
        sums->weight += unilateral->weight[k];
        sums->sz += unilateral->weight[k] * unilateral->s[k] * unilateral->z[k];
        sums->ray -= unilateral->weight[k] * unilateral->z[k] *
                     (unilateral->s[k] + cpsi_unilateral_residual(program, k));
        sums->residual = cpsi_max_nan(sums->residual, rho);
        if (unilateral->z[k] > sums->largest) sums->largest = unilateral->z[k];
        add_to_node(unilateral, k, unilateral->weight[k] * unilateral->z[k], base->residual);
        if (unilateral->curvature) {
            const double *b = unilateral->curvature[k], *u = &base->u[3 * unilateral->node[k]];
            double *residual = &base->residual[3 * unilateral->node[k]];
            residual[0] += unilateral->weight[k] * (b[0] * u[0] + b[1] * u[1] + b[3] * u[2]);
            residual[1] += unilateral->weight[k] * (b[1] * u[0] + b[2] * u[1] + b[4] * u[2]);
            residual[2] += unilateral->weight[k] * (b[3] * u[0] + b[4] * u[1] + b[5] * u[2]);
        }
    }
}

static void scale(CpsiProgram *base) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiUnilateral *unilateral = &program->unilateral;
    for (int k = 0; k < unilateral->count; k++) {
        const int node = unilateral->node[k];
        if (unilateral->curvature)
            for (int a = 0; a < 6; a++)
                program->matrix.diagonal[6 * node + a] -=
                    unilateral->weight[k] * unilateral->curvature[k][a];
        const double by = unilateral->weight[k] * unilateral->z[k] / unilateral->s[k];
        double *diagonal = &program->matrix.diagonal[6 * node];
        const double *n = unilateral->normal ? unilateral->normal[k] : NULL;
        const CpsiMatrixSecond *second = program->matrix.second;
        if (!n || !unilateral->second[k]) {
            diagonal[5] += by;
        } else if (second) {
            for (int a = 0; a < 3; a++)
                second->row[3 * node + a] = second->column[3 * node + a] = n[a];
            second->compliance[node] =
                unilateral->s[k] / (unilateral->weight[k] * unilateral->z[k]);
        } else {
            const double outer[6] = {n[0] * n[0], n[0] * n[1], n[1] * n[1],
                                     n[0] * n[2], n[1] * n[2], n[2] * n[2]};
            for (int a = 0; a < 6; a++) diagonal[a] += by * outer[a];
        }
    }
}

static void predict(CpsiProgram *base) {
    CpsiUnilateral *unilateral = &cpsi_chain(base)->unilateral;
    for (int k = 0; k < unilateral->count; k++) unilateral->q[k] = -unilateral->z[k];
}

static void load(CpsiProgram *base, double keep) {
    CpsiChainProgram *program = cpsi_chain(base);
    const CpsiUnilateral *unilateral = &program->unilateral;
    for (int k = 0; k < unilateral->count; k++)
        add_to_node(unilateral, k,
                    unilateral->weight[k] *
                        (unilateral->q[k] - unilateral->z[k] / unilateral->s[k] * keep *
                                                cpsi_unilateral_residual(program, k)),
                    base->du);
}

static void direct(CpsiProgram *base, double keep, bool predictor, CpsiSums *sums) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiUnilateral *unilateral = &program->unilateral;
    for (int k = 0; k < unilateral->count; k++) {
        const double s = unilateral->s[k], z = unilateral->z[k];
        const double rho = keep * cpsi_unilateral_residual(program, k);
        double ds = cpsi_unilateral_rise(unilateral, k, base->du) + rho,
               dz = unilateral->q[k] - z / s * ds;
        /* n is oblique to the axes of du: n.du has too few digits */
        if (program->matrix.second && unilateral->second[k] && z > s) {
            dz = unilateral->q[k] -
                 program->node_frames.second_reaction_change[unilateral->node[k]] /
                     unilateral->weight[k] -
                 z / s * rho;
            ds = (unilateral->q[k] - dz) * (s / z);
        }
        const double step_s = -ds / s, step_z = -dz / z, step = cpsi_max_nan(step_s, step_z);
        unilateral->ds[k] = ds;
        unilateral->dz[k] = dz;
        if (predictor) unilateral->q[k] = ds * dz / s;
        sums->inverse_step = cpsi_max_nan(sums->inverse_step, step);
    }
}

/* q with s o z -> target e, less the second-order term that stands in q, or without it. */
static void aim(CpsiProgram *base, double target, bool second_order) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiUnilateral *unilateral = &program->unilateral;
    for (int k = 0; k < unilateral->count; k++)
        unilateral->q[k] =
            -unilateral->z[k] + target / unilateral->s[k] - (second_order ? unilateral->q[k] : 0);
}

static void advance(CpsiProgram *base, double alpha) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiUnilateral *unilateral = &program->unilateral;
    cpsi_cone_advance((size_t)unilateral->count, alpha, unilateral->s, unilateral->ds,
                      unilateral->z, unilateral->dz);
}

const CpsiKind cpsi_unilateral = {start, measure, scale, predict, load, direct, aim, advance};
