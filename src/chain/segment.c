/* SPDX-License-Identifier: BSD-3-Clause */
/* Segment: a tension-only element of compliance c >= 0, the cone (1 + d, e) in Q4 with energy l
 * d^2/(2c).
 *
 * Stationarity in d makes the first dual the tension: T = d/c. So s0 = 1 + c T, with residual rho =
 * 1 + c T - s0; c = 0 (inextensible) needs no special case. With H = g (2 v v^T - J), v = J w, the
 * linearised pair reads dz + H ds = q; eliminating ds0 = c dT + rho leaves, with omega = |w1|^2, n
 * = w1/|w1|, D = 1 + c g (1 + 2 omega):
 *
 *     -dp = Q - M de,     M = g (I - n n^T) + k n n^T,     k = g (1 + 2 omega + c g)/D
 *         1/k -> c as s o z -> 0
 *      Q  = q1 + 2 g w0 w1 (rho + c q0)/D
 *     dT  = (q0 - g (1 + 2 omega) rho)/D + 2 g w0 w1.de/D
 *
 * g is the geometric stiffness T/|x'|. The rest, k - g = 2 omega g (1 - c g)/D, may be 1e12 times
 * larger, so it enters the linear system through the unknown t = (k - g) n.de with compliance a =
 * 1/(k - g), from which dT is recovered without cancellation: 2 g w0 w1.de/D = w0 t/(|w1| (1 - c
 * g)). On the central path c g = c T/(1 + c T) < 1; off it, where strains are of order one, c g may
 * exceed 1 and a become negative, which the linear system allows.
 *
 * An element with springs beside it (springs.c) has a c and a rho of its own in each pass. */
#include <string.h>

#include "base/width.h"
#include "chain/elements.h"
#include "chain/frame.h"
#include "ipm/cone.h"
#include "ipm/lane_sums.h"

/* 1 - c g is kept this far from 0, so that a stays finite: the step is inexact by as much. */
static const double LEAST_STIFFENING = 1e-13;
/* Below this 1 - c g the element is not stiff, and dT is taken from de. */
static const double STIFF = 0.5;
/* omega -> 0 means no preferred direction; 1/omega is kept finite. */
static const double LEAST_OMEGA = 1e-24;

/* Quantities of one segment that scale, load and direct share; the inverses take one division in
 * all. */
typedef struct Segment {
    double omega, d, stiffening; /* |w1|^2, D, 1 - c g */
    double inverse_d, inverse_stiffening, inverse_length;
} Segment;

static inline Segment segment(const double w[4], double g, double c, double l) {
    Segment out;
    const double omega = w[1] * w[1] + w[2] * w[2] + w[3] * w[3], stiffening = 1 - c * g;
    out.omega = omega > LEAST_OMEGA ? omega : LEAST_OMEGA;
    out.d = 1 + c * g * (1 + 2 * omega);
    out.stiffening = fabs(stiffening) > LEAST_STIFFENING ? stiffening : LEAST_STIFFENING;
    const double inverse = 1 / (out.d * out.stiffening * l);
    out.inverse_d = inverse * out.stiffening * l;
    out.inverse_stiffening = inverse * out.d * l;
    out.inverse_length = inverse * out.d * out.stiffening;
    return out;
}

/* Add sign x force, given in the common axes, to a node's force in its own. */
static inline void add_force(const CpsiChainProgram *program, double *f, int node, double sign,
                             const double force[3]) {
    double own[3];
    cpsi_frame_to(own, &program->frame[9 * node], force);
    for (int a = 0; a < 3; a++) f[3 * node + a] += sign * own[a];
}

/* A node's vector in the common axes. */
static inline const double *common(const CpsiChainProgram *program, const double *u, int node,
                                   double out[3]) {
    if (!program->frame) return &u[3 * node];
    cpsi_frame_from(out, &program->frame[9 * node], &u[3 * node]);
    return out;
}

static void start(CpsiProgram *base, double mu, double margin) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiSegment *st = &program->segment;
    for (int i = 1; i < program->n; i++) {
        double *s = st->s[i], *z = st->z[i];
        const double r = sqrt(s[1] * s[1] + s[2] * s[2] + s[3] * s[3]);
        s[0] = r + margin;
        /* z = mu s^-1 */
        const double k = mu / (margin * (2 * r + margin));
        z[0] = k * s[0];
        for (int a = 1; a < 4; a++) z[a] = -k * s[a];
    }
    if (st->springs.count > 0) cpsi_springs_start(st, program->n, mu, margin);
}

/* What the passes read and write of eight segments. */
typedef struct Lanes {
    CpsiLane s[4], z[4], length, c, w[4], g, inverse_w, q[4], ds[4], dz[4];
    CpsiLane rest;                                /* of rho, by springs beside the segment */
    CpsiLane t, difference[3];                    /* dt; du_i - du_i-1 in the common axes */
    CpsiLane stretch;                             /* ds0 */
    CpsiLane stiffness, compliance, direction[3]; /* of the matrix */
    CpsiLane force[3];
} Lanes;

static inline void load_pairs(const CpsiSegment *st, int i, int count, Lanes *x) {
    cpsi_lanes_load(4, x->s, st->s[i], count);
    cpsi_lanes_load(4, x->z, st->z[i], count);
}

/* What elements that are all alike have in their lanes, before a pass. */
static inline void begin(const CpsiSegment *st, Lanes *x) {
    CPSI_FOR_LANES(l) {
        x->c[l] = st->compliance;
        x->rest[l] = 0;
    }
}

static inline void load_elements(const CpsiSegment *st, int i, int count, Lanes *x) {
    cpsi_lanes_load(1, &x->length, &st->length[i], count);
    if (st->springs.count > 0) {
        cpsi_lanes_load(1, &x->c, &st->springs.compliance[i], count);
        cpsi_lanes_load(1, &x->rest, &st->springs.rest[i], count);
    } else if (st->compliance_factor) {
        CPSI_FOR_LANES(l) x->c[l] = cpsi_segment_compliance(st, i + (l < count ? l : count - 1));
    }
}

static inline void load_scaled(const CpsiSegment *st, int i, int count, Lanes *x) {
    load_pairs(st, i, count, x);
    load_elements(st, i, count, x);
    cpsi_lanes_load(1, &x->g, &st->g[i], count);
}

/* Add the forces of `count` segments from i on, one after the other: each to the node behind the
 * segment, and less to the node before it. */
static void add_forces(const CpsiChainProgram *program, double *f, int i, int count,
                       const double *force) {
    if (program->frame) {
        for (int k = 0; k < count; k++) {
            add_force(program, f, i + k - 1, -1, &force[3 * k]);
            add_force(program, f, i + k, 1, &force[3 * k]);
        }
        return;
    }
    double *before = &f[3 * (i - 1)], *at = &f[3 * i];
    for (int a = 0; a < 3; a++) before[a] -= force[a];
    for (int k = 0; k < 3 * (count - 1); k++) at[k] = at[k] + force[k] - force[3 + k];
    for (int k = 3 * (count - 1); k < 3 * count; k++) at[k] += force[k];
}

/* The four numbers of lane l. */
#define FOUR(x, l) \
    { (x)[0][l], (x)[1][l], (x)[2][l], (x)[3][l] }

CPSI_LANES_FUNCTION void measure_lanes(const Lanes *restrict x, CpsiLaneSums *restrict sums) {
    CPSI_FOR_LANES(l) {
        const double s[4] = FOUR(x->s, l), z[4] = FOUR(x->z, l), length = x->length[l], c = x->c[l];
        const double rho = fabs(1 + c * z[0] - s[0] + x->rest[l]);
        const double work = s[1] * z[1] + s[2] * z[2] + s[3] * z[3];
        sums->weight[l] += length;
        sums->sz[l] += length * (s[0] * z[0] + work);
        sums->scale[l] += length * s[0] * z[0];
        sums->ray[l] -= length * (z[0] + work);
        sums->ray_cost[l] += length * c * z[0] * z[0];
        sums->residual[l] = cpsi_max_nan(sums->residual[l], rho);
        sums->largest[l] = z[0] > sums->largest[l] ? z[0] : sums->largest[l];
    }
}

/* Move `count` segments from i on. */
static inline void advance(const CpsiSegment *st, int i, int count, double alpha) {
    cpsi_cone_advance(4 * (size_t)count, alpha, st->s[i], st->ds[i], st->z[i], st->dz[i]);
}

static void measure(CpsiProgram *base, double alpha, CpsiSums *sums) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiSegment *st = &program->segment;
    CpsiLaneSums lane_sums = {.weight = {0}};
    Lanes x;
    if (st->springs.count > 0) { /* which read the segments moved */
        if (alpha != 0) advance(st, 1, program->n - 1, alpha);
        cpsi_springs_measure(st, program->n, alpha, sums);
        alpha = 0;
    }
    begin(st, &x);
    CPSI_FOR_STRIPS(first, strip, 1, program->n) {
        double force[3 * CPSI_STRIP]; /* p = -z1 pulls node i-1 towards i and node i back */
        if (alpha != 0) advance(st, first, strip, alpha);
        for (int k = 0; k < strip; k += CPSI_LANES) {
            const int count = cpsi_lanes_count(strip - k), i = first + k;
            load_pairs(st, i, count, &x);
            load_elements(st, i, count, &x);
            cpsi_lanes_load_weights(x.length, &st->length[i], count);
            measure_lanes(&x, &lane_sums);
            cpsi_lanes_store(3, &force[3 * k], &x.z[1], count);
        }
        add_forces(program, base->residual, first, strip, force);
    }
    cpsi_lane_sums_add(sums, &lane_sums);
}

CPSI_LANES_FUNCTION void scale_lanes(Lanes *restrict x, CpsiLane *restrict w) {
    CPSI_FOR_LANES(l) {
        const double s[4] = FOUR(x->s, l), z[4] = FOUR(x->z, l), length = x->length[l], c = x->c[l];
        const CpsiSocScaling scaling = cpsi_soc_scaling(s, z, 4);
        const double g = scaling.g;
        const Segment seg = segment(scaling.w, g, c, length);
        const double in = 1 / sqrt(seg.omega);
        for (int a = 0; a < 4; a++) w[a][l] = scaling.w[a];
        x->g[l] = g;
        x->inverse_w[l] = in;
        x->stiffness[l] = g * seg.inverse_length;
        x->compliance[l] = length * seg.d / (2 * seg.omega * g * seg.stiffening);
        for (int a = 0; a < 3; a++) x->direction[a][l] = in * scaling.w[1 + a];
    }
}

static void scale(CpsiProgram *base) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiSegment *st = &program->segment;
    CpsiMatrix *matrix = &program->matrix;
    Lanes x;
    if (st->springs.count > 0) cpsi_springs_scale(st, program->n);
    begin(st, &x);
    for (int i = 1; i < program->n; i += CPSI_LANES) {
        const int count = cpsi_lanes_count(program->n - i);
        load_pairs(st, i, count, &x);
        load_elements(st, i, count, &x);
        CpsiLane *w = cpsi_lanes_of(4, st->w[i], x.w, count);
        scale_lanes(&x, w);
        cpsi_lanes_keep(4, st->w[i], x.w, count);
        cpsi_lanes_store(1, &st->g[i], &x.g, count);
        cpsi_lanes_store(1, &st->inverse_w[i], &x.inverse_w, count);
        cpsi_lanes_store(1, &matrix->stiffness[i], &x.stiffness, count);
        cpsi_lanes_store(1, &matrix->compliance[i], &x.compliance, count);
        cpsi_lanes_store(3, &matrix->direction[3 * i], x.direction, count);
    }
}

/* q of the aim, of a corrector with the second-order term that stands in q; and Q, the force of the
 * right-hand side. */
CPSI_LANES_PART void load_lanes(Lanes *restrict x, CpsiLane *restrict w, CpsiLane *restrict q,
                                const CpsiIpmAimKind kind, double target, double keep) {
    CPSI_FOR_LANES(l) {
        const double by[4] = FOUR(w, l), s[4] = FOUR(x->s, l), z[4] = FOUR(x->z, l);
        const double g = x->g[l], c = x->c[l];
        double aim[4] = {-z[0], -z[1], -z[2], -z[3]};
        if (kind == CPSI_IPM_AIM_CENTRE) memset(aim, 0, sizeof aim);
        if (kind == CPSI_IPM_AIM_CORRECT || kind == CPSI_IPM_AIM_GIVEN)
            for (int a = 0; a < 4; a++) aim[a] = q[a][l];
        if (kind == CPSI_IPM_AIM_CORRECT || kind == CPSI_IPM_AIM_CENTRE) {
            cpsi_soc_correct(aim, s, z, target, 4);
            for (int a = 0; a < 4; a++) q[a][l] = aim[a];
        }
        const Segment seg = segment(by, g, c, x->length[l]);
        const double rho = keep * (1 + c * z[0] - s[0]) + x->rest[l];
        const double k = 2 * g * by[0] * (rho + c * aim[0]) * seg.inverse_d;
        for (int a = 0; a < 3; a++) x->force[a][l] = aim[1 + a] + k * by[1 + a];
    }
}

CPSI_LANES_FUNCTION void predict_lanes(Lanes *restrict x, CpsiLane *restrict w,
                                       CpsiLane *restrict q, double keep) {
    load_lanes(x, w, q, CPSI_IPM_AIM_PREDICT, 0, keep);
}
CPSI_LANES_FUNCTION void correct_lanes(Lanes *restrict x, CpsiLane *restrict w,
                                       CpsiLane *restrict q, double target, double keep) {
    load_lanes(x, w, q, CPSI_IPM_AIM_CORRECT, target, keep);
}
CPSI_LANES_FUNCTION void centre_lanes(Lanes *restrict x, CpsiLane *restrict w, CpsiLane *restrict q,
                                      double target, double keep) {
    load_lanes(x, w, q, CPSI_IPM_AIM_CENTRE, target, keep);
}
CPSI_LANES_FUNCTION void given_lanes(Lanes *restrict x, CpsiLane *restrict w, CpsiLane *restrict q,
                                     double keep) {
    load_lanes(x, w, q, CPSI_IPM_AIM_GIVEN, 0, keep);
}

static inline void aim_lanes(Lanes *x, CpsiLane *w, CpsiLane *q, const CpsiIpmAim *aim) {
    switch (aim->kind) {
    case CPSI_IPM_AIM_PREDICT: predict_lanes(x, w, q, aim->keep); break;
    case CPSI_IPM_AIM_CORRECT: correct_lanes(x, w, q, aim->target, aim->keep); break;
    case CPSI_IPM_AIM_CENTRE: centre_lanes(x, w, q, aim->target, aim->keep); break;
    case CPSI_IPM_AIM_GIVEN: given_lanes(x, w, q, aim->keep); break;
    }
}

static void load(CpsiProgram *base, const CpsiIpmAim *aim) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiSegment *st = &program->segment;
    Lanes x;
    if (st->springs.count > 0) cpsi_springs_load(st, program->n, aim);
    begin(st, &x);
    CPSI_FOR_STRIPS(first, strip, 1, program->n) {
        double force[3 * CPSI_STRIP];
        for (int k = 0; k < strip; k += CPSI_LANES) {
            const int count = cpsi_lanes_count(strip - k), i = first + k;
            load_scaled(st, i, count, &x);
            CpsiLane *w = cpsi_lanes_of(4, st->w[i], x.w, count),
                     *q = cpsi_lanes_of(4, st->q[i], x.q, count);
            aim_lanes(&x, w, q, aim);
            cpsi_lanes_keep(4, st->q[i], x.q, count);
            cpsi_lanes_store(3, &force[3 * k], x.force, count);
        }
        add_forces(program, base->du, first, strip, force);
    }
}

/* du_i - du_i-1 of eight segments, from du of the node before. */
CPSI_LANES_FUNCTION void differences(const double *restrict du, CpsiLane *restrict out) {
    double difference[3 * CPSI_LANES];
    for (int k = 0; k < 3 * CPSI_LANES; k++) difference[k] = du[3 + k] - du[k];
    cpsi_lanes_load(3, out, difference, CPSI_LANES);
}

/* du_i - du_i-1 of `count` segments from i on. */
static inline void load_difference(const CpsiChainProgram *program, int i, int count, Lanes *x) {
    const double *du = program->base.du;
    if (!program->frame && count == CPSI_LANES) {
        differences(&du[3 * (i - 1)], x->difference);
        return;
    }
    CPSI_FOR_LANES(l) {
        const int j = i + (l < count ? l : count - 1);
        double one[3], two[3];
        const double *far = common(program, du, j, one), *near = common(program, du, j - 1, two);
        for (int a = 0; a < 3; a++) x->difference[a][l] = far[a] - near[a];
    }
}

/* The directions ds, dz or, of a predictor, its second-order term in q; `inverse` becomes the
 * largest 1/alpha. */
CPSI_LANES_PART void direct_lanes(Lanes *restrict x, CpsiLane *restrict by, CpsiLane *restrict aim,
                                  double keep, const bool predictor, double *restrict inverse) {
    CPSI_FOR_LANES(l) {
        const double w[4] = FOUR(by, l), z[4] = FOUR(x->z, l), g = x->g[l], in = x->inverse_w[l];
        double q[4], ds[4], dz[4];
        for (int a = 0; a < 4; a++) q[a] = predictor ? -z[a] : aim[a][l];
        const double c = x->c[l];
        const Segment seg = segment(w, g, c, x->length[l]);
        const double rho = keep * (1 + c * z[0] - x->s[0][l]) + x->rest[l], t = x->t[l];
        const double k = 2 * g * w[0] * (rho + c * q[0]) * seg.inverse_d;
        double along = 0; /* w1.de */
        for (int a = 0; a < 3; a++) {
            const double de = x->difference[a][l] * seg.inverse_length;
            ds[1 + a] = de;
            dz[1 + a] = q[1 + a] + k * w[1 + a] - g * de - in * w[1 + a] * t;
            along += w[1 + a] * de;
        }
        const double stiff = in * t * seg.inverse_stiffening, soft = 2 * g * along * seg.inverse_d,
                     pull = seg.stiffening > STIFF ? stiff : soft;
        dz[0] = (q[0] - g * (1 + 2 * seg.omega) * rho) * seg.inverse_d + w[0] * pull;
        x->stretch[l] = ds[0] = c * dz[0] + rho;
        const double step = cpsi_soc_step(q, predictor, w, g, z, ds, dz, 4);
        inverse[l] = cpsi_max_nan(inverse[l], step);
        for (int a = 0; a < 4; a++) {
            if (predictor) aim[a][l] = q[a];
            if (!predictor) x->ds[a][l] = ds[a];
            if (!predictor) x->dz[a][l] = dz[a];
        }
    }
}

CPSI_LANES_FUNCTION void predictor_lanes(Lanes *restrict x, CpsiLane *restrict w,
                                         CpsiLane *restrict q, double keep,
                                         double *restrict inverse) {
    direct_lanes(x, w, q, keep, true, inverse);
}

CPSI_LANES_FUNCTION void direction_lanes(Lanes *restrict x, CpsiLane *restrict w,
                                         CpsiLane *restrict q, double keep,
                                         double *restrict inverse) {
    direct_lanes(x, w, q, keep, false, inverse);
}

static void direct(CpsiProgram *base, const CpsiIpmAim *aim, CpsiSums *sums) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiSegment *st = &program->segment;
    CpsiLane inverse = {0};
    Lanes x;
    begin(st, &x);
    for (int i = 1; i < program->n; i += CPSI_LANES) {
        const int count = cpsi_lanes_count(program->n - i);
        load_scaled(st, i, count, &x);
        cpsi_lanes_load(1, &x.inverse_w, &st->inverse_w[i], count);
        cpsi_lanes_load(1, &x.t, &program->dt[i], count);
        load_difference(program, i, count, &x);
        CpsiLane *w = cpsi_lanes_of(4, st->w[i], x.w, count),
                 *q = cpsi_lanes_of(4, st->q[i], x.q, count);
        if (aim->kind == CPSI_IPM_AIM_PREDICT) {
            predictor_lanes(&x, w, q, aim->keep, inverse);
            cpsi_lanes_keep(4, st->q[i], x.q, count);
        } else {
            direction_lanes(&x, w, q, aim->keep, inverse);
            cpsi_lanes_store(4, st->ds[i], x.ds, count);
            cpsi_lanes_store(4, st->dz[i], x.dz, count);
        }
        if (st->springs.count > 0) cpsi_lanes_store(1, &st->springs.stretch[i], &x.stretch, count);
    }
    sums->inverse_step = cpsi_lanes_largest(sums->inverse_step, inverse);
    if (st->springs.count > 0) cpsi_springs_direct(st, program->n, aim, sums);
}

const CpsiKind CPSI_WIDE(cpsi_segment) = {start, measure, scale, load, direct};
