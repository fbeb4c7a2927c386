/* SPDX-License-Identifier: BSD-3-Clause */
/* Long motions in time: a mooring line that is held aside by friction stays, statics is the limit
 * of ever slower histories, and the tip of a chain that is let go falls faster than freely. Each
 * figure is printed. */
#include <stdio.h>
#include <stdlib.h>

#include "time_rig.h"

static const double PI = 3.14159265358979323846;

/* ---- a mooring line of the OC3 spar (docs/validation.md) ---- */

static void mooring(TimeRig *rig, int elements) {
    time_begin(rig, 902.2, elements, 77.7066, 384.243e6);
    rig->line.weight = 698.094;
    time_plane(rig, -320, 1);
    rig->line.start = (CpsStart){.kind = CPS_START_STATIC};
    rig->line.end[CPS_END_A] = (CpsEnd){.kind = CPS_END_KIND_HELD, .value = {853.87, 0, -320}};
    rig->line.end[CPS_END_B] = (CpsEnd){.kind = CPS_END_KIND_HELD, .value = {5.2, 0, -70}};
}

enum { MEAN = 600 };

/* 20 m aside within 100 s, then an hour in which nothing moves. */
static void a_line_held_aside_stays(void **state) {
    (void)state;
    TimeRig rig;
    mooring(&rig, 50);
    time_stage(&rig, 100, 200);
    time_change(&rig, CPS_END_KIND_HELD, 5.2, 20, -70);
    time_stage(&rig, 3600, 3600);
    TimeRun run = time_open(&rig);
    time_steps(&run, 1 + 200);
    time_steps(&run, 400);
    /* the node at one eighth of the length, on the bed */
    const double early = run.view.position[3 * 6 + 1];
    double first = 0, last = 0;
    for (int k = 0; k < MEAN; k++) {
        time_step(&run);
        first += run.report.end[CPS_END_B].force[1] / MEAN;
    }
    time_steps(&run, 3200 - 2 * MEAN);
    for (int k = 0; k < MEAN; k++) {
        time_step(&run);
        last += run.report.end[CPS_END_B].force[1] / MEAN;
    }
    const double late = run.view.position[3 * 6 + 1];
    time_report("held aside", "mean force, 500 s to 1100 s [N]", 20e3, first);
    time_report("held aside", "mean force, last 600 s of the hour [N]", first, last);
    time_report("held aside", "node on the bed, aside [m]", 0, late);
    time_report("held aside", "node on the bed, drift [m]", 0, late - early);
    /* without friction the force is 17.5 kN and the node 2.55 m aside (docs/validation.md). It
     * swings on, without drag, and that moves the touching part by micrometres */
    CHECK_RELATIVE(first, 20.2e3, 0.02);
    CHECK_RELATIVE(last, first, 2e-3);
    CHECK_NEAR(late, 0, 1e-3);
    CHECK_NEAR(late, early, 1e-5);
    time_close(&run, "held aside");
}

/* ---- statics as the limit ---- */

static const double AWAY[3] = {30, 20, 0};

/* The same history of positions of end B without inertia. */
static void slowly(int steps, double force[3]) {
    TimeRig rig;
    mooring(&rig, 30);
    TimeRun run = time_open(&rig);
    time_step(&run);
    for (int k = 1; k <= steps; k++) {
        CpsStage move = cps_stage_default();
        const double share = 0.5 * (1 - cos(PI * k / steps));
        CpsChange change = {.end = CPS_END_B,
                            .to = {.kind = CPS_END_KIND_HELD, .value = {5.2, 0, -70}}};
        for (int a = 0; a < 3; a++) change.to.value[a] += share * AWAY[a];
        move.change = &change;
        move.change_count = 1;
        CpsError err;
        if (cps_evolution_move(run.evolution, &move, &err)) fail_msg("%s", err.message);
    }
    const CpsLineReport report = cps_evolution_line_report(run.evolution, 0);
    for (int a = 0; a < 3; a++) force[a] = report.end[CPS_END_B].force[a];
    cps_evolution_destroy(run.evolution);
}

/* ... and in time, by half a period: how far the force is from that of statics. */
static double off_statics(CpsTimeScheme scheme, double duration, int steps) {
    TimeRig rig;
    double still[3], off = 0;
    slowly(steps, still);
    mooring(&rig, 30);
    rig.scene.time_scheme = scheme;
    time_stage(&rig, duration, steps);
    time_change(&rig, CPS_END_KIND_HELD, 5.2, 0, -70);
    CpsSway *sway = time_sway(&rig, 2 * duration);
    for (int a = 0; a < 3; a++) sway->cosine[a] = 0.5 * AWAY[a];
    TimeRun run = time_open(&rig);
    time_steps(&run, 0);
    for (int a = 0; a < 3; a++) off += pow(run.report.end[CPS_END_B].force[a] - still[a], 2);
    time_close(&run, "slow history");
    return sqrt(off);
}

/* The implicit Euler method without inertia is statics, step by step, so that what is left falls
 * with the square of the speed, as the forces of inertia do. The formula of second order measures
 * slip from places before the step's beginning: it tends to the same path as steps become shorter.
 */
static void statics_is_the_limit_of_slow_histories(void **state) {
    (void)state;
    double last = 0;
    for (int k = 0; k < 4; k++) {
        const double duration = 2000 * pow(4, k),
                     off = off_statics(CPS_TIME_SCHEME_EULER, duration, 40);
        char figure[64];
        snprintf(figure, sizeof figure, "Euler, force, off in %g s [N]", duration);
        time_report("slow history", figure, 0, off);
        if (k > 0) time_report("slow history", "order in the speed", 2, log2(last / off) / 2);
        if (k > 0) CHECK_GREATER(log2(last / off) / 2, 1);
        last = off;
    }
    for (int k = 0; k < 3; k++) {
        const double off = off_statics(CPS_TIME_SCHEME_BDF2, 2e5, 40 << (2 * k));
        char figure[64];
        snprintf(figure, sizeof figure, "BDF2, force, off in %d steps [N]", 40 << (2 * k));
        time_report("slow history", figure, 0, off);
        if (k > 0) CHECK_LESS(off, 0.5 * last);
        last = off;
    }
}

/* ---- a chain that falls ---- */

/* A chain of 2 n + 1 links hangs from two neighbouring hooks, and end B is let go: where the tip
 * has fallen by x its velocity is that of v^2 = g x (2 L - x)/(L - x). Worst relative error up to
 * x = 0.9 L. */
static double falling(int half, double step) {
    TimeRig rig;
    const int links = 2 * half + 1;
    const double length = 1, l = length / links, unit = sqrt(length / 9.81);
    time_begin(&rig, length, links, 1, INFINITY);
    for (int j = 0; j <= links; j++)
        time_node(&rig, j, j <= half ? 0 : l, 0, -l * (j <= half ? j : links - j));
    time_stage(&rig, 1.25 * unit, (int)lround(1.25 / step));
    TimeRun run = time_open(&rig);
    double worst = 0, at = 0.1;
    while (cps_evolution_remaining_count(run.evolution) > 0) {
        time_step(&run);
        const double x = -run.view.position[3 * links + 2] / length,
                     v = -run.motion.velocity[3 * links + 2];
        if (x > 0.9) break;
        if (x < 0.02) continue;
        const double exact = sqrt(rig.gravity * length * x * (2 - x) / (1 - x));
        if (!(fabs(v / exact - 1) <= worst)) worst = fabs(v / exact - 1);
        if (x >= at) {
            char figure[48];
            snprintf(figure, sizeof figure, "velocity at x = %.3f L [m/s]", x);
            time_report("falling chain", figure, exact, v);
            time_report("falling chain", "free fall there [m/s]", sqrt(2 * rig.gravity * x), v);
            at += 0.2;
        }
    }
    time_report("falling chain", "worst relative error to 0.9 L", 0, worst);
    time_close(&run, "falling chain");
    return worst;
}

static void the_tip_of_a_chain_falls_faster_than_freely(void **state) {
    (void)state;
    const double coarse = falling(25, 1e-3), fine = falling(100, 4e-4);
    CHECK_LESS(fine, 0.015);
    CHECK_LESS(fine, coarse);
}

/* ---- states and moves ---- */

/* A chain whose end B is swung over a rough plane and then let go. */
static void swung(TimeRig *rig) {
    time_begin(rig, 3, 30, 1.1, 4e4);
    time_plane(rig, -1, 0.4);
    rig->scene.in_time = true;
    rig->line.start = (CpsStart){.kind = CPS_START_STATIC};
    rig->line.end[CPS_END_A] = (CpsEnd){.kind = CPS_END_KIND_HELD, .value = {0, 0, 0}};
    rig->line.end[CPS_END_B] = (CpsEnd){.kind = CPS_END_KIND_HELD, .value = {1.8, 0, 0}};
    time_stage(rig, 0.5, 100);
    time_change(rig, CPS_END_KIND_HELD, 1.8, 0.2, 0);
    time_sway(rig, 0.4)->sine[2] = 0.2;
    time_stage(rig, 0.5, 100);
    time_change(rig, CPS_END_KIND_RELEASED, 0, 0, 0);
}

static void check_same(const TimeRun *a, const TimeRun *b) {
    const size_t places = 3 * ((size_t)a->view.element_count + 1) * sizeof(double);
    assert_memory_equal(a->view.position, b->view.position, places);
    assert_memory_equal(a->motion.velocity, b->motion.velocity, places);
    assert_memory_equal(&a->motion.ledger, &b->motion.ledger, sizeof a->motion.ledger);
    assert_true(cps_evolution_time(a->evolution) == cps_evolution_time(b->evolution));
}

/* Saved after some step, and loaded into another evolution, it goes on with the same bits. */
static void a_saved_motion_goes_on_with_the_same_bits(void **state) {
    (void)state;
    for (int at = 1; at < 170; at += 37) {
        TimeRig rig, other;
        CpsError err;
        swung(&rig);
        swung(&other);
        TimeRun run = time_open(&rig), copy = time_open(&other);
        time_steps(&run, at);
        const size_t size = cps_evolution_state_size(run.evolution);
        void *saved = malloc(size);
        assert_non_null(saved);
        cps_evolution_save(run.evolution, saved);
        if (cps_evolution_load(copy.evolution, saved, size, &err)) fail_msg("%s", err.message);
        free(saved);
        time_steps(&run, 30);
        time_steps(&copy, 30);
        check_same(&run, &copy);
        cps_evolution_destroy(run.evolution);
        cps_evolution_destroy(copy.evolution);
    }
}

/* A quasi-static stage between two in time: the audit finds statics there, and rest after it. */
static void quasi_static_stages_are_at_rest(void **state) {
    (void)state;
    TimeRig rig;
    swung(&rig);
    rig.scene.stage_count = 1;
    time_stage(&rig, 0, 3);
    time_change(&rig, CPS_END_KIND_HELD, 1.8, 0.2, -0.1);
    time_stage(&rig, 0.2, 40);
    TimeRun run = time_open(&rig);
    time_steps(&run, 1 + 100);
    CHECK_GREATER(run.motion.kinetic, 0);
    for (int k = 0; k < 3; k++) {
        time_step(&run);
        assert_false(run.motion.is_moving);
        CHECK_NEAR(run.motion.kinetic, 0, 0);
        CHECK_NEAR(run.motion.velocity[3 * 15 + 2], 0, 0);
    }
    time_steps(&run, 40);
    /* nothing changes: it stays at rest but for the accuracy of statics */
    CHECK_LESS(run.motion.kinetic, 1e-9);
    time_close(&run, "quasi-static between");
}

/* A stage is the same as moves of its steps; a move that is taken back leaves no trace. */
static void moves_have_durations(void **state) {
    (void)state;
    TimeRig rig, other;
    CpsError err;
    swung(&rig);
    swung(&other);
    other.scene.stage_count = 0;
    TimeRun run = time_open(&rig), moved = time_open(&other);
    time_steps(&run, 1 + 20);
    time_steps(&moved, 1);
    for (int k = 1; k <= 20; k++) {
        CpsStage move = cps_stage_default();
        const double share = k / 100.0, height = 0.2 * sin(2 * PI * (k * (0.5 / 100) / 0.4));
        const CpsChange change = {.end = CPS_END_B,
                                  .to = {.kind = CPS_END_KIND_HELD,
                                         .value = {1.8, share * 0.2, height}}};
        move.change = &change;
        move.change_count = 1;
        move.duration = 0.5 / 100;
        for (int twice = 0; twice < 2; twice++) {
            if (cps_evolution_move(moved.evolution, &move, &err)) fail_msg("%s", err.message);
            if (twice == 0 && cps_evolution_take_back(moved.evolution, &err))
                fail_msg("%s", err.message);
        }
    }
    moved.view = cps_evolution_line_view(moved.evolution, 0);
    for (int i = 0; i < 3 * 31; i++) CHECK_NEAR(moved.view.position[i], run.view.position[i], 1e-9);
    CHECK_NEAR(cps_evolution_time(moved.evolution), cps_evolution_time(run.evolution), 1e-15);
    cps_evolution_destroy(run.evolution);
    cps_evolution_destroy(moved.evolution);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_tip_of_a_chain_falls_faster_than_freely),
        cmocka_unit_test(statics_is_the_limit_of_slow_histories),
        cmocka_unit_test(a_line_held_aside_stays),
        cmocka_unit_test(a_saved_motion_goes_on_with_the_same_bits),
        cmocka_unit_test(quasi_static_stages_are_at_rest),
        cmocka_unit_test(moves_have_durations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
