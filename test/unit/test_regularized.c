/* SPDX-License-Identifier: BSD-3-Clause */
/* The 1990 method piece by piece: band factor, Newton, the functional of section 5 and P10.1
 * compared with differences, the external approximation, and what is refused. A small artificial
 * step: six elements of different lengths, a tilted obstacle, no node at rest. */
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/regularized.h"
#include "check.h"
#include "linalg/band.h"
#include "regularized/first_order.h"
#include "regularized/newton.h"
#include "regularized/regularized.h"

enum { ELEMENTS = 6, NODES = ELEMENTS + 1, COORDINATES = 3 * NODES };

typedef struct Step {
    double arc[NODES], width[ELEMENTS], reference[COORDINATES], position[COORDINATES],
        load[COORDINATES];
    double normal[COORDINATES], gap[NODES], bound[NODES], friction[COORDINATES], reaction[NODES],
        force[3 * ELEMENTS];
    double tension[ELEMENTS], factor[NODES];
    unsigned char state[NODES];
    CpsLineView view;
} Step;

/* numbers without a pattern in -1..1, the same on every machine */
static double noise(unsigned *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) / 8388608.0 - 1;
}

static void make_step(Step *s) {
    *s = (Step){0};
    unsigned seed = 1990;
    for (int i = 0; i < ELEMENTS; i++) {
        s->width[i] = 0.4 + 0.05 * i;
        s->arc[i + 1] = s->arc[i] + s->width[i];
        s->tension[i] = 1 + 0.1 * i;
    }
    for (int j = 0; j < NODES; j++) {
        double *x = &s->reference[3 * j], *y = &s->position[3 * j], *b = &s->load[3 * j];
        for (int k = 0; k < 3; k++) {
            x[k] = (k == 0 ? s->arc[j] * 1.02 : 0) + 0.02 * noise(&seed) * (j > 0);
            y[k] = x[k] + 0.3 * noise(&seed) * (j > 0);
            b[k] = noise(&seed);
        }
        s->normal[3 * j] = 0.6;
        s->normal[3 * j + 2] = 0.8;
        s->gap[j] = j % 3 == 2 ? INFINITY : 0.01 * j;
        s->bound[j] = j % 3 == 1 ? 0.7 : 0.2;
        s->factor[j] = 1;
    }
    s->view = (CpsLineView){.name = "line",
                            .element_count = ELEMENTS,
                            .arc_length = s->arc,
                            .element_length = s->width,
                            .one_plane = true,
                            .uniform = true,
                            .compliance = 0.05,
                            .end = {{CPS_END_KIND_HELD, {0}}, {CPS_END_KIND_FREE, {0.1, 0.2, 0.3}}},
                            .reference = s->reference,
                            .position = s->position,
                            .load = s->load,
                            .normal = s->normal,
                            .gap = s->gap,
                            .friction_bound = s->bound,
                            .friction_factor = s->factor,
                            .friction_force = s->friction,
                            .reaction = s->reaction,
                            .segment_force = s->force,
                            .tension = s->tension,
                            .state = s->state};
}

/* ---- band ---- */

/* A = M M^T + I from a band M has the band of M; L L^T = A entry by entry, and A x = b is
 * solved. */
static void band_factor_and_solve(void **state) {
    (void)state;
    enum { N = 11, BAND = 4 };
    double m[N][N] = {{0}}, a[N][N] = {{0}}, rows[N * (BAND + 1)] = {0}, x[N], b[N] = {0};
    unsigned seed = 7;
    for (int r = 0; r < N; r++)
        for (int c = r - BAND < 0 ? 0 : r - BAND; c <= r; c++) m[r][c] = noise(&seed);
    for (int r = 0; r < N; r++)
        for (int c = 0; c < N; c++) {
            for (int k = 0; k < N; k++) a[r][c] += m[r][k] * m[c][k];
            if (r == c) a[r][c] += 1;
            if (c <= r && r - c <= BAND) *cpsi_band_at(rows, BAND, r, c) = a[r][c];
        }
    for (int r = 0; r < N; r++) x[r] = noise(&seed);
    for (int r = 0; r < N; r++)
        for (int c = 0; c < N; c++) b[r] += a[r][c] * x[c];
    assert_true(cpsi_band_factor(N, BAND, rows));
    cpsi_band_solve(N, BAND, rows, b);
    // condition of a matrix of this size and entries: far below 1e4 times rounding
    for (int r = 0; r < N; r++) CHECK_NEAR(b[r], x[r], 1e-12);
}

static void band_refuses_indefinite(void **state) {
    (void)state;
    double a[] = {0, 1, 2, 1}; /* [1 2; 2 1] */
    assert_false(cpsi_band_factor(2, 1, a));
    double nan[] = {0, NAN};
    assert_false(cpsi_band_factor(1, 1, nan));
}

/* ---- Newton ---- */

/* sqrt(delta^2 + x^2) pulls hard to 0 and is nearly flat away from it: whole Newton steps diverge
 * from |x| > delta. */
typedef struct Sharp {
    double delta, pull;
} Sharp;

static void sharp_gradient(void *user, const double *x, double *g) {
    const Sharp *s = user;
    g[0] = x[0] / sqrt(s->delta * s->delta + x[0] * x[0]) + s->pull;
}

static void sharp_hessian(void *user, const double *x, double damping, double *a) {
    const Sharp *s = user;
    double r = sqrt(s->delta * s->delta + x[0] * x[0]);
    a[0] = s->delta * s->delta / (r * r * r) + damping;
}

static void newton_where_whole_steps_diverge(void **state) {
    (void)state;
    Sharp sharp = {1e-6, -0.5};
    CpsiSmooth f = {1, 0, &sharp, sharp_gradient, sharp_hessian, 1};
    CpsiDampedNewton newton = {.tolerance = 1e-12, .max_iterations = 200};
    double x = 10, work[5];
    cpsi_newton_minimise(&f, &x, &newton, work);
    assert_true(newton.converged);
    // x/r = 1/2: x = delta/sqrt(3); the slope 0.65/delta there turns 1e-12 into 2e-18
    CHECK_NEAR(x, 1e-6 / sqrt(3), 1e-17);
    CHECK_LESS(newton.iterations, 60);
}

/* A slope that never vanishes: no minimum, said so, and x stays finite. */
static void newton_without_minimum(void **state) {
    (void)state;
    Sharp sharp = {1, -1.5};
    CpsiSmooth f = {1, 0, &sharp, sharp_gradient, sharp_hessian, 1};
    CpsiDampedNewton newton = {.tolerance = 1e-12, .max_iterations = 50};
    double x = 0, work[5];
    cpsi_newton_minimise(&f, &x, &newton, work);
    assert_false(newton.converged);
    CHECK_GREATER(newton.residual, 0.49);
    CHECK_FINITE(x);
}

/* ---- the functional of section 5 ---- */

typedef struct Functional {
    Step step;
    CpsiStep copy;
    CpsiRegularized f;
    double place[COORDINATES], gradient[COORDINATES], x[COORDINATES];
} Functional;

static void open_functional(Functional *t, bool held) {
    make_step(&t->step);
    if (held) t->step.view.end[CPS_END_B].kind = CPS_END_KIND_HELD;
    CpsError err = {0};
    assert_int_equal(cpsi_step_copy(&t->step.view, &t->copy, &err), CPS_OK);
    t->f = (CpsiRegularized){.step = &t->copy,
                             .cells = &t->copy.own,
                             .parameters = {.penalty = 30, .stiffness = 0.2, .delta = 0.05},
                             .unknowns = 3 * (ELEMENTS - held),
                             .place = t->place,
                             .gradient = t->gradient};
    memcpy(t->x, t->step.position + 3, (size_t)t->f.unknowns * sizeof(double));
}

static double total(Functional *t, const double *x) {
    CpsRegularizedReport report = {0};
    cpsi_regularized_store(&t->f, x);
    cpsi_regularized_measure(&t->f, &report);
    return report.total;
}

/* The gradient is that of the energy that the report adds up, the Hessian that of the gradient:
 * central differences. */
static void functional_against_differences(void **state) {
    (void)state;
    for (int held = 0; held < 2; held++) {
        Functional t;
        open_functional(&t, held);
        CpsiSmooth smooth = cpsi_regularized_smooth(&t.f);
        int n = smooth.unknowns;
        double g[COORDINATES], before[COORDINATES], after[COORDINATES],
            a[COORDINATES * (CPSI_REGULARIZED_BAND + 1)] = {0};
        smooth.gradient(smooth.user, t.x, g);
        smooth.hessian(smooth.user, t.x, 0, a);
        const double step = 1e-6;
        for (int i = 0; i < n; i++) {
            double x = t.x[i];
            t.x[i] = x + step;
            double high = total(&t, t.x);
            smooth.gradient(smooth.user, t.x, after);
            t.x[i] = x - step;
            double low = total(&t, t.x);
            smooth.gradient(smooth.user, t.x, before);
            t.x[i] = x;
            // third derivatives of some 1e4 times step^2, and rounding of energies of 10 over step
            CHECK_NEAR((high - low) / (2 * step), g[i], 1e-7);
            for (int k = i; k < n && k - i <= CPSI_REGULARIZED_BAND; k++)
                CHECK_NEAR((after[k] - before[k]) / (2 * step),
                           *cpsi_band_at(a, CPSI_REGULARIZED_BAND, k, i), 1e-5);
            // nothing is coupled beyond the band
            for (int k = i + CPSI_REGULARIZED_BAND + 1; k < n; k++)
                CHECK_NEAR(after[k], before[k], 1e-12);
        }
        cpsi_arena_free(&t.copy.arena);
    }
}

/* ---- P10.1 ---- */

static void first_order_against_differences(void **state) {
    (void)state;
    Step step;
    CpsiStep copy;
    make_step(&step);
    CpsError err = {0};
    assert_int_equal(cpsi_step_copy(&step.view, &copy, &err), CPS_OK);
    double tangent[3 * ELEMENTS], stretch[ELEMENTS], strain[ELEMENTS], u[COORDINATES] = {0},
                                                                       anchor[COORDINATES] = {0};
    double own_friction[COORDINATES], push[NODES], gradient[COORDINATES], x[COORDINATES];
    unsigned seed = 5;
    for (int i = 0; i < ELEMENTS; i++) {
        double square = 0;
        for (int k = 0; k < 3; k++) {
            tangent[3 * i + k] =
                (step.reference[3 * i + 3 + k] - step.reference[3 * i + k]) / step.width[i];
            square += tangent[3 * i + k] * tangent[3 * i + k];
        }
        stretch[i] = sqrt(square);
        for (int k = 0; k < 3; k++) tangent[3 * i + k] /= stretch[i];
        strain[i] = fmax(0, stretch[i] - 1);
    }
    for (int k = 0; k < COORDINATES; k++) {
        own_friction[k] = 0.2 * noise(&seed);
        x[k] = 0.3 * noise(&seed);
    }
    for (int j = 0; j < NODES; j++) {
        push[j] = fabs(noise(&seed));
        // friction is tangential
        double across = 0.6 * own_friction[3 * j] + 0.8 * own_friction[3 * j + 2];
        own_friction[3 * j] -= 0.6 * across;
        own_friction[3 * j + 2] -= 0.8 * across;
    }
    CpsiFirstOrder f = {&copy,  3 * ELEMENTS, tangent, stretch,  strain, copy.own.gap, u,
                        anchor, own_friction, push,    gradient, 4,      0.3};
    CpsiSmooth smooth = cpsi_first_order_smooth(&f);
    double g[COORDINATES], before[COORDINATES], after[COORDINATES],
        a[COORDINATES * (CPSI_FIRST_ORDER_BAND + 1)] = {0};
    smooth.gradient(smooth.user, x, g);
    smooth.hessian(smooth.user, x, 0, a);
    const double h = 1e-6;
    for (int i = 0; i < smooth.unknowns; i++) {
        double at = x[i];
        x[i] = at + h;
        smooth.gradient(smooth.user, x, after);
        x[i] = at - h;
        smooth.gradient(smooth.user, x, before);
        x[i] = at;
        // piecewise smooth, third derivatives of order 10
        for (int k = i; k < smooth.unknowns; k++) {
            double want =
                k - i <= CPSI_FIRST_ORDER_BAND ? *cpsi_band_at(a, CPSI_FIRST_ORDER_BAND, k, i) : 0;
            CHECK_NEAR((after[k] - before[k]) / (2 * h), want, 1e-6);
        }
    }
    cpsi_arena_free(&copy.arena);
}

/* (84) is the first order of T(x_R + u): the difference shrinks with the square of u. */
static void first_order_tension_is_the_derivative(void **state) {
    (void)state;
    Step step;
    CpsiStep copy;
    make_step(&step);
    CpsError err = {0};
    assert_int_equal(cpsi_step_copy(&step.view, &copy, &err), CPS_OK);
    double r[3], square = 0, error[2];
    for (int k = 0; k < 3; k++) {
        r[k] = (step.reference[3 + k] - step.reference[k]) / step.width[0] * 1.1;
        square += r[k] * r[k];
    }
    double s = sqrt(square), t[3] = {r[0] / s, r[1] / s, r[2] / s}, e = s - 1, u[6] = {0};
    CpsiFirstOrder f = {.step = &copy, .tangent = t, .stretch = &s, .strain = &e, .u = u};
    assert_true(e > 0.01);
    for (int level = 0; level < 2; level++) {
        double size = level ? 1e-4 : 1e-3, d[3] = {0.3 * size, -0.5 * size, 0.7 * size}, got[3],
               now[3], length = 0;
        for (int k = 0; k < 3; k++) {
            u[3 + k] = d[k] * step.width[0];
            now[k] = r[k] + d[k];
            length += now[k] * now[k];
        }
        length = sqrt(length);
        cpsi_first_order_tension(&f, 0, got);
        error[level] = 0;
        for (int k = 0; k < 3; k++)
            error[level] =
                fmax(error[level], fabs(got[k] - (length - 1) / copy.compliance * now[k] / length));
    }
    // a tenth of the displacement leaves a hundredth: the order is 2, its observed value off by the
    // next term
    CHECK_BETWEEN(log10(error[0] / error[1]), 1.98, 2.02);
    cpsi_arena_free(&copy.arena);
}

/* ---- external approximation ---- */

/* Loads and lengths are shared out without loss, and the first cell begins at h/2. */
static void external_cells(void **state) {
    (void)state;
    Step step;
    CpsiStep copy;
    make_step(&step);
    // a constant weight, and the end force on the last node; a constant bound per length
    double half[NODES] = {0};
    for (int i = 0; i < ELEMENTS; i++) {
        half[i] += step.width[i] / 2;
        half[i + 1] += step.width[i] / 2;
    }
    for (int j = 0; j < NODES; j++) {
        for (int k = 0; k < 3; k++)
            step.load[3 * j + k] =
                (k == 2 ? -2 * half[j] : 0) + (j == ELEMENTS ? step.view.end[1].value[k] : 0);
        step.bound[j] = j > 0 ? 0.5 * half[j] : 0;
    }
    CpsError err = {0};
    assert_int_equal(cpsi_step_copy(&step.view, &copy, &err), CPS_OK);
    CpsiArena arena = {0};
    CpsiCells cells;
    enum { CELLS = 17 };
    cpsi_cells_place(&cells, &copy, CELLS, &arena);
    assert_true(cpsi_arena_allocate(&arena));
    cpsi_cells_place(&cells, &copy, CELLS, &arena);
    double length = step.arc[ELEMENTS], h = length / CELLS, width = 0, share = 0, load[3] = {0},
           bound = 0;
    for (int i = 0; i < CELLS; i++) width += cells.width[i];
    for (int j = 0; j <= CELLS; j++) {
        share += cells.share[j];
        bound += cells.bound[j];
        for (int k = 0; k < 3; k++) load[k] += cells.load[3 * j + k];
    }
    // sums of some ten numbers of order 1
    CHECK_NEAR(cells.arc[0], h / 2, 1e-15);
    CHECK_NEAR(cells.arc[CELLS], length, 1e-15);
    CHECK_NEAR(width, length - h / 2, 1e-14);
    CHECK_NEAR(share, length, 1e-14);
    CHECK_NEAR(bound, 0.5 * length, 1e-14);
    CHECK_NEAR(load[0], 0.1, 1e-14);
    CHECK_NEAR(load[1], 0.2, 1e-14);
    CHECK_NEAR(load[2], 0.3 - 2 * length, 1e-14);
    for (int k = 0; k < 3; k++) CHECK_NEAR(cells.position[k], step.position[k], 0);
    cpsi_arena_free(&arena);
    cpsi_arena_free(&copy.arena);
}

/* ---- what is refused ---- */

static void refusals(void **state) {
    (void)state;
    Step step;
    make_step(&step);
    CpsError err = {0};
    CpsRegularized *regularized = (CpsRegularized *)&step;
    step.view.end[CPS_END_A].kind = CPS_END_KIND_FREE;
    assert_int_equal(cps_regularized_create(&step.view, &regularized, &err), CPS_ERR_ARGUMENT);
    assert_null(regularized);
    assert_non_null(strstr(err.message, "hold end A"));
    make_step(&step);
    step.view.compliance = 0;
    assert_int_equal(cps_regularized_create(&step.view, &regularized, &err), CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "inextensible"));
    make_step(&step);
    step.view.one_plane = false;
    assert_int_equal(cps_regularized_create(&step.view, &regularized, &err), CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "tangent plane"));
    make_step(&step);
    memset(step.load, 0, sizeof step.load);
    memset(step.tension, 0, sizeof step.tension);
    assert_int_equal(cps_regularized_create(&step.view, &regularized, &err), CPS_ERR_ARGUMENT);
    assert_int_equal(cps_regularized_create(NULL, &regularized, NULL), CPS_ERR_ARGUMENT);

    make_step(&step);
    assert_int_equal(cps_regularized_create(&step.view, &regularized, &err), CPS_OK);
    CpsRegularizedReport report;
    const CpsRegularizedParameters good = cps_regularized_coarse(regularized);
    CpsRegularizedParameters bad[] = {good, good, good, good, good};
    bad[0].cell_count = 1;
    bad[1].penalty = 0;
    bad[2].stiffness = NAN;
    bad[3].delta = -1;
    bad[4].delta = INFINITY;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_int_equal(cps_regularized_solve(regularized, &bad[i], 100, &report, &err),
                         CPS_ERR_ARGUMENT);
    assert_int_equal(cps_regularized_solve(regularized, &good, 0, &report, &err), CPS_ERR_ARGUMENT);
    assert_int_equal(cps_regularized_view(regularized).cell_count, 0);

    CpsRegularized *next = regularized;
    assert_int_equal(cps_regularized_next(&step.view, 0.5, regularized, &next, &err),
                     CPS_ERR_ARGUMENT); /* nothing solved yet */
    assert_null(next);
    assert_int_equal(cps_regularized_next(&step.view, NAN, regularized, &next, &err),
                     CPS_ERR_ARGUMENT);

    CpsStudy *study = NULL;
    CpsRegularizedParameters bare = good;
    bare.cookie = 0;
    CpsRegularizedReport none_of_it;
    assert_int_equal(cps_regularized_solve(regularized, &bare, 10, &none_of_it, &err),
                     CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "_default()"));
    CpsStudyOptions options = cps_study_options_default(regularized);
    options.cookie = 0;
    assert_int_equal(cps_study_run(regularized, &options, NULL, NULL, &study, &err),
                     CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "_default()"));
    options = cps_study_options_default(regularized);
    options.factor[CPS_STUDY_STAGE_N] = 1;
    assert_int_equal(cps_study_run(regularized, &options, NULL, NULL, &study, &err),
                     CPS_ERR_ARGUMENT);
    assert_null(study);
    assert_non_null(strstr(err.message, "stage n"));
    options = cps_study_options_default(regularized);
    options.value_count[CPS_STUDY_STAGE_H] = options.value_count[CPS_STUDY_STAGE_LAMBDA] =
        options.value_count[CPS_STUDY_STAGE_N] = options.value_count[CPS_STUDY_STAGE_DELTA] = 1;
    assert_int_equal(cps_study_run(regularized, &options, NULL, NULL, &study, &err), CPS_OK);
    assert_true(cps_study_row(study, cps_study_row_count(study) - 1).parameters.penalty > 0);
    const CpsStudyRow last = cps_study_row(study, cps_study_row_count(study) - 1);
    assert_true(last.report.end_tension[CPS_END_B] >= 0);
    for (int k = 0; k < 4; ++k) {
        const int absent = (int[]){-1, 64, INT_MAX, INT_MIN}[k];
        assert_true(cps_study_row(study, absent).parameters.penalty == 0);
        assert_int_equal(cps_study_stage_end(study, (CpsStudyStage)absent).cell_count, 0);
        CpsFirstOrder *none = NULL;
        assert_int_equal(cps_first_order_solve(regularized, (CpsFirstOrderContact)absent, &none,
                                               &err),
                         CPS_ERR_ARGUMENT);
        assert_null(none);
    }
    cps_study_destroy(study);
    cps_study_destroy(NULL);
    cps_first_order_destroy(NULL);
    cps_regularized_destroy(NULL);
    cps_regularized_destroy(regularized);
}

/* An iteration limit is reported, not hidden; a second call goes on from there. */
static void limit_is_reported(void **state) {
    (void)state;
    Step step;
    make_step(&step);
    CpsError err = {0};
    CpsRegularized *regularized;
    CpsRegularizedReport report;
    assert_int_equal(cps_regularized_create(&step.view, &regularized, &err), CPS_OK);
    CpsRegularizedParameters p = cps_regularized_coarse(regularized);
    p.cell_count = 0;
    p.delta *= 1e-4;
    assert_int_equal(cps_regularized_solve(regularized, &p, 1, &report, &err), CPS_OK);
    assert_false(report.converged);
    CHECK_GREATER(report.gradient, report.gradient_limit);
    CHECK_FINITE(report.total);
    assert_int_equal(cps_regularized_solve(regularized, &p, 1000, &report, &err), CPS_OK);
    assert_true(report.converged);
    cps_regularized_destroy(regularized);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(band_factor_and_solve),
        cmocka_unit_test(band_refuses_indefinite),
        cmocka_unit_test(newton_where_whole_steps_diverge),
        cmocka_unit_test(newton_without_minimum),
        cmocka_unit_test(functional_against_differences),
        cmocka_unit_test(first_order_against_differences),
        cmocka_unit_test(first_order_tension_is_the_derivative),
        cmocka_unit_test(external_cells),
        cmocka_unit_test(refusals),
        cmocka_unit_test(limit_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
