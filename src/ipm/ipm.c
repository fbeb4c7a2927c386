/* SPDX-License-Identifier: BSD-3-Clause */
/* The interior-point loop: Mehrotra's predictor and corrector with Nesterov-Todd scaling, from an
 * infeasible start.
 *
 * Each iteration measures, scales and factorises. A predictor towards s o z = 0 shows how far the
 * complementarity can be reduced; the corrector aims at s o z = sigma mu e and subtracts the
 * predictor's second-order term. Primal and dual take the same step length, because the compliance
 * couples them. Every operation is a pass over arrays, and nothing is allocated. */
#include "ipm/ipm.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/lanes.h"
#include "base/larger.h"

/* Initial complementarity, and distance of the initial point from the boundary of the cones; all
 * data are of order one. */
static const double START_MU = 1.0;
static const double START_MARGIN = 0.5;
/* A step goes at most this share of the distance to the boundary. Nearer to 1, the iterates leave
 * the central path on fine meshes; smaller values cost iterations. */
static const double FRACTION = 0.98;
/* The loop ends at a step shorter than this, or after this many steps without halving the best
 * gap. */
static const double LEAST_STEP = 1e-6;
static const int PATIENCE = 8;
/* The gap and residuals together above which CpsiIpmOptions.patience counts. */
static const double EARLY = 1e-2;
/* Centring steps go at most this share of the distance to the boundary, since the remaining
 * distance must stay above rounding. */
static const double CLOSE = 0.9;
/* Each sharpening step aims at this share of the previous products s.z. */
static const double SHARPER = 0.01;
/* One that is shorter than this share has left the central path, and the next would be shorter
 * still: a step back to it follows, at most so many times, unless the gap is below this share of
 * the target. */
static const double SHORT = 0.7, SMALL = 0.1;
enum { MOST_RETURNS = 4 };
/* A ray counts as a proof when its value exceeds everything that the proof neglects by this factor,
 * for any u of size one. */
static const double RAY = 1e4;
/* An iterate this far from a start of size one is taken to diverge. */
static const double FAR = 1e8;

static void start(CpsiProgram *program) {
    for (int k = 0; k < program->kind_count; k++)
        if (program->kind[k]->start) program->kind[k]->start(program, START_MU, START_MARGIN);
}

/* Move the iterate by alpha along the direction, where alpha is not 0, and measure its residuals
 * and its complementarity. */
static CpsiSums measure(CpsiProgram *program, double alpha) {
    CpsiSums sums = {0};
    memcpy(program->residual, program->load, (size_t)program->size * sizeof *program->residual);
    if (alpha != 0)
        for (int i = 0; i < program->size; i++) program->u[i] += alpha * program->du[i];
    for (int k = 0; k < program->kind_count; k++) program->kind[k]->measure(program, alpha, &sums);
    return sums;
}

/* The matrix at the iterate, factorised. */
static bool scale_and_factor(CpsiProgram *program) {
    program->clear(program);
    for (int k = 0; k < program->kind_count; k++) program->kind[k]->scale(program);
    return program->factor(program);
}

/* Solve for the direction with this aim. */
static CpsiSums direction(CpsiProgram *program, const CpsiIpmAim *aim) {
    CpsiSums sums = {0};
    for (int i = 0; i < program->size; i++) program->du[i] = aim->keep * program->residual[i];
    for (int k = 0; k < program->kind_count; k++)
        if (program->kind[k]->load) program->kind[k]->load(program, aim);
    program->solve(program);
    for (int k = 0; k < program->kind_count; k++)
        if (program->kind[k]->direct) program->kind[k]->direct(program, aim, &sums);
    return sums;
}

static double step_length(const CpsiSums *sums, double fraction) {
    return sums->inverse_step <= fraction ? 1 : fraction / sums->inverse_step; /* NaN remains NaN */
}

/* Gap, residual and merit of an iterate. The imbalance of forces is relative to the largest force,
 * with which rounding grows. */
static double measure_merit(CpsiProgram *program, const CpsiSums *sums,
                            const CpsiIpmOptions *options, CpsiIpmReport *report) {
    report->imbalance = program->imbalance(program) / cpsi_max_nan(1, sums->largest);
    report->gap = sums->sz / (options->scale + sums->scale);
    report->residual = sums->residual;
    return report->gap + cpsi_max_nan(report->imbalance, report->residual);
}

/* From an iterate that has reached the target, steps to the central path at the present mu, then at
 * smaller mu. Newton's method converges fast that near. A step whose merit is above twice the
 * target is undone: the factor two is because the centred point may have a slightly larger gap than
 * an iterate just below the target. So is a step with sum s.z < 0, which is rounding beyond the
 * boundary. */
static void refine(CpsiProgram *program, const CpsiIpmOptions *options, const CpsiSums *sums,
                   CpsiIpmReport *report) {
    const int sharpenings = sums->bound > 0 ? options->sharpenings : 0;
    double mu = sums->sz / sums->weight;
    bool returns = false;
    for (int k = 0, returned = 0; k < options->centering_steps + sharpenings;) {
        const bool sharpens = k >= options->centering_steps && !returns;
        if (sharpens) mu *= SHARPER;
        if (!scale_and_factor(program)) return;
        const CpsiIpmAim centre = {CPSI_IPM_AIM_CENTRE, mu, 1};
        const CpsiSums step = direction(program, &centre);
        const double alpha = step_length(&step, CLOSE);
        if (!(alpha >= LEAST_STEP)) return;
        const CpsiIpmReport before = *report;
        const CpsiSums now = measure(program, alpha);
        if (!(measure_merit(program, &now, options, report) <= 2 * options->target) || now.sz < 0) {
            measure(program, -alpha);
            *report = before;
            return;
        }
        report->iterations++;
        const bool back = returns; /* the sharpening before it is taken again */
        returns = sharpens && alpha < SHORT && report->gap > SMALL * options->target &&
                  returned++ < MOST_RETURNS;
        if (returns) mu = now.sz / now.weight;
        if (!returns && !back) k++;
    }
}

/* Whether the duals are a ray that proves that there is no feasible u. Its value must exceed loads,
 * friction and residuals, and it must not load elements with compliance. */
static bool primal_infeasible(const CpsiProgram *program, const CpsiSums *sums) {
    if (sums->ray_cost > 0 || !(sums->ray > RAY)) return false;
    double neglected = sums->bound + program->size * program->imbalance(program) +
                       sqrt(DBL_EPSILON) * sums->largest / RAY + sums->pulled;
    for (int i = 0; i < program->size; i++) neglected += fabs(program->load[i]);
    return sums->ray > RAY * neglected;
}

/* Whether u is a ray along which the gain of the loads exceeds the energy of the elements without
 * bound. */
static bool dual_infeasible(const CpsiProgram *program, const CpsiSums *sums) {
    const double size = cpsi_lanes_size((size_t)program->size, program->u);
    if (!(size > FAR)) return false;
    double gain = 0;
    for (int i = 0; i < program->size; i++) gain += program->load[i] * program->u[i];
    return gain > sums->scale + sums->curved + size / FAR;
}

CpsiIpmReport cpsi_ipm_solve(CpsiProgram *program, const CpsiIpmOptions *options) {
    CpsiIpmReport report = {.outcome = CPSI_IPM_ITERATION_LIMIT};
    double best = INFINITY, alpha = 0;
    int waited = 0;
    if (!options->goes_on) start(program);
    for (;; report.iterations++) {
        /* move and measure the iterate, and stop where it is good enough */
        const CpsiSums sums = measure(program, alpha);
        const double merit = measure_merit(program, &sums, options, &report),
                     mu = sums.sz / sums.weight;
        if (!isfinite(merit) || cpsi_interrupt_look(program->interrupt)) {
            report.outcome = CPSI_IPM_STALLED;
            break;
        }
        if (merit <= options->target) {
            report.outcome = CPSI_IPM_SOLVED;
            refine(program, options, &sums, &report);
            break;
        }
        if (primal_infeasible(program, &sums)) {
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
        if (waited > (options->patience > 0 && merit > EARLY ? options->patience : PATIENCE)) {
            report.outcome = CPSI_IPM_STALLED;
            break;
        }

        /* Predictor: aims at s o z = 0. The shorter its step, the more the corrector centres. */
        if (!scale_and_factor(program)) {
            report.outcome = CPSI_IPM_STALLED;
            break;
        }
        const CpsiIpmAim ahead = {CPSI_IPM_AIM_PREDICT, 0, 1};
        const CpsiSums predictor = direction(program, &ahead);
        const double reach = step_length(&predictor, 1);
        const double sigma = (1 - reach) * (1 - reach);

        /* Corrector: aims at s o z = sigma mu e, but never below what the target requires, since
         * the residuals may still need distance from the boundary. */
        const double least = 0.1 * options->target * (options->scale + sums.scale) / sums.weight;
        const CpsiIpmAim aim = {CPSI_IPM_AIM_CORRECT, fmax(sigma * mu, least), 1 - sigma};
        const CpsiSums corrector = direction(program, &aim);
        alpha = step_length(&corrector, FRACTION);
        if (!(alpha >= LEAST_STEP)) {
            report.outcome = CPSI_IPM_STALLED;
            break;
        }
    }
    return report;
}
