/* SPDX-License-Identifier: BSD-3-Clause */
/* The interior-point loop: Mehrotra's predictor and corrector with Nesterov-Todd scaling, from an infeasible start.
 *
 * Per iteration: measure, scale, factorise; a predictor towards s o z = 0 tells how far one may aim, the corrector aims at
 * s o z = sigma mu e with the predictor's second-order term taken off. One step length for primal and dual, because the
 * compliance ties them. Everything is a pass over arrays; nothing is allocated. */
#include "ipm/ipm.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/larger.h"

/* First complementarity and the distance of the start from the cones' boundary; all data are of order one. */
static const double START_MU = 1.0;
static const double START_MARGIN = 0.5;
/* Share of the way to the boundary that a step may take: nearer to 1 loses the centre on fine meshes, lower costs steps. */
static const double FRACTION = 0.98;
/* A step shorter than this, or this many steps without halving the best gap, end the loop. */
static const double LEAST_STEP = 1e-6;
static const int PATIENCE = 8;
/* A ray is a proof once its value outweighs all that it neglects by this factor, for any u up to as many line lengths. */
static const double RAY = 1e4;

static void start(CpsiProgram *program) {
    cpsi_stretch_start(program, START_MU, START_MARGIN);
    cpsi_rub_start(program, START_MU);
    cpsi_stop_start(program, START_MU, START_MARGIN);
}

/* Residuals and complementarity of the iterate. */
static CpsiSums measure(CpsiProgram *program) {
    CpsiSums sums = {0};
    memcpy(program->residual, program->load, 3*(size_t)program->n*sizeof *program->residual);
    cpsi_stretch_measure(program, &sums);
    cpsi_rub_measure(program, &sums);
    cpsi_stop_measure(program, &sums);
    return sums;
}

static double largest_imbalance(const CpsiProgram *program) {
    double largest = 0;
    for (int j = 0; j < program->n; j++)
        for (int a = 0; a < 3 && !program->held[j]; a++) largest = cpsi_larger(largest, fabs(program->residual[3*j + a]));
    return largest;
}

/* The matrix at the iterate, factorised. */
static bool scale_and_factor(CpsiProgram *program) {
    memset(program->matrix.diagonal, 0, 6*(size_t)program->n*sizeof *program->matrix.diagonal);
    cpsi_stretch_scale(program);
    cpsi_rub_scale(program);
    cpsi_stop_scale(program);
    return program->ops->factor(program->linsys, &program->matrix);
}

/* Solve for the direction that the elements' q ask for, removing the share `keep` of the residuals. */
static CpsiSums direction(CpsiProgram *program, double keep) {
    for (int i = 0; i < 3*program->n; i++) program->du[i] = keep*program->residual[i];
    cpsi_stretch_load(program, keep);
    cpsi_rub_load(program);
    cpsi_stop_load(program, keep);
    memset(program->dt, 0, (size_t)program->n*sizeof *program->dt);
    program->ops->solve(program->linsys, &program->matrix, program->du, program->dt);
    CpsiSums sums = {0};
    cpsi_stretch_direct(program, keep, &sums);
    cpsi_rub_direct(program, &sums);
    cpsi_stop_direct(program, keep, &sums);
    return sums;
}

static void correct(CpsiProgram *program, double target) {
    cpsi_stretch_correct(program, target);
    cpsi_rub_correct(program, target);
    cpsi_stop_correct(program, target);
}

static void advance(CpsiProgram *program, double alpha) {
    for (int i = 0; i < 3*program->n; i++) program->u[i] += alpha*program->du[i];
    cpsi_stretch_advance(program, alpha);
    cpsi_rub_advance(program, alpha);
    cpsi_stop_advance(program, alpha);
}

static double step_length(const CpsiSums *sums, double fraction) {
    return sums->inverse_step <= fraction ? 1 : fraction/sums->inverse_step; /* NaN stays NaN */
}

/* Are the duals a ray that no primal point can meet?  Its value must outweigh loads, friction and residuals, and it may not
 * strain anything with compliance. */
static bool primal_infeasible(const CpsiProgram *program, const CpsiSums *sums, double imbalance) {
    if (sums->ray_cost > 0 || !(sums->ray > RAY)) return false;
    double neglected = program->n*imbalance + sqrt(DBL_EPSILON)*sums->largest/RAY;
    for (int i = 0; i < 3*program->n; i++) neglected += fabs(program->load[i]);
    for (int k = 0; k < program->rub.count; k++) neglected += program->rub.weight[k]*program->rub.z[k][0];
    return sums->ray > RAY*neglected;
}

/* Is u a ray along which the loads gain more than friction takes, for ever? */
static bool dual_infeasible(const CpsiProgram *program) {
    double size = 0, gain = 0, cost = 0;
    for (int i = 0; i < 3*program->n; i++) {
        gain += program->load[i]*program->u[i];
        if (fabs(program->u[i]) > size) size = fabs(program->u[i]);
    }
    if (size < RAY) return false;
    for (int k = 0; k < program->rub.count; k++) cost += program->rub.weight[k]*program->rub.z[k][0]*program->rub.s[k][0];
    for (int i = 1; i < program->n; i++) cost += program->stretch.length[i]*program->stretch.z[i][0]*program->stretch.s[i][0];
    return gain > cost + size/RAY;
}

CpsiIpmReport cpsi_ipm_solve(CpsiProgram *program, const CpsiIpmOptions *options) {
    CpsiIpmReport report = {.outcome = CPSI_IPM_ITERATION_LIMIT};
    double best = INFINITY;
    int waited = 0;
    start(program);
    for (;; report.iterations++) {
        /* where are we, and is it enough? */
        const CpsiSums sums = measure(program);
        const double imbalance = largest_imbalance(program), mu = sums.sz/sums.weight;
        report.gap = sums.sz/(options->scale + sums.scale);
        report.residual = cpsi_larger(imbalance, sums.residual);
        const double merit = report.gap + report.residual;
        if (!isfinite(merit)) { report.outcome = CPSI_IPM_STALLED; break; }
        if (merit <= options->target) { report.outcome = CPSI_IPM_SOLVED; break; }
        if (primal_infeasible(program, &sums, imbalance)) { report.outcome = CPSI_IPM_INFEASIBLE; break; }
        if (dual_infeasible(program)) { report.outcome = CPSI_IPM_UNBOUNDED; break; }
        if (report.iterations >= options->max_iterations) break;
        waited = merit < 0.5*best ? 0 : waited + 1;
        if (waited == 0) best = merit;
        if (waited > PATIENCE) { report.outcome = CPSI_IPM_STALLED; break; }

        /* predictor: straight for s o z = 0 */
        if (!scale_and_factor(program)) { report.outcome = CPSI_IPM_STALLED; break; }
        const CpsiSums predictor = direction(program, 1);
        const double reach = step_length(&predictor, 1);
        const double aim = (sums.sz + reach*predictor.first + reach*reach*predictor.second)/sums.sz;
        const double sigma = aim > 0 ? fmin(1, aim*aim*aim) : 0;

        /* corrector: for s o z = sigma mu e */
        correct(program, sigma*mu);
        const CpsiSums corrector = direction(program, 1 - sigma);
        const double alpha = step_length(&corrector, FRACTION);
        if (!(alpha >= LEAST_STEP)) { report.outcome = CPSI_IPM_STALLED; break; }
        advance(program, alpha);
    }
    return report;
}
