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
#include <string.h>

#include "base/width.h"
#include "chain/elements.h"
#include "ipm/cone.h"
#include "ipm/lane_sums.h"

/* B where map is NULL. */
static const double PLAIN[6] = {1, 0, 0, 0, 1, 0};

/* u = o + B v (`whole`) or du = B v of disc k, for the displacement v of its node. */
static inline void displacement_of(const CpsiFrictionDisc *disc, int k, const double v[3],
                                   bool whole, double u[2]) {
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
        displacement_of(disc, k, &base->u[3 * disc->node[k]], true, u);
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

/* What the passes read and write of eight discs. */
typedef struct DiscLanes {
    CpsiLane s[3], z[3], weight, w[3], g, q[3], ds[3], dz[3];
    CpsiLane du[2], bound; /* B du; the direction of the bound, 0 where bounds are fixed */
    CpsiLane stiffness, block[3],
        across; /* M = stiffness x block (xx, xy, yy); c w1 = -across w1 */
    CpsiLane force[2];
} DiscLanes;

static inline void load_pairs(const CpsiFrictionDisc *disc, int k, int count, DiscLanes *x) {
    cpsi_lanes_load(3, x->s, disc->s[k], count);
    cpsi_lanes_load(3, x->z, disc->z[k], count);
}

/* The direction of the bound f R of `count` discs from `first` on: before the solution, without the
 * part that is linear in n.du, and after it all of it. */
static inline void gather_bounds(const CpsiChainProgram *program, int first, int count,
                                 double *bound) {
    const CpsiFrictionDisc *disc = &program->disc;
    for (int k = 0; k < count; k++)
        bound[k] =
            !program->bounds_coupled
                ? 0
                : disc->friction[first + k] * program->unilateral.dz[disc->unilateral[first + k]];
}

/* The three numbers of lane l. */
#define THREE(x, l) \
    { (x)[0][l], (x)[1][l], (x)[2][l] }

CPSI_LANES_FUNCTION void measure_lanes(const DiscLanes *restrict x, CpsiLaneSums *restrict sums) {
    CPSI_FOR_LANES(l) {
        const double s[3] = THREE(x->s, l), z[3] = THREE(x->z, l), weight = x->weight[l];
        sums->weight[l] += weight;
        sums->sz[l] += weight * (s[0] * z[0] + s[1] * z[1] + s[2] * z[2]);
        sums->scale[l] += weight * s[0] * z[0];
        sums->bound[l] += weight * z[0];
    }
}

static void measure(CpsiProgram *base, double alpha, CpsiSums *sums) {
    const CpsiFrictionDisc *disc = &cpsi_chain(base)->disc;
    CpsiLaneSums lane_sums = {.weight = {0}};
    DiscLanes x;
    for (int k = 0; k < disc->count; k += CPSI_LANES) {
        const int count = cpsi_lanes_count(disc->count - k);
        if (alpha != 0)
            cpsi_cone_advance(3 * (size_t)count, alpha, disc->s[k], disc->ds[k], disc->z[k],
                              disc->dz[k]);
        load_pairs(disc, k, count, &x);
        cpsi_lanes_load_weights(x.weight, &disc->weight[k], count);
        measure_lanes(&x, &lane_sums);
        for (int i = k; i < k + count; i++)
            add_to_node(disc, i, &disc->z[i][1], &base->residual[3 * disc->node[i]]);
    }
    cpsi_lane_sums_add(sums, &lane_sums);
}

CPSI_LANES_FUNCTION void scale_lanes(DiscLanes *restrict x, CpsiLane *restrict by) {
    CPSI_FOR_LANES(l) {
        const double s[3] = THREE(x->s, l), z[3] = THREE(x->z, l);
        const CpsiSocScaling scaling = cpsi_soc_scaling(s, z, 3);
        const double *w = scaling.w;
        const double share = 1 / (1 + 2 * (w[1] * w[1] + w[2] * w[2]));
        x->stiffness[l] = x->weight[l] * scaling.g * share;
        x->block[0][l] = 1 + 2 * w[2] * w[2];
        x->block[1][l] = -2 * w[1] * w[2];
        x->block[2][l] = 1 + 2 * w[1] * w[1];
        x->across[l] = -2 * share * w[0];
        for (int a = 0; a < 3; a++) by[a][l] = w[a];
        x->g[l] = scaling.g;
    }
}

/* Add disc k, in lane l, to the matrix. */
static inline void add_to_matrix(CpsiChainProgram *program, int k, const DiscLanes *x, CpsiLane *w,
                                 int l) {
    const CpsiFrictionDisc *disc = &program->disc;
    double *diagonal = &program->matrix.diagonal[6 * disc->node[k]];
    const double m[3] = THREE(x->block, l);
    if (disc->map)
        cpsi_add_mapped(diagonal, x->stiffness[l], disc->map[k], m);
    else
        for (int a = 0; a < 3; a++) diagonal[a] += x->stiffness[l] * m[a];
    if (!program->bounds_coupled) return;
    const double *b = disc->map ? disc->map[k] : PLAIN;
    double across[3];
    for (int a = 0; a < 3; a++) across[a] = x->across[l] * (b[a] * w[1][l] + b[3 + a] * w[2][l]);
    cpsi_unilateral_couple_bound(program, disc->unilateral[k], x->weight[l], disc->friction[k],
                                 across);
}

static void scale(CpsiProgram *base) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiFrictionDisc *disc = &program->disc;
    DiscLanes x;
    for (int k = 0; k < disc->count; k += CPSI_LANES) {
        const int count = cpsi_lanes_count(disc->count - k);
        load_pairs(disc, k, count, &x);
        cpsi_lanes_load(1, &x.weight, &disc->weight[k], count);
        CpsiLane *w = cpsi_lanes_of(3, disc->w[k], x.w, count);
        scale_lanes(&x, w);
        cpsi_lanes_keep(3, disc->w[k], x.w, count);
        cpsi_lanes_store(1, &disc->g[k], &x.g, count);
        for (int l = 0; l < count; l++) add_to_matrix(program, k + l, &x, w, l);
    }
}

/* q of the aim, of a corrector with the second-order term that stands in q; and Q, the force of the
 * right-hand side. */
CPSI_LANES_PART void load_lanes(DiscLanes *restrict x, CpsiLane *restrict by, CpsiLane *restrict q,
                                const CpsiIpmAimKind kind, double target) {
    CPSI_FOR_LANES(l) {
        const double w[3] = THREE(by, l), s[3] = THREE(x->s, l), z[3] = THREE(x->z, l);
        double aim[3] = {-z[0], -z[1], -z[2]};
        if (kind == CPSI_IPM_AIM_CENTRE) memset(aim, 0, sizeof aim);
        if (kind == CPSI_IPM_AIM_CORRECT || kind == CPSI_IPM_AIM_GIVEN)
            for (int a = 0; a < 3; a++) aim[a] = q[a][l];
        if (kind == CPSI_IPM_AIM_CORRECT || kind == CPSI_IPM_AIM_CENTRE) {
            cpsi_soc_correct(aim, s, z, target, 3);
            for (int a = 0; a < 3; a++) q[a][l] = aim[a];
        }
        const double pull =
            2 * w[0] * (aim[0] - x->bound[l]) / (1 + 2 * (w[1] * w[1] + w[2] * w[2]));
        for (int a = 0; a < 2; a++) x->force[a][l] = aim[1 + a] + pull * w[1 + a];
    }
}

CPSI_LANES_FUNCTION void predict_lanes(DiscLanes *restrict x, CpsiLane *restrict w,
                                       CpsiLane *restrict q) {
    load_lanes(x, w, q, CPSI_IPM_AIM_PREDICT, 0);
}
CPSI_LANES_FUNCTION void correct_lanes(DiscLanes *restrict x, CpsiLane *restrict w,
                                       CpsiLane *restrict q, double target) {
    load_lanes(x, w, q, CPSI_IPM_AIM_CORRECT, target);
}
CPSI_LANES_FUNCTION void centre_lanes(DiscLanes *restrict x, CpsiLane *restrict w,
                                      CpsiLane *restrict q, double target) {
    load_lanes(x, w, q, CPSI_IPM_AIM_CENTRE, target);
}
CPSI_LANES_FUNCTION void given_lanes(DiscLanes *restrict x, CpsiLane *restrict w,
                                     CpsiLane *restrict q) {
    load_lanes(x, w, q, CPSI_IPM_AIM_GIVEN, 0);
}

static inline void aim_lanes(DiscLanes *x, CpsiLane *w, CpsiLane *q, const CpsiIpmAim *aim) {
    switch (aim->kind) {
    case CPSI_IPM_AIM_PREDICT: predict_lanes(x, w, q); break;
    case CPSI_IPM_AIM_CORRECT: correct_lanes(x, w, q, aim->target); break;
    case CPSI_IPM_AIM_CENTRE: centre_lanes(x, w, q, aim->target); break;
    case CPSI_IPM_AIM_GIVEN: given_lanes(x, w, q); break;
    }
}

/* The direction of the unilateral element, computed before, contains what is kept of residuals. */
static void load(CpsiProgram *base, const CpsiIpmAim *aim) {
    const CpsiChainProgram *program = cpsi_chain(base);
    const CpsiFrictionDisc *disc = &program->disc;
    DiscLanes x;
    CPSI_FOR_STRIPS(first, strip, 0, disc->count) {
        double bound[CPSI_STRIP], force[2 * CPSI_STRIP];
        gather_bounds(program, first, strip, bound);
        for (int k = 0; k < strip; k += CPSI_LANES) {
            const int count = cpsi_lanes_count(strip - k), at = first + k;
            load_pairs(disc, at, count, &x);
            cpsi_lanes_load(1, &x.bound, &bound[k], count);
            CpsiLane *w = cpsi_lanes_of(3, disc->w[at], x.w, count),
                     *q = cpsi_lanes_of(3, disc->q[at], x.q, count);
            aim_lanes(&x, w, q, aim);
            cpsi_lanes_keep(3, disc->q[at], x.q, count);
            cpsi_lanes_store(2, &force[2 * k], x.force, count);
        }
        for (int k = 0; k < strip; k++)
            add_to_node(disc, first + k, &force[2 * k], &base->du[3 * disc->node[first + k]]);
    }
}

/* The directions ds, dz or, of a predictor, its second-order term in q; `inverse` becomes the
 * largest 1/alpha. */
CPSI_LANES_PART void direct_lanes(DiscLanes *restrict x, CpsiLane *restrict by,
                                  CpsiLane *restrict aim, const bool predictor,
                                  double *restrict inverse) {
    CPSI_FOR_LANES(l) {
        const double w[3] = THREE(by, l), z[3] = THREE(x->z, l), g = x->g[l];
        const double du[2] = {x->du[0][l], x->du[1][l]}, bound = x->bound[l];
        double q[3], ds[3], dz[3];
        for (int a = 0; a < 3; a++) q[a] = predictor ? -z[a] : aim[a][l];
        const double share = 1 / (1 + 2 * (w[1] * w[1] + w[2] * w[2]));
        const double wu = w[1] * du[0] + w[2] * du[1],
                     pull = 2 * share * (w[0] * (q[0] - bound) + g * wu);
        dz[0] = bound;
        ds[0] = share * ((q[0] - bound) / g + 2 * w[0] * wu);
        for (int a = 0; a < 2; a++) {
            ds[1 + a] = du[a];
            dz[1 + a] = q[1 + a] - g * du[a] + pull * w[1 + a];
        }
        const double step = cpsi_soc_step(q, predictor, w, g, z, ds, dz, 3);
        inverse[l] = cpsi_max_nan(inverse[l], step);
        for (int a = 0; a < 3; a++) {
            if (predictor) aim[a][l] = q[a];
            if (!predictor) x->ds[a][l] = ds[a];
            if (!predictor) x->dz[a][l] = dz[a];
        }
    }
}

CPSI_LANES_FUNCTION void predictor_lanes(DiscLanes *restrict x, CpsiLane *restrict w,
                                         CpsiLane *restrict q, double *restrict inverse) {
    direct_lanes(x, w, q, true, inverse);
}

CPSI_LANES_FUNCTION void direction_lanes(DiscLanes *restrict x, CpsiLane *restrict w,
                                         CpsiLane *restrict q, double *restrict inverse) {
    direct_lanes(x, w, q, false, inverse);
}

/* B du of `count` discs from `first` on. */
static inline void gather_directions(const CpsiFrictionDisc *disc, int first, int count,
                                     const double *du, double *out) {
    for (int k = 0; k < count; k++)
        displacement_of(disc, first + k, &du[3 * disc->node[first + k]], false, &out[2 * k]);
}

static void direct(CpsiProgram *base, const CpsiIpmAim *aim, CpsiSums *sums) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiFrictionDisc *disc = &program->disc;
    CpsiLane inverse = {0};
    DiscLanes x;
    CPSI_FOR_STRIPS(first, strip, 0, disc->count) {
        double bound[CPSI_STRIP], du[2 * CPSI_STRIP];
        gather_bounds(program, first, strip, bound);
        gather_directions(disc, first, strip, base->du, du);
        for (int k = 0; k < strip; k += CPSI_LANES) {
            const int count = cpsi_lanes_count(strip - k), at = first + k;
            cpsi_lanes_load(3, x.z, disc->z[at], count);
            cpsi_lanes_load(1, &x.g, &disc->g[at], count);
            cpsi_lanes_load(1, &x.bound, &bound[k], count);
            cpsi_lanes_load(2, x.du, &du[2 * k], count);
            CpsiLane *w = cpsi_lanes_of(3, disc->w[at], x.w, count),
                     *q = cpsi_lanes_of(3, disc->q[at], x.q, count);
            if (aim->kind == CPSI_IPM_AIM_PREDICT) {
                predictor_lanes(&x, w, q, inverse);
                cpsi_lanes_keep(3, disc->q[at], x.q, count);
            } else {
                direction_lanes(&x, w, q, inverse);
                cpsi_lanes_store(3, disc->ds[at], x.ds, count);
                cpsi_lanes_store(3, disc->dz[at], x.dz, count);
            }
        }
    }
    sums->inverse_step = cpsi_lanes_largest(sums->inverse_step, inverse);
}

const CpsiKind CPSI_WIDE(cpsi_friction_disc) = {start, measure, scale, load, direct};
