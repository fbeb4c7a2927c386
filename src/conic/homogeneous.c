/* SPDX-License-Identifier: BSD-3-Clause */
/* The homogeneous form as one kind of element: the cones on linear maps of u = (x, y, tau), and tau
 * with its dual kappa and the skew term that joins them. Directions:
 *
 *     ds = A dx + b dtau + keep rho,   dz = q - H ds,   H = g W^-2 (cones.h)
 *     dkappa = q_tau - (kappa/tau) dtau
 *
 * Near a solution A'H A contains numbers from mu to 1/mu, of which rounding preserves only the
 * large ones. Therefore the scaled dual directions w = W dz/sqrt(g) remain unknowns beside du,
 *
 *     w + A~ dx + b~ dtau = W q/sqrt(g) - keep sqrt(g) W^-1 rho,     (A~, b~) = sqrt(g) W^-1 (A, b)
 *
 * and the operator solves for both. */
#include "conic/homogeneous.h"

#include <math.h>
#include <string.h>

#include "base/larger.h"
#include "linalg/dense.h"

static inline CpsiHomogeneous *homogeneous(CpsiProgram *base) { return (CpsiHomogeneous *)base; }

static void start(CpsiProgram *base, double mu, double margin) {
    (void)margin;
    CpsiHomogeneous *program = homogeneous(base);
    cpsi_cones_start(&program->cones, mu);
    memset(base->u, 0, (size_t)base->size * sizeof *base->u);
    base->u[cpsi_homogeneous_tau(program)] = 1;
    program->kappa = mu;
}

/* Store the iterate if it is the best so far. */
static void keep_best(CpsiHomogeneous *program, CpsiConicOutcome outcome, double gap,
                      double residual) {
    CpsiConicResult *found = &program->found;
    found->iterations++;
    if (gap < 0 && !program->operator->keeps_negative_gaps) return;
    if (!(gap + residual < found->gap + found->residual)) return;
    found->outcome = outcome;
    found->gap = gap;
    found->residual = residual;
    const size_t n = (size_t)cpsi_homogeneous_tau(program) + 1, m = (size_t)program->cones.rows;
    memcpy(program->best, program->base.u, n * sizeof *program->best);
    memcpy(program->best + n, program->cones.s, m * sizeof *program->best);
    memcpy(program->best + n + m, program->cones.z, m * sizeof *program->best);
}

/* Measure how near the iterate is to each of the three outcomes. The measure of the nearest one
 * becomes the residual of the loop. base.residual holds A'z + E'y and E x in the places of x and
 * y. */
static void measure_outcomes(CpsiHomogeneous *program, double gain, double pull, CpsiSums *sums) {
    const int n = program->unknowns;
    const double tau = program->base.u[cpsi_homogeneous_tau(program)],
                 *force = program->base.residual;
    double dual = 0, ray_dual = 0, ray_primal = 0, equation = 0;
    for (int j = 0; j < n; j++) {
        dual = cpsi_max_nan(dual, fabs(force[j] - program->c[j] * tau));
        ray_dual = cpsi_max_nan(ray_dual, fabs(force[j]));
    }
    for (int i = 0; i < program->equations; i++) {
        equation = cpsi_max_nan(equation, fabs(force[n + i] + program->h[i] * tau));
        ray_primal = cpsi_max_nan(ray_primal, fabs(force[n + i]));
    }
    for (int i = 0; i < program->cones.rows; i++)
        ray_primal = cpsi_max_nan(ray_primal, fabs(program->cones.rho[i] - program->b[i] * tau));
    const double value = fmin(fabs(gain), fabs(pull)) / tau, sz = sums->sz + tau * program->kappa;
    double residual = cpsi_max_nan(cpsi_max_nan(sums->residual, equation), dual) / tau,
           scale = tau * tau * (1 + value);
    CpsiConicOutcome outcome = CPSI_CONIC_SOLVED;
    if (program->kappa > tau && pull < 0 && ray_dual / -pull < residual) {
        outcome = CPSI_CONIC_INFEASIBLE;
        residual = ray_dual / -pull;
    }
    if (program->kappa > tau && gain < 0 && ray_primal / -gain < residual) {
        outcome = CPSI_CONIC_UNBOUNDED;
        residual = ray_primal / -gain;
    }
    /* a ray is measured by its residual alone */
    if (outcome != CPSI_CONIC_SOLVED) scale = sz / residual;
    sums->residual = residual;
    sums->scale = scale;
    keep_best(program, outcome, sz / scale, residual);
}

static void advance(CpsiHomogeneous *program, double alpha) {
    cpsi_cones_advance(&program->cones, alpha);
    program->kappa += alpha * program->d_kappa;
}

static void measure(CpsiProgram *base, double alpha, CpsiSums *sums) {
    CpsiHomogeneous *program = homogeneous(base);
    CpsiCones *cones = &program->cones;
    if (alpha != 0) advance(program, alpha);
    const int n = program->unknowns;
    const double tau = base->u[cpsi_homogeneous_tau(program)];
    program->operator->multiply(program, base->u, -1, cones->s, cones->rho);
    for (int i = 0; i < cones->rows; i++) {
        sums->residual = cpsi_max_nan(sums->residual, fabs(cones->rho[i]));
        sums->sz += cones->s[i] * cones->z[i];
    }
    const double gain = cpsi_dot(n, program->c, base->u);
    const double pull = program->operator->offset(program, base->u + n, cones->z);
    program->operator->multiply_transposed(program, gain, pull);
    measure_outcomes(program, gain, pull, sums);
    sums->weight += cones->count + 1;
    sums->sz += tau * program->kappa;
    for (int j = 0; j < n; j++) base->residual[j] -= program->c[j] * tau;
    for (int i = n; i < n + program->equations; i++)
        base->residual[i] = -base->residual[i] - program->h[i - n] * tau;
}

static void scale(CpsiProgram *base) {
    CpsiHomogeneous *program = homogeneous(base);
    cpsi_cones_scale(&program->cones);
    program->operator->scale(program);
    program->q_tau = -program->kappa;
}

/* The right-hand sides of the corrector; `scale` has computed those of the predictor, and there are
 * no centring steps. */
static void correct(CpsiHomogeneous *program, double target) {
    const double tau = program->base.u[cpsi_homogeneous_tau(program)];
    cpsi_cones_correct(&program->cones, target);
    program->q_tau = -program->kappa + (target - program->d_tau * program->d_kappa) / tau;
}

static void load(CpsiProgram *base, const CpsiIpmAim *aim) {
    CpsiHomogeneous *program = homogeneous(base);
    CpsiCones *cones = &program->cones;
    if (aim->kind == CPSI_IPM_AIM_CORRECT) correct(program, aim->target);
    const int tau = cpsi_homogeneous_tau(program);
    double *w = &base->du[tau + 1];
    CPSI_FOR_CONES(k, i, cones->count, cones->dim) {
        const double root = sqrt(cones->g[k]);
        cpsi_cones_apply(cones, k, i, 1, 1 / root, &cones->q[i], &w[i]);
        cpsi_cones_apply(cones, k, i, -1, aim->keep * root, &cones->rho[i], cones->scratch);
        for (int r = 0; r < cones->dim[k]; r++) w[i + r] -= cones->scratch[r];
    }
    base->du[tau] += program->q_tau;
}

static void direct(CpsiProgram *base, const CpsiIpmAim *aim, CpsiSums *sums) {
    CpsiHomogeneous *program = homogeneous(base);
    CpsiCones *cones = &program->cones;
    const int at = cpsi_homogeneous_tau(program);
    const double tau = base->u[at], d_tau = program->d_tau = base->du[at];
    program->operator->multiply(program, base->du, aim->keep, cones->rho, cones->ds);
    CPSI_FOR_CONES(k, i, cones->count, cones->dim)
        cpsi_cones_apply(cones, k, i, -1, sqrt(cones->g[k]), &base->du[at + 1 + i], &cones->dz[i]);
    sums->inverse_step = cpsi_max_nan(sums->inverse_step, cpsi_cones_step(cones));
    program->d_kappa = program->q_tau - program->kappa / tau * d_tau;
    sums->inverse_step =
        cpsi_max_nan(sums->inverse_step,
                     cpsi_max_nan(-d_tau / tau, -program->d_kappa / program->kappa));
}

static const CpsiKind HOMOGENEOUS = {start, measure, scale, load, direct};
static const CpsiKind *const KINDS[] = {&HOMOGENEOUS};

static void clear(CpsiProgram *base) { (void)base; /* `scale` and `factor` write every entry */ }

static double imbalance(const CpsiProgram *base) {
    (void)base; /* counted by `measure_outcomes` */
    return 0;
}

void cpsi_homogeneous_layout(CpsiHomogeneous *program, CpsiArena *arena,
                             const CpsiConicOperator *operator, int unknowns, int equations,
                             int rows, int cones, int largest_cone) {
    const size_t free_of_cones = (size_t)unknowns + (size_t)equations + 1,
                 size = free_of_cones + (size_t)rows;
    *program = (CpsiHomogeneous){.operator= operator, .unknowns = unknowns, .equations = equations};
    cpsi_cones_layout(arena, &program->cones, rows, cones, largest_cone);
    double *loop = cpsi_arena_take(arena, 4 * size, sizeof *loop);
    CPSI_PLACE(arena, program->best, free_of_cones + 2 * (size_t)rows);
    if (!loop) return;
    program->base = (CpsiProgram){.size = (int)size,
                                  .load = loop,
                                  .u = loop + size,
                                  .du = loop + 2 * size,
                                  .residual = loop + 3 * size,
                                  .kind_count = 1,
                                  .kind = KINDS,
                                  .clear = clear,
                                  .factor = operator->factor,
                                  .solve = operator->solve,
                                  .imbalance = imbalance};
}

void cpsi_homogeneous_begin(CpsiHomogeneous *program) {
    program->found =
        (CpsiConicResult){.outcome = CPSI_CONIC_FAILED, .gap = INFINITY, .residual = INFINITY};
}

CpsiConicResult cpsi_homogeneous_result(CpsiHomogeneous *program) {
    const int n = program->unknowns, tau = cpsi_homogeneous_tau(program),
              rows = program->cones.rows;
    const double *u = program->best, *s = u + tau + 1, *z = s + rows;
    CpsiConicResult result = program->found;
    result.x = program->base.u;
    result.y = program->base.u + n;
    result.s = program->cones.s;
    result.z = program->cones.z;
    /* b.z + h.y; then the value of the dual ray and that of the primal ray */
    double by = u[tau];
    if (result.outcome == CPSI_CONIC_INFEASIBLE) by = -program->operator->offset(program, u + n, z);
    if (result.outcome == CPSI_CONIC_UNBOUNDED) by = -cpsi_dot(n, program->c, u);
    for (int j = 0; j < tau; j++) program->base.u[j] = u[j] / by;
    for (int i = 0; i < rows; i++) {
        program->cones.s[i] = s[i] / by;
        program->cones.z[i] = z[i] / by;
    }
    return result;
}
