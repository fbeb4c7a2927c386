/* SPDX-License-Identifier: BSD-3-Clause */
/* Stop: unilateral contact along the normal n, s = gap + n.u >= 0 with reaction z >= 0, s z = 0.
 *
 * On a curved obstacle the reaction turns with the normal as the node moves along it (`curvature`,
 * see chain_program.h).
 *
 * Linearised: dz = q - (z/s) ds,  ds = n.du + rho,  rho = gap + n.u - s. So the node's block gains
 * w (z/s) n n^T: of a first stop at zz, of a second as a direction kept apart (linsys.h). */
#include <math.h>

#include "base/larger.h"
#include "ipm/elements.h"

static void start(CpsiProgram *base, double mu, double margin) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiStop *stop = &program->stop;
    for (int k = 0; k < stop->count; k++) {
        const double distance = stop->gap[k] + cpsi_stop_rise(stop, k, base->u);
        stop->s[k] = distance > margin ? distance : margin;
        stop->z[k] = mu / stop->s[k];
    }
}

/* Add by x n to the node's force. */
static inline void push(const CpsiStop *stop, int k, double by, double *force) {
    double *f = &force[3 * stop->node[k]];
    if (!stop->normal || !stop->second[k])
        f[2] += by;
    else
        for (int a = 0; a < 3; a++) f[a] += by * stop->normal[k][a];
}

static void measure(CpsiProgram *base, CpsiSums *sums) {
    CpsiChainProgram *program = cpsi_chain(base);
    const CpsiStop *stop = &program->stop;
    for (int k = 0; k < stop->count; k++) {
        const double rho = fabs(cpsi_stop_residual(program, k));
        sums->weight += stop->weight[k];
        sums->sz += stop->weight[k] * stop->s[k] * stop->z[k];
        sums->ray -= stop->weight[k] * stop->z[k] * (stop->s[k] + cpsi_stop_residual(program, k));
        sums->residual = cpsi_larger(sums->residual, rho);
        if (stop->z[k] > sums->largest) sums->largest = stop->z[k];
        push(stop, k, stop->weight[k] * stop->z[k], base->residual);
        if (stop->curvature) {
            const double *b = stop->curvature[k], *u = &base->u[3 * stop->node[k]];
            double *residual = &base->residual[3 * stop->node[k]];
            residual[0] += stop->weight[k] * (b[0] * u[0] + b[1] * u[1] + b[3] * u[2]);
            residual[1] += stop->weight[k] * (b[1] * u[0] + b[2] * u[1] + b[4] * u[2]);
            residual[2] += stop->weight[k] * (b[3] * u[0] + b[4] * u[1] + b[5] * u[2]);
        }
    }
}

static void scale(CpsiProgram *base) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiStop *stop = &program->stop;
    for (int k = 0; k < stop->count; k++) {
        const int node = stop->node[k];
        stop->q[k] = -stop->z[k];
        for (int a = 0; stop->curvature && a < 6; a++)
            program->matrix.diagonal[6 * node + a] -= stop->weight[k] * stop->curvature[k][a];
        if (!stop->normal || !stop->second[k]) {
            program->matrix.diagonal[6 * node + 5] += stop->weight[k] * stop->z[k] / stop->s[k];
            continue;
        }
        const CpsiMatrixSecond *second = &program->own.second;
        for (int a = 0; a < 3; a++)
            second->row[3 * node + a] = second->column[3 * node + a] = stop->normal[k][a];
        second->compliance[node] = stop->s[k] / (stop->weight[k] * stop->z[k]);
    }
}

static void load(CpsiProgram *base, double keep) {
    CpsiChainProgram *program = cpsi_chain(base);
    const CpsiStop *stop = &program->stop;
    for (int k = 0; k < stop->count; k++)
        push(stop, k,
             stop->weight[k] *
                 (stop->q[k] - stop->z[k] / stop->s[k] * keep * cpsi_stop_residual(program, k)),
             base->du);
}

static void direct(CpsiProgram *base, double keep, bool predictor, CpsiSums *sums) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiStop *stop = &program->stop;
    for (int k = 0; k < stop->count; k++) {
        const double s = stop->s[k], z = stop->z[k];
        const double rho = keep * cpsi_stop_residual(program, k);
        double ds = cpsi_stop_rise(stop, k, base->du) + rho, dz = stop->q[k] - z / s * ds;
        if (stop->second[k] && z > s) { /* n.du lies across the axes of du: too few digits */
            dz = stop->q[k] - program->own.press[stop->node[k]] / stop->weight[k] - z / s * rho;
            ds = (stop->q[k] - dz) * (s / z);
        }
        const double step_s = -ds / s, step_z = -dz / z, step = cpsi_larger(step_s, step_z);
        stop->ds[k] = ds;
        stop->dz[k] = dz;
        if (predictor) stop->q[k] = ds * dz / s;
        sums->inverse_step = cpsi_larger(sums->inverse_step, step);
    }
}

/* q with s o z -> target e, less the second-order term that stands in q, or without it. */
static void aim(CpsiProgram *base, double target, bool second_order) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiStop *stop = &program->stop;
    for (int k = 0; k < stop->count; k++)
        stop->q[k] = -stop->z[k] + target / stop->s[k] - (second_order ? stop->q[k] : 0);
}

static void correct(CpsiProgram *base, double target) { aim(base, target, true); }

static void centre(CpsiProgram *base, double target) { aim(base, target, false); }

static void advance(CpsiProgram *base, double alpha) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiStop *stop = &program->stop;
    for (int k = 0; k < stop->count; k++) {
        stop->s[k] += alpha * stop->ds[k];
        stop->z[k] += alpha * stop->dz[k];
    }
}

const CpsiKind cpsi_stop = {start, measure, scale, load, direct, correct, centre, advance};
