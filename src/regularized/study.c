/* SPDX-License-Identifier: BSD-3-Clause */
/* The study of S90 annex 4: first h, then lambda, n and delta go to their limits (theorems 9.1 and
 * 9.2, result 5.6).
 *
 * An order of convergence is computed from three successive values, |v0 - v1|/|v1 - v2| =
 * factor^rate, which does not require the limit. Tensions are compared at places that lie in cells
 * of all values of a stage: in stage h at multiples of its first h, then in the middles of the
 * step's elements. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/status.h"
#include "capstan/regularized.h"
#include "regularized/step_data.h"

enum { MAX_VALUES = 64, MAX_COARSEST = 100000, MAX_HALVINGS = 10, NEWTON_LIMIT = 2000 };

/* A copy of the tension field of a view. */
typedef struct Kept {
    CpsiArena arena;
    CpsRegularizedView view;
} Kept;

struct CpsStudy {
    CpsStudyRow *row;
    int rows, capacity;
    Kept end[CPS_STUDY_STAGE_COUNT];
};

/* The last values of a stage, newest first. */
typedef struct Trail {
    int count;
    double energy[3];
    int samples;
    double *place;      /* (samples) [m] */
    double *tension[3]; /* (samples) [N] */
    double change;      /* root mean square difference of the newest two tensions */
    double change_before;
} Trail;

const char *cps_study_stage_name(CpsStudyStage stage) {
    static const char *const KEY[CPS_STUDY_STAGE_COUNT] = {"h", "lambda", "n", "delta"};
    return stage >= 0 && stage < CPS_STUDY_STAGE_COUNT ? KEY[stage] : "unknown";
}

/* The number of divisions by *factor, at most 10, that reduce by `ratio`; 0 where ratio is 1 or
 * less. */
static int divisions(double ratio, double *factor) {
    const double decades = log10(ratio);
    const int count = (int)ceil(decades - 1e-9);
    *factor = 10;
    if (!(decades > 1e-9)) return 0;
    if (fabs(decades - count) > 1e-9) *factor = pow(ratio, 1.0 / count);
    return count;
}

enum { OPTIONS_COOKIE = 0x57d01a12 };

CpsStudyOptions cps_study_options_to(const CpsRegularized *regularized,
                                     const CpsRegularizedParameters *to) {
    if (!regularized || !to) return (CpsStudyOptions){0};
    CpsStudyOptions options = {.cookie = OPTIONS_COOKIE,
                               .from = cps_regularized_coarse(regularized),
                               .factor = {2, 10, 10, 10},
                               .max_iterations = NEWTON_LIMIT};
    CpsRegularizedParameters *from = &options.from;
    const int last =
        to->cell_count > 0 ? to->cell_count : 4 * cps_regularized_step(regularized).element_count;
    int cells = from->cell_count;
    for (options.value_count[CPS_STUDY_STAGE_H] = 1;
         cells < last && options.value_count[CPS_STUDY_STAGE_H] < MAX_HALVINGS; cells *= 2)
        ++options.value_count[CPS_STUDY_STAGE_H];
    if (to->cell_count >
        0) { /* the first h, such that the last one is that asked for, or smaller by a few cells */
        const int halvings = 1 << (options.value_count[CPS_STUDY_STAGE_H] - 1);
        from->cell_count = (last + halvings - 1) / halvings;
        if (from->cell_count < 2) from->cell_count = 2;
    }
    /* lambda starts with the first value, n and delta with the one after it */
    options.value_count[CPS_STUDY_STAGE_LAMBDA] =
        1 + divisions(to->penalty / from->penalty, &options.factor[CPS_STUDY_STAGE_LAMBDA]);
    options.value_count[CPS_STUDY_STAGE_N] =
        to->stiffness > 0
            ? divisions(from->stiffness / to->stiffness, &options.factor[CPS_STUDY_STAGE_N])
            : 1;
    options.value_count[CPS_STUDY_STAGE_DELTA] =
        divisions(from->delta / to->delta, &options.factor[CPS_STUDY_STAGE_DELTA]);
    if (options.value_count[CPS_STUDY_STAGE_LAMBDA] == 1) from->penalty = to->penalty;
    if (!(to->stiffness > 0)) {
        from->stiffness = 0;
    } else if (options.value_count[CPS_STUDY_STAGE_N] == 0) {
        from->stiffness = 10 * to->stiffness;
        options.value_count[CPS_STUDY_STAGE_N] = 1;
    }
    if (options.value_count[CPS_STUDY_STAGE_DELTA] == 0) {
        from->delta = 10 * to->delta;
        options.value_count[CPS_STUDY_STAGE_DELTA] = 1;
    }
    return options;
}

CpsStudyOptions cps_study_options_default(const CpsRegularized *regularized) {
    if (!regularized) return (CpsStudyOptions){0};
    const CpsRegularizedParameters fine = cps_regularized_fine(regularized);
    return cps_study_options_to(regularized, &fine);
}

/* ---- rates ---- */

/* false where the changes have different signs, since there is no order of convergence then */
static bool rate_of(double change_before, double change, double factor, double *rate) {
    const double found = log(change_before / change) / log(factor);
    *rate = isfinite(found) ? found : 0;
    return isfinite(found);
}

static double rms_between(int count, const double *a, const double *b) {
    double sum = 0;
    for (int i = 0; i < count; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sqrt(sum / count);
}

/* Begin a stage. In stage h there is no value to compare with yet, since the cells differ; in the
 * other stages the final value of the preceding stage is the first one. */
static void begin_stage(Trail *trail, CpsStudyStage stage, const CpsRegularizedStep *step,
                        int coarsest) {
    if (stage >= CPS_STUDY_STAGE_N) {
        trail->count = 1;
        return;
    }
    trail->count = 0;
    trail->samples = stage == CPS_STUDY_STAGE_H ? coarsest - 1 : step->element_count;
    for (int i = 0; i < trail->samples; ++i)
        trail->place[i] = stage == CPS_STUDY_STAGE_H
                              ? (i + 1) * step->length / coarsest
                              : (step->arc_length[i] + step->arc_length[i + 1]) / 2;
}

static void sample(const CpsRegularized *regularized, const Trail *trail, double *tension) {
    const CpsRegularizedView view = cps_regularized_view(regularized);
    for (int i = 0; i < trail->samples; ++i)
        tension[i] =
            cpsi_between_middles(view.cell_count, view.arc_length, view.tension, trail->place[i]);
}

/* add the newest solution and compute the rates of its row */
static void follow(Trail *trail, const CpsRegularized *regularized, double factor,
                   CpsStudyRow *row) {
    double *oldest = trail->tension[2];
    trail->tension[2] = trail->tension[1];
    trail->tension[1] = trail->tension[0];
    trail->tension[0] = oldest;
    trail->energy[2] = trail->energy[1];
    trail->energy[1] = trail->energy[0];
    trail->energy[0] = row->report.total;
    sample(regularized, trail, trail->tension[0]);
    trail->change_before = trail->change;
    trail->change = rms_between(trail->samples, trail->tension[0], trail->tension[1]);
    ++trail->count;
    if (trail->count < 3) return;
    row->has_rate_energy = rate_of(trail->energy[2] - trail->energy[1],
                                   trail->energy[1] - trail->energy[0], factor, &row->rate_energy);
    row->has_rate_tension =
        rate_of(trail->change_before, trail->change, factor, &row->rate_tension);
}

/* ---- the run ---- */

static double seconds(void) {
    struct timespec now = {0}; /* no time passes where there is no such clock */
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void fill_view(CpsiArena *arena, int cells, CpsRegularizedView *view) {
    view->cell_count = cells;
    CPSI_PLACE(arena, view->arc_length, cells + 1);
    CPSI_PLACE(arena, view->position, 3 * ((size_t)cells + 1));
    CPSI_PLACE(arena, view->tension, cells);
    CPSI_PLACE(arena, view->exact, cells);
}

static CpsStatus keep(Kept *kept, const CpsRegularizedView *view, CpsError *err) {
    CpsRegularizedView copy;
    CpsiArena arena = {0};
    fill_view(&arena, view->cell_count, &copy);
    if (!cpsi_arena_allocate(&arena)) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    fill_view(&arena, view->cell_count, &copy);
    const size_t cells = (size_t)view->cell_count * sizeof(double);
    memcpy((double *)copy.arc_length, view->arc_length, cells + sizeof(double));
    memcpy((double *)copy.position, view->position, 3 * (cells + sizeof(double)));
    memcpy((double *)copy.tension, view->tension, cells);
    memcpy((double *)copy.exact, view->exact, cells);
    *kept = (Kept){arena, copy};
    return CPS_OK;
}

/* value k of a stage: its own parameter is reduced, the others keep their final values */
static void advance(CpsStudyStage stage, const CpsStudyOptions *options, int k,
                    CpsRegularizedParameters *p) {
    const double factor = options->factor[stage];
    switch (stage) {
    case CPS_STUDY_STAGE_H:
        if (k > 0) p->cell_count *= 2;
        break;
    case CPS_STUDY_STAGE_LAMBDA:
        if (k > 0)
            p->penalty *= factor;
        else
            p->cell_count = 0; /* the step's own elements from this stage on */
        break;
    case CPS_STUDY_STAGE_N: p->stiffness /= factor; break;
    case CPS_STUDY_STAGE_DELTA: p->delta /= factor; break;
    case CPS_STUDY_STAGE_COUNT: break;
    }
}

static CpsStatus run_stages(CpsRegularized *regularized, const CpsStudyOptions *options,
                            CpsStudyProgress *progress, void *user, Trail *trail, CpsStudy *study,
                            CpsError *err) {
    const CpsRegularizedStep step = cps_regularized_step(regularized);
    CpsRegularizedParameters p = options->from;
    for (CpsStudyStage stage = CPS_STUDY_STAGE_H; stage < CPS_STUDY_STAGE_COUNT; ++stage) {
        begin_stage(trail, stage, &step, options->from.cell_count);
        for (int k = 0; k < options->value_count[stage]; ++k) {
            advance(stage, options, k, &p);
            CpsStudyRow *row = &study->row[study->rows];
            *row = (CpsStudyRow){.stage = stage, .parameters = p};
            const double begun = seconds();
            const CpsStatus status =
                cps_regularized_solve(regularized, &p, options->max_iterations, &row->report, err);
            if (status != CPS_OK) return status;
            row->wall = seconds() - begun;
            follow(trail, regularized, options->factor[stage], row);
            ++study->rows;
            if (progress && !progress(user, row, study->rows, study->capacity)) return CPS_OK;
        }
        const CpsRegularizedView view = cps_regularized_view(regularized);
        const CpsStatus status = keep(&study->end[stage], &view, err);
        if (status != CPS_OK) return status;
    }
    return CPS_OK;
}

static CpsStatus check(const CpsStudyOptions *options, CpsError *err) {
    if (options->cookie != OPTIONS_COOKIE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the options were not made by cps_study_options_default()");
    for (int s = 0; s < CPS_STUDY_STAGE_COUNT; ++s) {
        const char *key = cps_study_stage_name((CpsStudyStage)s);
        if (!(options->value_count[s] >= 1 && options->value_count[s] <= MAX_VALUES))
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "values of stage %s: found %d, expected 1 to %d", key,
                             options->value_count[s], (int)MAX_VALUES);
        if (!(options->factor[s] > 1 && isfinite(options->factor[s])))
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "factor of stage %s: found %g, expected a number > 1", key,
                             options->factor[s]);
    }
    if (!(options->from.cell_count >= 2 && options->from.cell_count <= MAX_COARSEST))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "cells to begin with: found %d, expected 2 to %d",
                         options->from.cell_count, (int)MAX_COARSEST);
    if (options->factor[CPS_STUDY_STAGE_H] != 2)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "factor of stage h: found %g, expected 2",
                         options->factor[CPS_STUDY_STAGE_H]);
    return CPS_OK;
}

CpsStatus cps_study_run(CpsRegularized *regularized, const CpsStudyOptions *options,
                        CpsStudyProgress *progress, void *user, CpsStudy **out, CpsError *err) {
    if (!regularized || !options || !out)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "regularized, options or out is NULL");
    *out = NULL;
    CpsStatus status = check(options, err);
    if (status != CPS_OK) return status;
    CpsStudy *study = calloc(1, sizeof *study);
    const int elements = cps_regularized_step(regularized).element_count;
    const size_t samples =
        (size_t)(elements > options->from.cell_count ? elements : options->from.cell_count);
    double *trails = calloc(4 * samples, sizeof *trails);
    if (study) {
        for (int s = 0; s < CPS_STUDY_STAGE_COUNT; ++s) study->capacity += options->value_count[s];
        study->row = calloc((size_t)study->capacity, sizeof *study->row);
    }
    if (!study || !trails || !study->row) {
        status = cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    } else {
        Trail trail = {.place = trails,
                       .tension = {trails + samples, trails + 2 * samples, trails + 3 * samples}};
        status = run_stages(regularized, options, progress, user, &trail, study, err);
    }
    free(trails);
    if (status == CPS_OK)
        *out = study;
    else
        cps_study_destroy(study);
    return status;
}

void cps_study_destroy(CpsStudy *study) {
    if (!study) return;
    for (int s = 0; s < CPS_STUDY_STAGE_COUNT; ++s) cpsi_arena_free(&study->end[s].arena);
    free(study->row);
    free(study);
}

int cps_study_row_count(const CpsStudy *study) { return study ? study->rows : 0; }

CpsStudyRow cps_study_row(const CpsStudy *study, int row) {
    return study && row >= 0 && row < study->rows ? study->row[row] : (CpsStudyRow){0};
}

CpsRegularizedView cps_study_stage_end(const CpsStudy *study, CpsStudyStage stage) {
    return study && stage >= 0 && stage < CPS_STUDY_STAGE_COUNT ? study->end[stage].view
                                                                : (CpsRegularizedView){0};
}
