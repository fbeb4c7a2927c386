/* SPDX-License-Identifier: BSD-3-Clause */
/* The solver's tolerance: above the default one a step on a plane is solved to a hundredth of it
 * only, in fewer iterations, within what its certificate states, and with nodes whose state is not
 * resolved; up to the default one every tolerance gives the same numbers. */
#include <string.h>

#include "capstan/evolve.h"
#include "check.h"
#include "straight_rope.h"

enum { ELEMENTS = 60, STEPS = 4 };

typedef struct Run {
    CpsLineReport report;
    double position[3 * (ELEMENTS + 1)], tension[ELEMENTS];
    int iterations, warm, resolved, unresolved; /* of all steps; nodes in the last one */
} Run;

/* A rope on the floor is pulled sideways at its end, in STEPS steps. */
static Run pull(double tolerance, bool cold) {
    CpsScene scene = cps_scene_default();
    CpsObstacle bed = cps_obstacle_default();
    const double point[6] = {0, 0, 0, 30, 0, 0};
    CpsLine line = straight_rope(point, 30, ELEMENTS, 12, 5e4);
    const CpsChange change = {.end = CPS_END_B,
                              .to = {.kind = CPS_END_KIND_HELD, .value = {29.9, 1.5, 0}}};
    CpsStage stage = cps_stage_default();
    stage.name = "pull";
    stage.step_count = STEPS;
    stage.change_count = 1;
    stage.change = &change;
    bed.name = "bed";
    bed.friction = 0.4;
    for (int end = 0; end < 2; end++) line.end[end].kind = CPS_END_KIND_AT_START;
    scene.obstacle_count = scene.line_count = scene.stage_count = 1;
    scene.obstacle = &bed;
    scene.line = &line;
    scene.stage = &stage;
    scene.solver.cold = cold;
    if (tolerance > 0) scene.solver.tolerance = tolerance;
    CpsEvolution *evolution = NULL;
    CpsError err;
    assert_int_equal(cps_evolution_create(&scene, &evolution, &err), CPS_OK);
    Run run = {0};
    while (cps_evolution_remaining_count(evolution) > 0) {
        assert_int_equal(cps_evolution_step(evolution, &err), CPS_OK);
        run.report = cps_evolution_line_report(evolution, 0);
        assert_int_equal(run.report.outcome, CPS_OUTCOME_SOLVED);
        run.iterations += run.report.iteration_count;
        run.warm += run.report.warm_count == run.report.substep_count;
    }
    const CpsLineView view = cps_evolution_line_view(evolution, 0);
    memcpy(run.position, view.position, sizeof run.position);
    memcpy(run.tension, view.tension, sizeof run.tension);
    for (int j = 1; j < ELEMENTS; j++) { /* the motion of held ends is imposed */
        run.unresolved += view.state[j] == CPS_NODE_STATE_UNRESOLVED;
        run.resolved +=
            view.state[j] == CPS_NODE_STATE_STICK || view.state[j] == CPS_NODE_STATE_SLIP;
    }
    cps_evolution_destroy(evolution);
    return run;
}

/* Bits do not depend on a tolerance up to the default one. */
static void tight(void **unused) {
    (void)unused;
    for (int cold = 0; cold < 2; cold++) {
        const Run usual = pull(0, cold);
        CHECK_INT(usual.unresolved, 0);
        assert_true(usual.report.has_slipping && usual.report.has_tension_mesh);
        CHECK_GREATER(usual.report.slipping, 0);
        for (double tolerance = 1e-8; tolerance > 1e-13; tolerance /= 10) {
            const Run run = pull(tolerance, cold);
            assert_memory_equal(run.position, usual.position, sizeof run.position);
            assert_memory_equal(run.tension, usual.tension, sizeof run.tension);
            CHECK_INT(run.iterations, usual.iterations);
        }
    }
}

/* What is looser takes fewer iterations, and errs by no more than it states: each step leaves an
 * error of the tension, root mean square, up to that of its certificate. */
static void loose(void **unused) {
    (void)unused;
    const Run usual = pull(0, true);
    int before = usual.iterations;
    for (double tolerance = 1e-7; tolerance < 2e-3; tolerance *= 10) {
        const Run run = pull(tolerance, true);
        const CpsCertificate *c = &run.report.certificate;
        double sum = 0;
        for (int e = 0; e < ELEMENTS; e++) {
            const double off = run.tension[e] - usual.tension[e];
            sum += off * off / ELEMENTS;
        }
        CHECK_LESS(c->gap, tolerance * c->scale);
        CHECK_GREATER(c->gap, 1e-13 * c->scale);
        assert_true(c->has_tension_bound);
        CHECK_LESS(sqrt(sum), STEPS * (c->tension_bound + usual.report.certificate.tension_bound));
        CHECK_LESS(run.iterations, before + 1);
        /* none is refined: that takes two linear systems or more, and the way to the gap at which
         * it begins another one */
        CHECK_LESS(run.iterations, usual.iterations - STEPS * 3 + 1);
        before = run.iterations;
        CHECK_INT(run.resolved, 0);
        CHECK_GREATER(run.unresolved, ELEMENTS / 2);
        assert_false(run.report.has_slipping);
        assert_false(run.report.has_tension_mesh);
        CHECK_NEAR(run.report.slipping, 0, 0);
    }
}

/* A warm step is solved exactly whatever the tolerance is, and its states are known. */
static void warm(void **unused) {
    (void)unused;
    const Run run = pull(1e-4, false);
    CHECK_GREATER(run.warm, 0);
    CHECK_INT(run.unresolved, 0);
    assert_true(run.report.has_slipping);
    CHECK_LESS(run.report.certificate.gap, 1e-13 * run.report.certificate.scale);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(tight), cmocka_unit_test(loose),
                                       cmocka_unit_test(warm)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
