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
/* A ray is a proof once its value outweighs all that it neglects by this factor, for any u of size one. */
static const double RAY = 1e4;
/* An iterate this far from a start of size one runs away. */
static const double FAR = 1e8;

static void start(CpsiProgram *program) {
    for (int k = 0; k < program->kind_count; k++) program->kind[k]->start(program, START_MU, START_MARGIN);
}

/* Residuals and complementarity of the iterate. */
static CpsiSums measure(CpsiProgram *program) {
    CpsiSums sums = {0};
    memcpy(program->residual, program->load, (size_t)program->size*sizeof *program->residual);
    for (int k = 0; k < program->kind_count; k++) program->kind[k]->measure(program, &sums);
    return sums;
}

/* The matrix at the iterate, factorised. */
static bool scale_and_factor(CpsiProgram *program) {
    program->clear(program);
    for (int k = 0; k < program->kind_count; k++) program->kind[k]->scale(program);
    return program->factor(program);
}

/* Solve for the direction that the elements' q ask for, removing the share `keep` of the residuals. */
static CpsiSums direction(CpsiProgram *program, double keep, bool predictor) {
    CpsiSums sums = {0};
    for (int i = 0; i < program->size; i++) program->du[i] = keep*program->residual[i];
    for (int k = 0; k < program->kind_count; k++) program->kind[k]->load(program, keep);
    program->solve(program);
    for (int k = 0; k < program->kind_count; k++) program->kind[k]->direct(program, keep, predictor, &sums);
    return sums;
}

static void correct(CpsiProgram *program, double target) {
    for (int k = 0; k < program->kind_count; k++) program->kind[k]->correct(program, target);
}

static void advance(CpsiProgram *program, double alpha) {
    for (int i = 0; i < program->size; i++) program->u[i] += alpha*program->du[i];
    for (int k = 0; k < program->kind_count; k++) program->kind[k]->advance(program, alpha);
}

static double step_length(const CpsiSums *sums, double fraction) {
    return sums->inverse_step <= fraction ? 1 : fraction/sums->inverse_step; /* NaN stays NaN */
}

/* A step to the centre of where the iterate is: Newton's method alone, which converges fast so near to it. */
static bool centre(CpsiProgram *program, double mu) {
    if (!scale_and_factor(program)) return false;
    for (int k = 0; k < program->kind_count; k++) program->kind[k]->centre(program, mu);
    const CpsiSums sums = direction(program, 1, false);
    const double alpha = step_length(&sums, FRACTION);
    if (!(alpha >= LEAST_STEP)) return false;
    advance(program, alpha);
    return true;
}

/* Are the duals a ray that no primal point can meet?  Its value must outweigh loads, friction and residuals, and it may not
 * strain anything with compliance. */
static bool primal_infeasible(const CpsiProgram *program, const CpsiSums *sums, double imbalance) {
    if (sums->ray_cost > 0 || !(sums->ray > RAY)) return false;
    double neglected = sums->bound + program->size*imbalance + sqrt(DBL_EPSILON)*sums->largest/RAY;
    for (int i = 0; i < program->size; i++) neglected += fabs(program->load[i]);
    return sums->ray > RAY*neglected;
}

/* Is u a ray along which the loads gain more than the elements take, for ever? */
static bool dual_infeasible(const CpsiProgram *program, const CpsiSums *sums) {
    double size = 0, gain = 0;
    for (int i = 0; i < program->size; i++) {
        gain += program->load[i]*program->u[i];
        size = cpsi_larger(size, fabs(program->u[i]));
    }
    return size > FAR && gain > sums->scale + size/FAR;
}

CpsiIpmReport cpsi_ipm_solve(CpsiProgram *program, const CpsiIpmOptions *options) {
    CpsiIpmReport report = {.outcome = CPSI_IPM_ITERATION_LIMIT};
    double best = INFINITY;
    int waited = 0, centrings = 0;
    start(program);
    for (;; report.iterations++) {
        /* where are we, and is it enough? */
        const CpsiSums sums = measure(program);
        const double imbalance = program->imbalance(program), mu = sums.sz/sums.weight;
        report.gap = sums.sz/(options->scale + sums.scale);
        report.residual = cpsi_larger(imbalance, sums.residual);
        const double merit = report.gap + report.residual;
        if (!isfinite(merit)) { report.outcome = CPSI_IPM_STALLED; break; }
        if (merit <= options->target) {
            report.outcome = CPSI_IPM_SOLVED;
            if (centrings++ >= options->centrings || !centre(program, mu)) break;
            continue;
        }
        if (centrings > 0) break; /* as near as rounding lets it */
        if (primal_infeasible(program, &sums, imbalance)) { report.outcome = CPSI_IPM_INFEASIBLE; break; }
        if (dual_infeasible(program, &sums)) { report.outcome = CPSI_IPM_UNBOUNDED; break; }
        if (report.iterations >= options->max_iterations) break;
        waited = merit < 0.5*best ? 0 : waited + 1;
        if (waited == 0) best = merit;
        if (waited > PATIENCE) { report.outcome = CPSI_IPM_STALLED; break; }

        /* predictor: straight for s o z = 0; the less of the way it gets, the more the corrector centres */
        if (!scale_and_factor(program)) { report.outcome = CPSI_IPM_STALLED; break; }
        const CpsiSums predictor = direction(program, 1, true);
        const double reach = step_length(&predictor, 1);
        const double sigma = (1 - reach)*(1 - reach);

        /* corrector: for s o z = sigma mu e, but never below what the target asks: residuals may still need room */
        const double least = 0.1*options->target*(options->scale + sums.scale)/sums.weight;
        correct(program, fmax(sigma*mu, least));
        const CpsiSums corrector = direction(program, 1 - sigma, false);
        const double alpha = step_length(&corrector, FRACTION);
        if (!(alpha >= LEAST_STEP)) { report.outcome = CPSI_IPM_STALLED; break; }
        advance(program, alpha);
    }
    return report;
}
