/* SPDX-License-Identifier: BSD-3-Clause */
/* The method of S90 section 5 on a copied step (see capstan/regularized.h): memory, continuation
 * from coarse parameters to the final ones, report. */
#include "capstan/regularized.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "regularized/handle.h"

enum { MAX_CELLS = 1000000, COARSE_CELLS = 25 };

/* the parameters change by at most this factor from one step of the continuation to the next */
static const double CONTINUATION_FACTOR = 30;

CpsStatus cps_regularized_create(const CpsLineView *step, CpsRegularized **out, CpsError *err) {
    if (!step || !out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "step or out is NULL");
    *out = NULL;
    CpsRegularized *regularized = calloc(1, sizeof *regularized);
    if (!regularized) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    const CpsStatus status = cpsi_step_copy(step, &regularized->step, err);
    regularized->asked = -1;
    if (status == CPS_OK)
        *out = regularized;
    else
        free(regularized);
    return status;
}

void cps_regularized_destroy(CpsRegularized *regularized) {
    if (!regularized) return;
    cpsi_arena_free(&regularized->step.arena);
    cpsi_arena_free(&regularized->arena);
    free(regularized);
}

CpsRegularizedStep cps_regularized_step(const CpsRegularized *regularized) {
    if (!regularized) return (CpsRegularizedStep){0};
    const CpsiStep *step = &regularized->step;
    return (CpsRegularizedStep){.element_count = step->own.cells,
                                .length = step->length,
                                .stiffness = 1 / step->compliance,
                                .energy = step->energy,
                                .force = step->force,
                                .arc_length = step->own.arc,
                                .reference = step->own.reference,
                                .position = step->own.position,
                                .tension = step->own.tension};
}

enum { PARAMETERS_COOKIE = 0x0e901a12 };

CpsRegularizedParameters cps_regularized_parameters_default(void) {
    return (CpsRegularizedParameters){.cookie = PARAMETERS_COOKIE};
}

CpsRegularizedParameters cps_regularized_coarse(const CpsRegularized *regularized) {
    if (!regularized) return (CpsRegularizedParameters){0};
    const CpsiStep *step = &regularized->step;
    double load = 0;
    for (int k = 0; k < 3 * (step->own.cells + 1); ++k) load += fabs(step->own.load[k]);
    const double per_length = fmax(load, 1e-3 * step->force) / step->length;
    return (CpsRegularizedParameters){.cookie = PARAMETERS_COOKIE,
                                      .cell_count = COARSE_CELLS,
                                      /* the line sinks in by a tenth of its length */
                                      .penalty = 10 * per_length / step->length,
                                      /* the line bends under its own weight */
                                      .stiffness = 1e-3 * per_length * pow(step->length, 3),
                                      .delta = 0.03 * step->length};
}

/* A corner of the line, for instance at the clamped end, is bent within an element of length w by a
 * force of (1/n)/w^2. With more than 800 elements 1/n must therefore decrease as w^2, otherwise its
 * effect would grow with the mesh. */
CpsRegularizedParameters cps_regularized_fine(const CpsRegularized *regularized) {
    if (!regularized) return (CpsRegularizedParameters){0};
    const CpsiStep *step = &regularized->step;
    CpsRegularizedParameters fine = cps_regularized_coarse(regularized);
    double shortest = step->length;
    for (int i = 0; i < step->own.cells; ++i) shortest = fmin(shortest, step->own.width[i]);
    const double finer = 800 * shortest / step->length;
    fine.cell_count = 0;
    fine.penalty *= 1e6;
    fine.stiffness *= 1e-9;
    fine.delta *= 1e-7;
    if (finer < 1 - 1e-9) /* 800 equal elements must not count as finer because of rounding */
        fine.stiffness *= finer * finer;
    return fine;
}

/* ---- memory of the cells ---- */

static void layout(CpsRegularized *c, int cells, CpsiArena *arena) {
    cpsi_cells_place(&c->cells, &c->step, cells, arena);
    const size_t places = (size_t)c->cells.cells + 1;
    CPSI_PLACE(arena, c->f.place, 3 * places);
    CPSI_PLACE(arena, c->f.gradient, 3 * places);
    CPSI_PLACE(arena, c->unknown, 3 * places);
    CPSI_PLACE(arena, c->work, 3 * places * (4 + CPSI_REGULARIZED_BAND + 1));
    CPSI_PLACE(arena, c->tension, places);
}

/* the initial positions: the reference, or the last solution where the cells are the same */
static CpsStatus prepare(CpsRegularized *c, int cells, CpsError *err) {
    if (c->asked == cells) return CPS_OK;
    CpsiArena arena = {0};
    CpsRegularized next = *c;
    layout(&next, cells, &arena);
    if (!cpsi_arena_allocate(&arena)) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    layout(&next, cells, &arena);
    cpsi_arena_free(&c->arena);
    next.arena = arena;
    next.asked = cells;
    *c = next;
    c->f.step = &c->step;
    c->f.cells = &c->cells;
    c->f.unknowns = 3 * (c->cells.cells - (c->step.held ? 1 : 0));
    memcpy(c->unknown, c->cells.reference + 3, (size_t)c->f.unknowns * sizeof(double));
    return CPS_OK;
}

/* ---- one solve ---- */

static double between(double from, double to, double t) { return from * pow(to / from, t); }

/* 1/n during the continuation. Without stiffness at its end (P5.1) it goes down to a thousandth of
 * the fine one; without stiffness at its beginning it is 0 throughout. */
static double stiffness_between(const CpsRegularized *c, double from, double to, double t) {
    if (!(from > 0)) return to;
    return between(from, to > 0 ? to : 1e-3 * fmin(from, cps_regularized_fine(c).stiffness), t);
}

/* Minimise at the parameters of the continuation, then at the final ones: a smaller smoothing or
 * stiffness starts from the solution with the larger one. */
static void follow(CpsRegularized *c, CpsRegularizedParameters from,
                   const CpsRegularizedParameters *to, int max_iterations,
                   CpsRegularizedReport *report) {
    const double bent =
        from.stiffness > 0 ? from.stiffness / stiffness_between(c, from.stiffness, to->stiffness, 1)
                           : 1;
    const double farthest = fmax(fmax(from.delta / to->delta, bent), to->penalty / from.penalty);
    const int steps =
        farthest > CONTINUATION_FACTOR ? (int)ceil(log(farthest) / log(CONTINUATION_FACTOR)) : 1;
    CpsiSmooth smooth = cpsi_regularized_smooth(&c->f);
    CpsiDampedNewton newton = {0};
    for (int k = 1; k <= steps; ++k) {
        const double t = (double)k / steps;
        c->f.parameters = *to;
        if (k < steps) {
            c->f.parameters.delta = between(from.delta, to->delta, t);
            c->f.parameters.stiffness = stiffness_between(c, from.stiffness, to->stiffness, t);
            c->f.parameters.penalty = between(from.penalty, to->penalty, t);
        }
        newton.tolerance = cpsi_regularized_limit(&c->f);
        newton.max_iterations = max_iterations - report->iteration_count;
        cpsi_newton_minimise(&smooth, c->unknown, &newton, c->work);
        report->iteration_count += newton.iterations;
        report->evaluation_count += newton.evaluations;
    }
    report->converged = newton.converged;
    report->gradient = newton.residual;
    report->gradient_limit = newton.tolerance;
}

static CpsStatus check(const CpsRegularizedParameters *p, int max_iterations, CpsError *err) {
    if (p->cookie != PARAMETERS_COOKIE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the parameters were not made by cps_regularized_parameters_default(), "
                         "_coarse() or _fine()");
    if (p->cell_count != 0 && !(p->cell_count >= 2 && p->cell_count <= MAX_CELLS))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "cells: found %d, expected 0 (the step's elements) or 2 to %d",
                         p->cell_count, (int)MAX_CELLS);
    const struct {
        const char *name;
        double value;
    } given[] = {{"penalty", p->penalty}, {"delta", p->delta}};
    if (!(p->stiffness >= 0 && isfinite(p->stiffness)))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "stiffness: found %g, expected a finite number >= 0", p->stiffness);
    for (size_t i = 0; i < sizeof given / sizeof *given; ++i)
        if (!(given[i].value > 0 && isfinite(given[i].value)))
            return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: found %g, expected a finite number > 0",
                             given[i].name, given[i].value);
    if (max_iterations < 1)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "max_iterations: found %d, expected at least 1",
                         max_iterations);
    return CPS_OK;
}

CpsStatus cps_regularized_solve(CpsRegularized *regularized,
                                const CpsRegularizedParameters *parameters, int max_iterations,
                                CpsRegularizedReport *report, CpsError *err) {
    if (!regularized || !parameters || !report)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "regularized, parameters or report is NULL");
    CpsStatus status = check(parameters, max_iterations, err);
    const bool again = regularized->asked == parameters->cell_count;
    const CpsRegularizedParameters from =
        again ? regularized->f.parameters : cps_regularized_coarse(regularized);
    if (status == CPS_OK) status = prepare(regularized, parameters->cell_count, err);
    if (status != CPS_OK) return status;
    *report = (CpsRegularizedReport){0};
    follow(regularized, from, parameters, max_iterations, report);
    cpsi_regularized_store(&regularized->f, regularized->unknown);
    cpsi_regularized_measure(&regularized->f, report);
    for (int i = 0; i < regularized->cells.cells; ++i)
        regularized->tension[i] = cpsi_regularized_tension(&regularized->f, i);
    for (int end = 0; end < 2; ++end) report->end_tension[end] = cpsi_end_tension(regularized, end);
    return CPS_OK;
}

CpsRegularizedView cps_regularized_view(const CpsRegularized *regularized) {
    if (!regularized || regularized->asked < 0) return (CpsRegularizedView){0};
    return (CpsRegularizedView){.cell_count = regularized->cells.cells,
                                .arc_length = regularized->cells.arc,
                                .position = regularized->f.place,
                                .tension = regularized->tension,
                                .exact = regularized->cells.tension};
}
