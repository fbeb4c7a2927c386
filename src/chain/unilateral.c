/* SPDX-License-Identifier: BSD-3-Clause */
/* Unilateral contact along the normal n: s = gap + n.u + c z >= 0 with reaction z >= 0, s z = 0.
 * With a compliance c > 0 the obstacle gives: z = max(0, -(gap + n.u)/c).
 *
 * On a curved obstacle the reaction turns with the normal as the node moves along it (`curvature`,
 * see chain_program.h).
 *
 * Linearised: dz = q - (z/s) ds, ds = n.du + c dz + rho, rho = gap + n.u + c z - s. So dz = f (q -
 * (z/s) (n.du + rho)) with f = s/(s + c z), and the node's block gains w f (z/s) n n^T: for a first
 * contact in its entry zz, for a second contact as a second direction (chain_system.h), or in all
 * its entries where the matrix has no second directions. */
#include <math.h>
#include <string.h>

#include "base/larger.h"
#include "base/width.h"
#include "chain/elements.h"
#include "ipm/cone.h"
#include "ipm/lane_sums.h"

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
        const double s = cpsi_unilateral_give(unilateral, k),
                     by = unilateral->weight[k] * unilateral->z[k] / s;
        double *diagonal = &program->matrix.diagonal[6 * node];
        const double *n = unilateral->normal ? unilateral->normal[k] : NULL;
        const CpsiMatrixSecond *second = program->matrix.second;
        if (!n || !unilateral->second[k]) {
            diagonal[5] += by;
        } else if (second) {
            for (int a = 0; a < 3; a++)
                second->row[3 * node + a] = second->column[3 * node + a] = n[a];
            second->compliance[node] = s / (unilateral->weight[k] * unilateral->z[k]);
        } else {
            const double outer[6] = {n[0] * n[0], n[0] * n[1], n[1] * n[1],
                                     n[0] * n[2], n[1] * n[2], n[2] * n[2]};
            for (int a = 0; a < 6; a++) diagonal[a] += by * outer[a];
        }
    }
}

/* What the passes read and write of eight contacts. */
typedef struct UnilateralLanes {
    CpsiLane s, z, q, ds, dz, weight;
    CpsiLane gap, rise, d_rise; /* g; n.u; n.du */
    CpsiLane compliance;
    CpsiLane second, change; /* 1 for a second contact, else 0; w f (z/s) n.du */
} UnilateralLanes;

/* n.u of `count` contacts from `first` on. */
static inline void gather_rises(const CpsiUnilateral *unilateral, int first, int count,
                                const double *u, double *rise) {
    const int *node = &unilateral->node[first];
    if (unilateral->normal)
        for (int k = 0; k < count; k++) rise[k] = cpsi_unilateral_rise(unilateral, first + k, u);
    else
        for (int k = 0; k < count; k++) rise[k] = u[3 * node[k] + 2];
}

/* `count` contacts from k on, whose n.u has been gathered. */
static inline void load_contacts(const CpsiUnilateral *unilateral, int k, int count,
                                 const double *rise, UnilateralLanes *x) {
    cpsi_lanes_load(1, &x->s, &unilateral->s[k], count);
    cpsi_lanes_load(1, &x->z, &unilateral->z[k], count);
    cpsi_lanes_load(1, &x->gap, &unilateral->gap[k], count);
    if (unilateral->compliance)
        cpsi_lanes_load(1, &x->compliance, &unilateral->compliance[k], count);
    else
        memset(&x->compliance, 0, sizeof x->compliance);
    cpsi_lanes_load(1, &x->rise, rise, count);
}

CPSI_LANES_FUNCTION void measure_lanes(const UnilateralLanes *restrict x,
                                       CpsiLaneSums *restrict sums) {
    CPSI_FOR_LANES(l) {
        const double s = x->s[l], z = x->z[l], weight = x->weight[l], own = x->compliance[l] * z,
                     rho = x->gap[l] + x->rise[l] + own - s;
        sums->weight[l] += weight;
        sums->sz[l] += weight * s * z;
        sums->ray[l] -= weight * z * (s + rho - own);
        sums->ray_cost[l] += weight * z * own;
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

static void measure(CpsiProgram *base, double alpha, CpsiSums *sums) {
    CpsiChainProgram *program = cpsi_chain(base);
    const CpsiUnilateral *unilateral = &program->unilateral;
    CpsiLaneSums lane_sums = {.weight = {0}};
    UnilateralLanes x;
    double rise[CPSI_STRIP];
    if (alpha != 0)
        cpsi_cone_advance((size_t)unilateral->count, alpha, unilateral->s, unilateral->ds,
                          unilateral->z, unilateral->dz);
    CPSI_FOR_STRIPS(first, strip, 0, unilateral->count) {
        gather_rises(unilateral, first, strip, base->u, rise);
        for (int k = 0; k < strip; k += CPSI_LANES) {
            const int count = cpsi_lanes_count(strip - k);
            load_contacts(unilateral, first + k, count, &rise[k], &x);
            cpsi_lanes_load_weights(x.weight, &unilateral->weight[first + k], count);
            measure_lanes(&x, &lane_sums);
        }
        for (int i = first; i < first + strip; i++) {
            const int node = unilateral->node[i];
            add_to_node(unilateral, i, unilateral->weight[i] * unilateral->z[i], base->residual);
            if (unilateral->curvature)
                add_curvature(unilateral, i, &base->u[3 * node], &base->residual[3 * node]);
        }
    }
    cpsi_lane_sums_add(sums, &lane_sums);
}

/* q of the aim, of a corrector with the second-order term that stands in q; and dz, the direction
 * without the part that is linear in n.du. */
CPSI_LANES_PART void load_lanes(UnilateralLanes *restrict x, const CpsiIpmAimKind kind,
                                double target, double keep) {
    CPSI_FOR_LANES(l) {
        const double s = x->s[l], z = x->z[l], c = x->compliance[l],
                     rho = x->gap[l] + x->rise[l] + c * z - s;
        if (kind == CPSI_IPM_AIM_PREDICT) x->q[l] = -z;
        if (kind == CPSI_IPM_AIM_CORRECT) x->q[l] = -z + target / s - x->q[l];
        if (kind == CPSI_IPM_AIM_CENTRE) x->q[l] = -z + target / s;
        x->dz[l] = (x->q[l] - z / s * keep * rho) / (1 + c * z / s);
    }
}

CPSI_LANES_FUNCTION void predict_lanes(UnilateralLanes *restrict x, double keep) {
    load_lanes(x, CPSI_IPM_AIM_PREDICT, 0, keep);
}
CPSI_LANES_FUNCTION void correct_lanes(UnilateralLanes *restrict x, double target, double keep) {
    load_lanes(x, CPSI_IPM_AIM_CORRECT, target, keep);
}
CPSI_LANES_FUNCTION void centre_lanes(UnilateralLanes *restrict x, double target, double keep) {
    load_lanes(x, CPSI_IPM_AIM_CENTRE, target, keep);
}
CPSI_LANES_FUNCTION void given_lanes(UnilateralLanes *restrict x, double keep) {
    load_lanes(x, CPSI_IPM_AIM_GIVEN, 0, keep);
}

static inline void aim_lanes(UnilateralLanes *x, const CpsiIpmAim *aim) {
    switch (aim->kind) {
    case CPSI_IPM_AIM_PREDICT: predict_lanes(x, aim->keep); break;
    case CPSI_IPM_AIM_CORRECT: correct_lanes(x, aim->target, aim->keep); break;
    case CPSI_IPM_AIM_CENTRE: centre_lanes(x, aim->target, aim->keep); break;
    case CPSI_IPM_AIM_GIVEN: given_lanes(x, aim->keep); break;
    }
}

/* dz becomes the direction without the part that is linear in n.du, which friction needs as
 * well. */
static void load(CpsiProgram *base, const CpsiIpmAim *aim) {
    CpsiChainProgram *program = cpsi_chain(base);
    const CpsiUnilateral *unilateral = &program->unilateral;
    UnilateralLanes x;
    double rise[CPSI_STRIP];
    CPSI_FOR_STRIPS(first, strip, 0, unilateral->count) {
        gather_rises(unilateral, first, strip, base->u, rise);
        for (int k = 0; k < strip; k += CPSI_LANES) {
            const int count = cpsi_lanes_count(strip - k);
            load_contacts(unilateral, first + k, count, &rise[k], &x);
            cpsi_lanes_load(1, &x.q, &unilateral->q[first + k], count);
            aim_lanes(&x, aim);
            cpsi_lanes_store(1, &unilateral->q[first + k], &x.q, count);
            cpsi_lanes_store(1, &unilateral->dz[first + k], &x.dz, count);
        }
        for (int k = first; k < first + strip; k++)
            add_to_node(unilateral, k, unilateral->weight[k] * unilateral->dz[k], base->du);
    }
}

/* The direction of R, and of s, where the linear system gives n.du; and, if there may be second
 * contacts, where it gives w (z/s) n.du, as n is oblique to the axes of du and n.du has too few
 * digits. */
CPSI_LANES_PART void direct_lanes(UnilateralLanes *restrict x, const bool seconds, double keep,
                                  double *restrict inverse) {
    CPSI_FOR_LANES(l) {
        const double s = x->s[l], z = x->z[l], q = x->q[l], c = x->compliance[l], stiffness = z / s,
                     whole = 1 + c * stiffness, rho = keep * (x->gap[l] + x->rise[l] + c * z - s);
        double ds = x->d_rise[l] + rho, dz = (q - stiffness * ds) / whole;
        ds += c * dz;
        if (seconds) {
            const double other_dz = (q - stiffness * rho) / whole - x->change[l] / x->weight[l],
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

CPSI_LANES_FUNCTION void first_lanes(UnilateralLanes *restrict x, double keep,
                                     double *restrict inverse) {
    direct_lanes(x, false, keep, inverse);
}

CPSI_LANES_FUNCTION void second_lanes(UnilateralLanes *restrict x, double keep,
                                      double *restrict inverse) {
    direct_lanes(x, true, keep, inverse);
}

/* Which of the contacts are second ones, and what the linear system says of them. */
static inline void load_seconds(const CpsiChainProgram *program, int k, int count,
                                UnilateralLanes *x) {
    const CpsiUnilateral *unilateral = &program->unilateral;
    cpsi_lanes_load(1, &x->weight, &unilateral->weight[k], count);
    CPSI_FOR_LANES(l) {
        const int at = k + (l < count ? l : count - 1);
        x->second[l] = unilateral->second[at];
        x->change[l] = program->node_frames.second_reaction_change[unilateral->node[at]];
    }
}

static void direct(CpsiProgram *base, const CpsiIpmAim *aim, CpsiSums *sums) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiUnilateral *unilateral = &program->unilateral;
    CpsiLane inverse = {0};
    UnilateralLanes x;
    double rise[CPSI_STRIP], d_rise[CPSI_STRIP];
    CPSI_FOR_STRIPS(first, strip, 0, unilateral->count) {
        gather_rises(unilateral, first, strip, base->u, rise);
        gather_rises(unilateral, first, strip, base->du, d_rise);
        for (int k = 0; k < strip; k += CPSI_LANES) {
            const int count = cpsi_lanes_count(strip - k), at = first + k;
            load_contacts(unilateral, at, count, &rise[k], &x);
            cpsi_lanes_load(1, &x.d_rise, &d_rise[k], count);
            cpsi_lanes_load(1, &x.q, &unilateral->q[at], count);
            if (program->matrix.second) {
                load_seconds(program, at, count, &x);
                second_lanes(&x, aim->keep, inverse);
            } else {
                first_lanes(&x, aim->keep, inverse);
            }
            cpsi_lanes_store(1, &unilateral->ds[at], &x.ds, count);
            cpsi_lanes_store(1, &unilateral->dz[at], &x.dz, count);
            if (aim->kind == CPSI_IPM_AIM_PREDICT)
                cpsi_lanes_store(1, &unilateral->q[at], &x.q, count);
        }
    }
    sums->inverse_step = cpsi_lanes_largest(sums->inverse_step, inverse);
}

const CpsiKind CPSI_WIDE(cpsi_unilateral) = {start, measure, scale, load, direct};
