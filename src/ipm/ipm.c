/* SPDX-License-Identifier: BSD-3-Clause */
/* The interior-point loop: Mehrotra's predictor and corrector with Nesterov-Todd scaling, from an
 * infeasible start.
 *
 * Per iteration: measure, scale, factorise; a predictor towards s o z = 0 tells how far one may
 * aim, the corrector aims at s o z = sigma mu e with the predictor's second-order term taken off.
 * One step length for primal and dual, because the compliance ties them. Everything is a pass over
 * arrays; nothing is allocated. */
#include "ipm/ipm.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/larger.h"

/* First complementarity and the distance of the start from the cones' boundary; all data are of
 * order one. */
static const double START_MU = 1.0;
static const double START_MARGIN = 0.5;
/* Share of the way to the boundary that a step may take: nearer to 1 loses the centre on fine
 * meshes, lower costs steps. */
static const double FRACTION = 0.98;
/* A step shorter than this, or this many steps without halving the best gap, end the loop. */
static const double LEAST_STEP = 1e-6;
static const int PATIENCE = 8;
/* Steps at the target keep this much from the boundary: what is left there must stay above
 * rounding. */
static const double CLOSE = 0.9;
/* Each sharpening aims at this share of the products before it. */
static const double SHARPER = 0.01;
/* A ray is a proof once its value outweighs all that it neglects by this factor, for any u of size
 * one. */
static const double RAY = 1e4;
/* An iterate this far from a start of size one runs away. */
static const double FAR = 1e8;

static void start(CpsiProgram *program) {
    for (int k = 0; k < program->kind_count; k++)
        program->kind[k]->start(program, START_MU, START_MARGIN);
}

/* Residuals and complementarity of the iterate. */
static CpsiSums measure(CpsiProgram *program) {
    CpsiSums sums = {0};
    memcpy(program->residual, program->load, (size_t)program->size * sizeof *program->residual);
    for (int k = 0; k < program->kind_count; k++) program->kind[k]->measure(program, &sums);
    return sums;
}

/* The matrix at the iterate, factorised. */
static bool scale_and_factor(CpsiProgram *program) {
    program->clear(program);
    for (int k = 0; k < program->kind_count; k++) program->kind[k]->scale(program);
    return program->factor(program);
}

/* Solve for the direction that the elements' q ask for, removing the share `keep` of the
 * residuals. */
static CpsiSums direction(CpsiProgram *program, double keep, bool predictor) {
    CpsiSums sums = {0};
    for (int i = 0; i < program->size; i++) program->du[i] = keep * program->residual[i];
    for (int k = 0; k < program->kind_count; k++) program->kind[k]->load(program, keep);
    program->solve(program);
    for (int k = 0; k < program->kind_count; k++)
        program->kind[k]->direct(program, keep, predictor, &sums);
    return sums;
}

static void correct(CpsiProgram *program, double target) {
    for (int k = 0; k < program->kind_count; k++) program->kind[k]->correct(program, target);
}

static void advance(CpsiProgram *program, double alpha) {
    for (int i = 0; i < program->size; i++) program->u[i] += alpha * program->du[i];
    for (int k = 0; k < program->kind_count; k++) program->kind[k]->advance(program, alpha);
}

static double step_length(const CpsiSums *sums, double fraction) {
    return sums->inverse_step <= fraction ? 1 : fraction / sums->inverse_step; /* NaN stays NaN */
}

/* Gap, residual and merit of an iterate. Forces are off balance relative to the largest, which
 * their rounding goes with. */
static double judge(CpsiProgram *program, const CpsiSums *sums, const CpsiIpmOptions *options,
                    CpsiIpmReport *report) {
    report->imbalance = program->imbalance(program) / cpsi_max_nan(1, sums->largest);
    report->gap = sums->sz / (options->scale + sums->scale);
    report->residual = sums->residual;
    return report->gap + cpsi_max_nan(report->imbalance, report->residual);
}

/* From an iterate at the target: steps to the centre, at the mu reached, then below. That near,
 * Newton's method alone converges fast. A step that leaves the target is taken back; the centre of
 * an iterate just inside may lie a little above it. Less than 0 is rounding beyond the boundary. */
static void refine(CpsiProgram *program, const CpsiIpmOptions *options, const CpsiSums *sums,
                   CpsiIpmReport *report) {
    const int sharpenings = sums->bound > 0 ? options->sharpenings : 0;
    double mu = sums->sz / sums->weight;
    for (int k = 0; k < options->centering_steps + sharpenings; k++) {
        if (k >= options->centering_steps) mu *= SHARPER;
        if (!scale_and_factor(program)) return;
        for (int i = 0; i < program->kind_count; i++) program->kind[i]->centre(program, mu);
        const CpsiSums step = direction(program, 1, false);
        const double alpha = step_length(&step, CLOSE);
        if (!(alpha >= LEAST_STEP)) return;
        advance(program, alpha);
        const CpsiIpmReport before = *report;
        const CpsiSums now = measure(program);
        if (!(judge(program, &now, options, report) <= 2 * options->target) || now.sz < 0) {
            advance(program, -alpha);
            *report = before;
            return;
        }
        report->iterations++;
    }
}

/* Are the duals a ray that no primal point can meet?  Its value must outweigh loads, friction and
 * residuals, and it may not strain anything with compliance. */
static bool primal_infeasible(const CpsiProgram *program, const CpsiSums *sums, double imbalance) {
    if (sums->ray_cost > 0 || !(sums->ray > RAY)) return false;
    double neglected =
        sums->bound + program->size * imbalance + sqrt(DBL_EPSILON) * sums->largest / RAY;
    for (int i = 0; i < program->size; i++) neglected += fabs(program->load[i]);
    return sums->ray > RAY * neglected;
}

/* Is u a ray along which the loads gain more than the elements take, for ever? */
static bool dual_infeasible(const CpsiProgram *program, const CpsiSums *sums) {
    double size = 0, gain = 0;
    for (int i = 0; i < program->size; i++) {
        gain += program->load[i] * program->u[i];
        size = cpsi_max_nan(size, fabs(program->u[i]));
    }
    return size > FAR && gain > sums->scale + size / FAR;
}

CpsiIpmReport cpsi_ipm_solve(CpsiProgram *program, const CpsiIpmOptions *options) {
    CpsiIpmReport report = {.outcome = CPSI_IPM_ITERATION_LIMIT};
    double best = INFINITY;
    int waited = 0;
    const int patience = options->patience > 0 ? options->patience : PATIENCE;
    start(program);
    for (;; report.iterations++) {
        /* where are we, and is it enough? */
        const CpsiSums sums = measure(program);
        const double merit = judge(program, &sums, options, &report), mu = sums.sz / sums.weight;
        if (!isfinite(merit) || cpsi_interrupt_look(program->interrupt)) {
            report.outcome = CPSI_IPM_STALLED;
            break;
        }
        if (merit <= options->target) {
            report.outcome = CPSI_IPM_SOLVED;
            refine(program, options, &sums, &report);
            break;
        }
        if (primal_infeasible(program, &sums, program->imbalance(program))) {
            report.outcome = CPSI_IPM_INFEASIBLE;
            break;
        }
        if (dual_infeasible(program, &sums)) {
            report.outcome = CPSI_IPM_UNBOUNDED;
            break;
        }
        if (report.iterations >= options->max_iterations) break;
        waited = merit < 0.5 * best ? 0 : waited + 1;
        if (waited == 0) best = merit;
        if (waited > patience) {
            report.outcome = CPSI_IPM_STALLED;
            break;
        }

        /* predictor: straight for s o z = 0; the less of the way it gets, the more the corrector
         * centres */
        if (!scale_and_factor(program)) {
            report.outcome = CPSI_IPM_STALLED;
            break;
        }
        const CpsiSums predictor = direction(program, 1, true);
        const double reach = step_length(&predictor, 1);
        const double sigma = (1 - reach) * (1 - reach);

        /* corrector: for s o z = sigma mu e, but never below what the target asks: residuals may
         * still need room */
        const double least = 0.1 * options->target * (options->scale + sums.scale) / sums.weight;
        correct(program, fmax(sigma * mu, least));
        const CpsiSums corrector = direction(program, 1 - sigma, false);
        const double alpha = step_length(&corrector, FRACTION);
        if (!(alpha >= LEAST_STEP)) {
            report.outcome = CPSI_IPM_STALLED;
            break;
        }
        advance(program, alpha);
    }
    return report;
}
