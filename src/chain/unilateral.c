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
#include <string.h>

#include "base/larger.h"
#include "chain/elements.h"
#include "ipm/cone.h"
#include "ipm/lane_sums.h"
#include "ipm/width.h"

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

/* What the passes read and write of eight contacts. */
typedef struct UnilateralLanes {
    CpsiLane s, z, q, ds, dz, weight;
    CpsiLane rho, rise;      /* the share of the residual that is to be removed; n.du */
    CpsiLane second, change; /* 1 for a second contact, else 0; w (z/s) n.du */
} UnilateralLanes;

static inline void load_residuals(const CpsiChainProgram *program, int k, int count, double keep,
                                  UnilateralLanes *x) {
    CPSI_FOR_LANES(l)
    x->rho[l] = keep * cpsi_unilateral_residual(program, k + (l < count ? l : count - 1));
}

static inline void load_pairs(const CpsiChainProgram *program, int k, int count, double keep,
                              UnilateralLanes *x) {
    const CpsiUnilateral *unilateral = &program->unilateral;
    cpsi_lanes_load(1, &x->s, &unilateral->s[k], count);
    cpsi_lanes_load(1, &x->z, &unilateral->z[k], count);
    cpsi_lanes_load(1, &x->q, &unilateral->q[k], count);
    load_residuals(program, k, count, keep, x);
}

CPSI_LANES_FUNCTION void measure_lanes(const UnilateralLanes *restrict x,
                                       CpsiLaneSums *restrict sums) {
    CPSI_FOR_LANES(l) {
        const double s = x->s[l], z = x->z[l], weight = x->weight[l], rho = x->rho[l];
        sums->weight[l] += weight;
        sums->sz[l] += weight * s * z;
        sums->ray[l] -= weight * z * (s + rho);
        sums->residual[l] = cpsi_max_nan(sums->residual[l], fabs(rho));
        sums->largest[l] = z > sums->largest[l] ? z : sums->largest[l];
    }
}

/* The force that reaction k gains as the node moves along a curved surface. */
static inline void add_curvature(const CpsiUnilateral *unilateral, int k, const double *u,
                                 double *force) {
    const double *b = unilateral->curvature[k], weight = unilateral->weight[k];
    force[0] += weight * (b[0] * u[0] + b[1] * u[1] + b[3] * u[2]);
    force[1] += weight * (b[1] * u[0] + b[2] * u[1] + b[4] * u[2]);
    force[2] += weight * (b[3] * u[0] + b[4] * u[1] + b[5] * u[2]);
}

static void measure(CpsiProgram *base, CpsiSums *sums) {
    CpsiChainProgram *program = cpsi_chain(base);
    const CpsiUnilateral *unilateral = &program->unilateral;
    CpsiLaneSums lane_sums = {.weight = {0}};
    UnilateralLanes x;
    for (int k = 0; k < unilateral->count; k += CPSI_LANES) {
        const int count = cpsi_lanes_count(unilateral->count - k);
        cpsi_lanes_load(1, &x.s, &unilateral->s[k], count);
        cpsi_lanes_load(1, &x.z, &unilateral->z[k], count);
        load_residuals(program, k, count, 1, &x);
        cpsi_lanes_load_weights(x.weight, &unilateral->weight[k], count);
        measure_lanes(&x, &lane_sums);
        for (int i = k; i < k + count; i++) {
            const int node = unilateral->node[i];
            add_to_node(unilateral, i, unilateral->weight[i] * unilateral->z[i], base->residual);
            if (unilateral->curvature)
                add_curvature(unilateral, i, &base->u[3 * node], &base->residual[3 * node]);
        }
    }
    cpsi_lane_sums_add(sums, &lane_sums);
}

CPSI_LANES_FUNCTION void load_lanes(UnilateralLanes *restrict x, double keep) {
    CPSI_FOR_LANES(l) x->dz[l] = x->q[l] - x->z[l] / x->s[l] * keep * x->rho[l];
}

/* dz becomes the direction without the part that is linear in n.du, which friction needs as
 * well. */
static void load(CpsiProgram *base, double keep) {
    CpsiChainProgram *program = cpsi_chain(base);
    const CpsiUnilateral *unilateral = &program->unilateral;
    UnilateralLanes x;
    for (int k = 0; k < unilateral->count; k += CPSI_LANES) {
        const int count = cpsi_lanes_count(unilateral->count - k);
        load_pairs(program, k, count, 1, &x);
        load_lanes(&x, keep);
        cpsi_lanes_store(1, &unilateral->dz[k], &x.dz, count);
        for (int l = 0; l < count; l++)
            add_to_node(unilateral, k + l, unilateral->weight[k + l] * x.dz[l], base->du);
    }
}

/* The direction of R, and of s, where the linear system gives n.du; and, if there may be second
 * contacts, where it gives w (z/s) n.du, as n is oblique to the axes of du and n.du has too few
 * digits. */
CPSI_LANES_PART void direct_lanes(UnilateralLanes *restrict x, const bool seconds,
                                  double *restrict inverse) {
    CPSI_FOR_LANES(l) {
        const double s = x->s[l], z = x->z[l], q = x->q[l], stiffness = z / s;
        double ds = x->rise[l] + x->rho[l], dz = q - stiffness * ds;
        if (seconds) {
            const double other_dz = q - x->change[l] / x->weight[l] - stiffness * x->rho[l],
                         other_ds = (q - other_dz) * (s / z);
            const double other = z > s ? x->second[l] : 0;
            ds = other > 0 ? other_ds : ds;
            dz = other > 0 ? other_dz : dz;
        }
        x->ds[l] = ds;
        x->dz[l] = dz;
        x->q[l] = ds * dz / s; /* the second-order term of a predictor */
        const double step_s = -ds / s, step_z = -dz / z;
        inverse[l] = cpsi_max_nan(inverse[l], cpsi_max_nan(step_s, step_z));
    }
}

CPSI_LANES_FUNCTION void first_lanes(UnilateralLanes *restrict x, double *restrict inverse) {
    direct_lanes(x, false, inverse);
}

CPSI_LANES_FUNCTION void second_lanes(UnilateralLanes *restrict x, double *restrict inverse) {
    direct_lanes(x, true, inverse);
}

static void direct(CpsiProgram *base, double keep, bool predictor, CpsiSums *sums) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiUnilateral *unilateral = &program->unilateral;
    CpsiLane inverse = {0};
    UnilateralLanes x;
    for (int k = 0; k < unilateral->count; k += CPSI_LANES) {
        const int count = cpsi_lanes_count(unilateral->count - k);
        load_pairs(program, k, count, keep, &x);
        cpsi_lanes_load(1, &x.weight, &unilateral->weight[k], count);
        CPSI_FOR_LANES(l) {
            const int at = k + (l < count ? l : count - 1);
            x.rise[l] = cpsi_unilateral_rise(unilateral, at, base->du);
            if (!program->matrix.second) continue;
            x.second[l] = unilateral->second[at];
            x.change[l] = program->node_frames.second_reaction_change[unilateral->node[at]];
        }
        if (program->matrix.second)
            second_lanes(&x, inverse);
        else
            first_lanes(&x, inverse);
        cpsi_lanes_store(1, &unilateral->ds[k], &x.ds, count);
        cpsi_lanes_store(1, &unilateral->dz[k], &x.dz, count);
        if (predictor) cpsi_lanes_store(1, &unilateral->q[k], &x.q, count);
    }
    sums->inverse_step = cpsi_lanes_largest(sums->inverse_step, inverse);
}

CPSI_LANES_FUNCTION void aim_lanes(UnilateralLanes *restrict x, double target) {
    CPSI_FOR_LANES(l) x->q[l] = -x->z[l] + target / x->s[l] - x->q[l];
}

/* q with s o z -> target e, less the second-order term that stands in q, or without it. */
static void aim(CpsiProgram *base, double target, bool second_order) {
    CpsiUnilateral *unilateral = &cpsi_chain(base)->unilateral;
    UnilateralLanes x;
    for (int k = 0; k < unilateral->count; k += CPSI_LANES) {
        const int count = cpsi_lanes_count(unilateral->count - k);
        cpsi_lanes_load(1, &x.s, &unilateral->s[k], count);
        cpsi_lanes_load(1, &x.z, &unilateral->z[k], count);
        if (second_order)
            cpsi_lanes_load(1, &x.q, &unilateral->q[k], count);
        else
            memset(x.q, 0, sizeof x.q);
        aim_lanes(&x, target);
        cpsi_lanes_store(1, &unilateral->q[k], &x.q, count);
    }
}

static void advance(CpsiProgram *base, double alpha) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiUnilateral *unilateral = &program->unilateral;
    cpsi_cone_advance((size_t)unilateral->count, alpha, unilateral->s, unilateral->ds,
                      unilateral->z, unilateral->dz);
}

const CpsiKind CPSI_WIDE(cpsi_unilateral) = {start, measure, scale, predict,
                                             load,  direct,  aim,   advance};
