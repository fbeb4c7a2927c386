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
 * exceed 1 and a become negative, which the linear system allows. */
#include "base/larger.h"
#include "chain/elements.h"
#include "chain/frame.h"
#include "ipm/cone.h"

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
    const double *here = force;
    if (program->frame) {
        cpsi_frame_to(own, &program->frame[9 * node], force);
        here = own;
    }
    for (int a = 0; a < 3; a++) f[3 * node + a] += sign * here[a];
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
}

static void measure(CpsiProgram *base, CpsiSums *sums) {
    CpsiChainProgram *program = cpsi_chain(base);
    const CpsiSegment *st = &program->segment;
    double *residual = base->residual;
    for (int i = 1; i < program->n; i++) {
        const double *s = st->s[i], *z = st->z[i], c = cpsi_segment_compliance(st, i);
        const double rho = fabs(1 + c * z[0] - s[0]);
        sums->weight += st->length[i];
        const double work = s[1] * z[1] + s[2] * z[2] + s[3] * z[3];
        sums->sz += st->length[i] * (s[0] * z[0] + work);
        sums->scale += st->length[i] * s[0] * z[0];
        sums->ray -= st->length[i] * (z[0] + work);
        sums->ray_cost += st->length[i] * c * z[0] * z[0];
        sums->residual = cpsi_max_nan(sums->residual, rho);
        if (z[0] > sums->largest) sums->largest = z[0];
        /* the force p = -z1 pulls node i-1 towards i and node i back */
        add_force(program, residual, i - 1, -1, &z[1]);
        add_force(program, residual, i, 1, &z[1]);
    }
}

static void scale(CpsiProgram *base) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiSegment *st = &program->segment;
    CpsiMatrix *matrix = &program->matrix;
    for (int i = 1; i < program->n; i++) {
        const CpsiSocScaling scaling = cpsi_soc_scaling(st->s[i], st->z[i], 4);
        const double g = scaling.g, l = st->length[i];
        const Segment seg = segment(scaling.w, g, cpsi_segment_compliance(st, i), l);
        const double in = 1 / sqrt(seg.omega);
        for (int a = 0; a < 4; a++) st->w[i][a] = scaling.w[a];
        st->g[i] = g;
        st->inverse_w[i] = in;
        matrix->stiffness[i] = g * seg.inverse_length;
        matrix->compliance[i] = l * seg.d / (2 * seg.omega * g * seg.stiffening);
        for (int a = 0; a < 3; a++) matrix->direction[3 * i + a] = in * scaling.w[1 + a];
    }
}

static void predict(CpsiProgram *base) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiSegment *st = &program->segment;
    for (int i = 1; i < program->n; i++)
        for (int a = 0; a < 4; a++) st->q[i][a] = -st->z[i][a];
}

static void load(CpsiProgram *base, double keep) {
    CpsiChainProgram *program = cpsi_chain(base);
    const CpsiSegment *st = &program->segment;
    double *f = base->du;
    for (int i = 1; i < program->n; i++) {
        const double *w = st->w[i], *q = st->q[i], g = st->g[i], c = cpsi_segment_compliance(st, i);
        const Segment seg = segment(w, g, c, st->length[i]);
        const double rho = keep * (1 + c * st->z[i][0] - st->s[i][0]);
        const double k = 2 * g * w[0] * (rho + c * q[0]) * seg.inverse_d;
        double force[3];
        for (int a = 0; a < 3; a++) force[a] = q[1 + a] + k * w[1 + a];
        add_force(program, f, i - 1, -1, force);
        add_force(program, f, i, 1, force);
    }
}

static void direct(CpsiProgram *base, double keep, bool predictor, CpsiSums *sums) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiSegment *st = &program->segment;
    const double *du = base->du;
    for (int i = 1; i < program->n; i++) {
        const double *w = st->w[i], *q = st->q[i], *s = st->s[i], *z = st->z[i];
        const double g = st->g[i], c = cpsi_segment_compliance(st, i), l = st->length[i],
                     t = program->dt[i];
        double ds[4], dz[4];
        const Segment seg = segment(w, g, c, l);
        const double rho = keep * (1 + c * z[0] - s[0]);
        const double k = 2 * g * w[0] * (rho + c * q[0]) * seg.inverse_d, in = st->inverse_w[i];
        /* elongation and force */
        double along = 0, far[3], near[3]; /* w1.de */
        const double *du1 = common(program, du, i, far), *du0 = common(program, du, i - 1, near);
        for (int a = 0; a < 3; a++) {
            const double de = (du1[a] - du0[a]) * seg.inverse_length;
            ds[1 + a] = de;
            dz[1 + a] = q[1 + a] + k * w[1 + a] - g * de - in * w[1 + a] * t;
            along += w[1 + a] * de;
        }
        const double pull = seg.stiffening > STIFF ? in * t * seg.inverse_stiffening
                                                   : 2 * g * along * seg.inverse_d;
        dz[0] = (q[0] - g * (1 + 2 * seg.omega) * rho) * seg.inverse_d + w[0] * pull;
        ds[0] = c * dz[0] + rho;
        if (!predictor)
            for (int a = 0; a < 4; a++) {
                st->ds[i][a] = ds[a];
                st->dz[i][a] = dz[a];
            }
        const double step = cpsi_soc_step(st->q[i], predictor, w, g, z, ds, dz, 4);
        sums->inverse_step = cpsi_max_nan(sums->inverse_step, step);
    }
}

static void aim(CpsiProgram *base, double target, bool second_order) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiSegment *st = &program->segment;
    for (int i = 1; i < program->n; i++)
        cpsi_soc_correct(st->q[i], st->s[i], st->z[i], target, second_order, 4);
}

static void advance(CpsiProgram *base, double alpha) {
    CpsiChainProgram *program = cpsi_chain(base);
    CpsiSegment *st = &program->segment;
    cpsi_cone_advance(4 * ((size_t)program->n - 1), alpha, st->s[1], st->ds[1], st->z[1],
                      st->dz[1]);
}

const CpsiKind cpsi_segment = {start, measure, scale, predict, load, direct, aim, advance};
