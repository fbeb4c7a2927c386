/* SPDX-License-Identifier: BSD-3-Clause */
/* The lengths of steps in time (pace.h). */
#include "evolve/pace.h"

#include <float.h>
#include <limits.h>
#include <math.h>

/* A step is no shorter than this share of the longest of its stage: there it is kept whatever its
 * error. */
static const double LEAST = 1e-4;
/* The next step is so much shorter than its estimate allows, for that may grow; it is at most so
 * many times as long as the last one, or a try as this one, and a change by less is none: steps of
 * one length have the smaller errors. */
static const double CAUTION = 0.9, GROWTH = 2, FALL = 0.2, WORTHWHILE = 1.25;
/* After a step that is not certified. */
static const double UNCERTIFIED = 0.25;
/* What is left of a stage by rounding is no step, and what it lacks of its length does not cut it
 * off. */
static const double ROUNDING = 1e-9;

/* [s] */
static double longest_of(const CpsiEvolutionStage *stage) { return stage->duration / stage->steps; }

CpsiPortion cpsi_portion_next(const CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                              bool is_move) {
    const int part = is_move ? 0 : evolution->part, n = stage->steps;
    const double longest = longest_of(stage);
    if (!(stage->error > 0))
        return (CpsiPortion){.part = part,
                             .from = (double)part / n,
                             .to = (double)(part + 1) / n,
                             .begin = part * longest,
                             .end = (part + 1) * longest,
                             .is_last = part + 1 == n};
    const double begin = evolution->elapsed, left = stage->duration - begin,
                 before = evolution->interval;
    double length = evolution->next > 0 ? fmin(evolution->next, longest) : longest;
    if (before > 0) length = fmin(length, GROWTH * before);
    const bool is_last = length >= (1 - ROUNDING) * left;
    if (!is_last && 2 * length > left) length = 0.5 * left; /* two equal steps, not a tiny one */
    const double end = is_last ? stage->duration : begin + length;
    return (CpsiPortion){.part = part,
                         .from = begin / stage->duration,
                         .to = is_last ? 1 : end / stage->duration,
                         .begin = begin,
                         .end = end,
                         .is_last = is_last};
}

double cpsi_portion_length(const CpsiEvolutionStage *stage, const CpsiPortion *portion) {
    return stage->error > 0 ? portion->end - portion->begin : longest_of(stage);
}

double cpsi_portion_of(const CpsiEvolutionStage *stage, const CpsiPortion *portion, double whole) {
    return stage->error > 0 ? (portion->to - portion->from) * whole : whole / stage->steps;
}

void cpsi_portion_advance(CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                          const CpsiPortion *portion) {
    evolution->part++;
    if (stage->error > 0) evolution->elapsed = portion->end;
    if (!portion->is_last) return;
    evolution->part = 0;
    evolution->elapsed = 0;
    evolution->current++;
}

/* Of the stage under way. */
static double left_now(const CpsEvolution *evolution, const CpsiEvolutionStage *stage) {
    if (!(stage->error > 0)) return stage->steps - evolution->part;
    const double longest = longest_of(stage),
                 length = evolution->next > 0 ? fmin(evolution->next, longest) : longest;
    return fmax(1, ceil((stage->duration - evolution->elapsed) / length * (1 - ROUNDING)));
}

int cpsi_steps_left(const CpsEvolution *evolution) {
    double left = evolution->has_static && evolution->done == 0;
    for (int k = evolution->current; k < evolution->stage_count; k++)
        left += k == evolution->current ? left_now(evolution, &evolution->stage[k])
                                        : evolution->stage[k].steps;
    return (int)fmin(left, INT_MAX / 4);
}

int cpsi_steps_left_now(const CpsEvolution *evolution) {
    return (int)fmin(left_now(evolution, &evolution->stage[evolution->current]), INT_MAX / 4);
}

/* ---- errors ---- */

Vec3 cpsi_step_error(const CpsiFormula *formula, bool euler, Vec3 before, Vec3 now, Vec3 next) {
    const Vec3 change = vec3_sub(next, now);
    if (euler) return vec3_scale(-formula->length / 2, change);
    const Vec3 other = vec3_axpy(-formula->ratio, vec3_sub(now, before), change);
    return vec3_scale(-formula->span / 3, other);
}

/* [m] The largest in the step; quasi-static lines make none. */
static double largest_error(const CpsEvolution *evolution) {
    double largest = 0;
    for (int i = 0; i < evolution->line_count; i++)
        if (evolution->line[i].has_inertia)
            largest = fmax(largest, evolution->line[i].inertia.error);
    for (int i = 0; i < evolution->points.count; i++)
        largest = fmax(largest, evolution->points.point[i].inertia.error);
    for (int i = 0; i < evolution->bodies.count; i++)
        largest = fmax(largest, evolution->bodies.body[i].inertia.error);
    return largest;
}

bool cpsi_pace_rejects(CpsEvolution *evolution, const CpsiEvolutionStage *stage, double *shorter) {
    const double length = evolution->interval, error = largest_error(evolution);
    CpsOutcome outcome = evolution->lone;
    for (int i = 0; i < evolution->line_count; i++)
        outcome = cps_outcome_worse(outcome, evolution->line[i].report.outcome);
    evolution->pace.length = length;
    evolution->pace.error = error;
    if (cps_outcome_is_final(outcome)) return false;
    const bool certified = cps_outcome_is_certified(outcome),
               good = certified && error <= stage->error,
               euler = evolution->time_scheme == CPS_TIME_SCHEME_EULER || evolution->restarts;
    double factor = GROWTH;
    if (!certified)
        factor = UNCERTIFIED;
    else if (error > 0)
        factor = CAUTION * pow(stage->error / error, euler ? 1.0 / 2 : 1.0 / 3);
    factor = fmin(GROWTH, fmax(FALL, factor));
    const double least = LEAST * longest_of(stage);
    if (!good && length > least * (1 + ROUNDING)) {
        *shorter = fmax(least, fmin(factor, CAUTION) * length);
        return true;
    }
    if (factor >= 1 && factor < WORTHWHILE) factor = 1;
    /* a step that was cut off at the end of the stage does not shorten those of the next one */
    const double planned = evolution->next > 0 ? evolution->next : longest_of(stage);
    evolution->next = fmax(least, factor * length);
    if (good && length < (1 - ROUNDING) * planned) evolution->next = fmax(evolution->next, planned);
    return false;
}
