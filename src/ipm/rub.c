/* SPDX-License-Identifier: BSD-3-Clause */
/* Rub: dry friction with the disc of radius A as its set of forces, the cone (t, u) in Q3 with energy A t.
 *
 * t is private and linear in the energy, so the first dual is the constant A, dual pair (A, F) in Q3: |F| <= A. Eliminating t
 * from dz + H ds = q with dz0 = 0 leaves, omega = |w1|^2:
 *
 *     dF = Q - M du,     M = g (I - 2 w1 w1^T/(1 + 2 omega)),     Q = q1 + 2 w0 w1 q0/(1 + 2 omega)
 *     dt = (q0/g + 2 w0 w1.du)/(1 + 2 omega)
 *
 * M is stiff while the node sticks; once it slips, g = A/|u| acts across the slip and almost nothing along it. */
#include "base/larger.h"
#include "cone/soc.h"
#include "ipm/chain_program.h"

static void start(CpsiProgram *base, double mu, double margin) {
    (void)margin; /* mu and the iterate fix the pair */
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiRub *rub = &program->rub;
    for (int k = 0; k < rub->count; k++) {
        const double *u = &base->u[3*rub->node[k]], bound = rub->z[k][0];
        /* F = -beta A u/|u| with s o z = mu e:  |u| = mu beta/(A (1 - beta^2)),  t = mu/(A (1 - beta^2)) */
        const double size = sqrt(u[0]*u[0] + u[1]*u[1]), ratio = 2*size*bound/mu;
        const double beta = ratio/(1 + sqrt(1 + ratio*ratio)), pull = size > 0 ? -beta*bound/size : 0;
        rub->s[k][0] = mu/(bound*(1 - beta)*(1 + beta));
        for (int a = 0; a < 2; a++) rub->s[k][1 + a] = u[a], rub->z[k][1 + a] = pull*u[a];
    }
}

static void measure(CpsiProgram *base, CpsiSums *sums) {
    CpsiChainProgram *program = cpsi_chain(base);
    const CpsiRub *rub = &program->rub;
    for (int k = 0; k < rub->count; k++) {
        const double *s = rub->s[k], *z = rub->z[k], weight = rub->weight[k];
        double *residual = &base->residual[3*rub->node[k]];
        sums->weight += weight;
        sums->sz += weight*(s[0]*z[0] + s[1]*z[1] + s[2]*z[2]);
        sums->scale += weight*s[0]*z[0];
        sums->bound += weight*z[0];
        residual[0] += weight*z[1];
        residual[1] += weight*z[2];
    }
}

static void scale(CpsiProgram *base) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiRub *rub = &program->rub;
    for (int k = 0; k < rub->count; k++) {
        const CpsiSocScaling scaling = cpsi_soc_scaling(rub->s[k], rub->z[k], 3);
        const double *w = scaling.w, g = scaling.g, weight = rub->weight[k];
        const double omega = w[1]*w[1] + w[2]*w[2], cut = 2/(1 + 2*omega);
        double *diagonal = &program->matrix.diagonal[6*rub->node[k]];
        diagonal[0] += weight*g*(1 + 2*w[2]*w[2])/(1 + 2*omega);
        diagonal[1] -= weight*g*cut*w[1]*w[2];
        diagonal[2] += weight*g*(1 + 2*w[1]*w[1])/(1 + 2*omega);
        for (int a = 0; a < 3; a++) rub->w[k][a] = w[a], rub->q[k][a] = -rub->z[k][a];
        rub->g[k] = g;
    }
}

static void load(CpsiProgram *base, double keep) {
    (void)keep; /* a rub has no residual */
    CpsiChainProgram *program = cpsi_chain(base);
    const CpsiRub *rub = &program->rub;
    for (int k = 0; k < rub->count; k++) {
        const double *w = rub->w[k], *q = rub->q[k], weight = rub->weight[k];
        const double pull = 2*w[0]*q[0]/(1 + 2*(w[1]*w[1] + w[2]*w[2]));
        double *f = &base->du[3*rub->node[k]];
        for (int a = 0; a < 2; a++) f[a] += weight*(q[1 + a] + pull*w[1 + a]);
    }
}

static void direct(CpsiProgram *base, double keep, CpsiSums *sums) {
    (void)keep;
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiRub *rub = &program->rub;
    for (int k = 0; k < rub->count; k++) {
        const double *w = rub->w[k], *q = rub->q[k], *s = rub->s[k], *z = rub->z[k], *du = &base->du[3*rub->node[k]];
        const double g = rub->g[k], weight = rub->weight[k], share = 1/(1 + 2*(w[1]*w[1] + w[2]*w[2]));
        double *ds = rub->ds[k], *dz = rub->dz[k];
        const double wu = w[1]*du[0] + w[2]*du[1], pull = 2*share*(w[0]*q[0] + g*wu);
        ds[0] = share*(q[0]/g + 2*w[0]*wu);
        dz[0] = 0;
        for (int a = 0; a < 2; a++) {
            ds[1 + a] = du[a];
            dz[1 + a] = q[1 + a] - g*du[a] + pull*w[1 + a];
        }
        double point[3], scaled_ds[3], scaled_dz[3];
        cpsi_soc_apply(point, w, z, 1, 3);
        cpsi_soc_apply(scaled_dz, w, dz, 1, 3);
        cpsi_soc_apply(scaled_ds, w, ds, -1, 3);
        for (int a = 0; a < 3; a++) scaled_ds[a] *= g;
        const double step_s = cpsi_soc_inverse_step(point, scaled_ds, 3), step_z = cpsi_soc_inverse_step(point, scaled_dz, 3);
        const double step = cpsi_larger(step_s, step_z);
        sums->inverse_step = cpsi_larger(sums->inverse_step, step);
        for (int a = 0; a < 3; a++) {
            sums->first += weight*(s[a]*dz[a] + z[a]*ds[a]);
            sums->second += weight*ds[a]*dz[a];
        }
    }
}

static void correct(CpsiProgram *base, double target) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiRub *rub = &program->rub;
    for (int k = 0; k < rub->count; k++) {
        const double *w = rub->w[k], *s = rub->s[k], *z = rub->z[k];
        double point[3], a[3], b[3], second[3], scaled[3], correction[3];
        cpsi_soc_apply(point, w, z, 1, 3);
        cpsi_soc_apply(a, w, rub->dz[k], 1, 3);
        cpsi_soc_apply(b, w, rub->ds[k], -1, 3);
        cpsi_soc_product(second, a, b, 3);
        cpsi_soc_divide(scaled, point, second, 3);
        cpsi_soc_apply(correction, w, scaled, -1, 3);
        const double inverse = target/cpsi_soc_det(s, 3), g = rub->g[k];
        rub->q[k][0] = -z[0] + inverse*s[0] - g*correction[0];
        for (int j = 1; j < 3; j++) rub->q[k][j] = -z[j] - inverse*s[j] - g*correction[j];
    }
}

static void advance(CpsiProgram *base, double alpha) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiRub *rub = &program->rub;
    for (int k = 0; k < rub->count; k++)
        for (int a = 0; a < 3; a++) {
            rub->s[k][a] += alpha*rub->ds[k][a];
            rub->z[k][a] += alpha*rub->dz[k][a];
        }
}

const CpsiKind cpsi_rub = {start, measure, scale, load, direct, correct, advance};
