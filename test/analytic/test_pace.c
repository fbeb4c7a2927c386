/* SPDX-License-Identifier: BSD-3-Clause */
/* Steps whose lengths follow from the error asked for: the estimate against the error known of a
 * polynomial motion, the error reached on a pendulum, a bar and a block, states, bad values. Each
 * figure is printed. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "time_rig.h"

static const double PI = 3.14159265358979323846;

/* The next step: audited, and such that it may stand. */
static CpsPace pace_step(TimeRun *run, double longest, double asked) {
    time_step(run);
    const CpsPace pace = cps_evolution_pace(run->evolution);
    CHECK_LESS(pace.length, longest * (1 + 1e-12));
    CHECK_GREATER(pace.length, 1e-4 * longest * (1 - 1e-9));
    if (pace.length > 1.01e-4 * longest) CHECK_LESS(pace.error, asked * (1 + 1e-12));
    return pace;
}

/* ---- the estimate ---- */

/* A free node under a force that grows evenly, x''' = F/(m T): by Taylor's series about the end of
 * the step the formula of steps h and h/w leaves h^3 (1 + w)^2 x'''/(6 w (1 + 2 w)). It is exact
 * for the velocity, a parabola, but for what the first Euler step leaves, a third of it in each
 * step. */
static void the_estimate_is_the_error_of_a_cubic(void **state) {
    (void)state;
    TimeRig rig;
    const double force = 3, mass = 0.4, time = 40, h = 0.5;
    time_begin(&rig, 1e6, 1, 2e-6 * mass, INFINITY); /* always slack */
    rig.scene.gravity[2] = rig.line.weight = 0;
    time_node(&rig, 1, 1, 0, 0);
    for (int s = 0; s < 3; s++) {
        const double length = s == 1 ? 1.5 * h : h;
        CpsStage *stage = time_stage(&rig, time, (int)round(time / length));
        stage->duration = stage->step_count * length;
        stage->error = 1e9;
        time_change(&rig, CPS_END_KIND_FREE, force * (s + 1), 0, 0);
        if (s == 1) rig.change[1].to.value[0] = force * (1 + stage->duration / time);
        if (s == 2)
            rig.change[2].to.value[0] = rig.change[1].to.value[0] + force * stage->duration / time;
    }
    TimeRun run = time_open(&rig);
    double before = 0;
    for (int k = 0; cps_evolution_remaining_count(run.evolution) > 0; k++) {
        time_step(&run);
        const CpsPace pace = cps_evolution_pace(run.evolution);
        const double w = before > 0 ? pace.length / before : 1, y = force / (mass * time);
        const double expected = pow(pace.length, 3) * pow(1 + w, 2) * y / (6 * w * (1 + 2 * w));
        before = pace.length;
        CHECK_INT(pace.rejected, 0);
        if (k < 30) continue;
        if (fabs(w - 1) > 1e-9)
            time_report("cubic", "estimate where h changes [m]", expected, pace.error);
        CHECK_NEAR(pace.error, expected, 1e-9 * expected);
    }
    time_close(&run, "cubic");
}

/* ---- error reached ---- */

/* [m] How far the tip is from where it belongs after two seconds. */
static double pendulum(CpsTimeScheme scheme, double asked) {
    TimeRig rig;
    const double angle = 0.9, time = 2;
    time_begin(&rig, 1.5, 1, 2, INFINITY);
    rig.scene.time_scheme = scheme;
    time_node(&rig, 1, 1.5 * sin(angle), 0, -1.5 * cos(angle));
    time_stage(&rig, time, 8)->error = asked;
    TimeRun run = time_open(&rig);
    int rejected = 0;
    while (cps_evolution_remaining_count(run.evolution) > 0)
        rejected += pace_step(&run, time / 8, asked).rejected;
    CHECK_NEAR(cps_evolution_time(run.evolution), time, 1e-12);
    const double found = atan2(run.view.position[3], -run.view.position[5]),
                 exact = time_pendulum_angle(angle, rig.gravity / 1.5, time),
                 off = 1.5 * (found - exact);
    char name[48];
    snprintf(name, sizeof name, "pendulum, %s, %.1e m", scheme ? "Euler" : "BDF2", asked);
    time_report(name, "off after 2 s [m]", 0, off);
    time_report(name, "in own errors of all steps", 0, off / (asked * run.steps));
    time_report(name, "steps taken back", 0, rejected);
    CHECK_GREATER(rejected, 0);
    /* an error of the velocity, which makes one of the place as large, comes beside each; and the
     * rate w = w0 (1 - a^2/16 ..) falls with the amplitude a, by da w a/8 = 0.1 w da, which over
     * w t = 5 makes half as much again */
    CHECK_LESS(fabs(off), 3 * asked * run.steps);
    time_close(&run, name);
    return fabs(off);
}

/* A step of the order p makes an error of h^(p + 1), of which the motion adds up 1/h. */
static void the_error_of_a_pendulum_falls_with_what_is_asked(void **state) {
    (void)state;
    for (int scheme = 0; scheme < 2; scheme++) {
        double off[4];
        for (int k = 0; k < 4; k++) off[k] = pendulum((CpsTimeScheme)scheme, 1e-4 * pow(8, -k));
        const double order = log2(off[1] / off[3]) / 6, expected = scheme ? 1.0 / 2 : 2.0 / 3;
        time_report(scheme ? "pendulum, Euler" : "pendulum, BDF2", "power of the error asked",
                    expected, order);
        CHECK_NEAR(order, expected, 0.1);
    }
}

/* [m] A bar in its first mode: the chain of masses has it too, with the rate of the chain. */
static double bar(double asked) {
    TimeRig rig;
    const int elements = 8;
    const double length = 3, mass = 0.7, stiffness = 5e4, pull = 900, a = 0.005,
                 l = length / elements,
                 rate = 2 * sqrt(stiffness / mass) / l * sin(PI * l / (4 * length)),
                 period = 2 * PI / rate;
    time_begin(&rig, length, elements, mass, stiffness);
    rig.scene.gravity[2] = rig.line.weight = 0;
    for (int j = 0; j <= elements; j++) {
        const double s = j * l;
        time_node(&rig, j, s * (1 + pull / stiffness) + a * sin(PI * s / (2 * length)), 0, 0);
    }
    rig.line.end[CPS_END_B] = (CpsEnd){.kind = CPS_END_KIND_FREE, .value = {pull, 0, 0}};
    time_stage(&rig, period, 8)->error = asked;
    TimeRun run = time_open(&rig);
    while (cps_evolution_remaining_count(run.evolution) > 0) pace_step(&run, period / 8, asked);
    const double off = run.view.position[3 * elements] - length * (1 + pull / stiffness) - a;
    char name[48];
    snprintf(name, sizeof name, "bar, %.1e m", asked);
    time_report(name, "off after a period [m]", 0, off);
    CHECK_LESS(fabs(off), 2 * asked * run.steps);
    time_close(&run, name);
    return fabs(off);
}

/* At an extreme of the mode the phase shows only squared: what is off is the amplitude lost, of the
 * order 3 in h. */
static void the_error_of_a_bar_falls_with_what_is_asked(void **state) {
    (void)state;
    double off[3];
    for (int k = 0; k < 3; k++) off[k] = bar(1e-6 * pow(8, -k));
    time_report("bar", "power of the error asked", 1, log2(off[0] / off[2]) / 6);
    CHECK_GREATER(log2(off[0] / off[2]) / 6, 2.0 / 3 - 0.1);
}

/* A heavy node between two stretched springs on a rough plane comes to rest at the end of its half
 * cycles, each nearer to the middle by 2 mu N/k; then steps are the longest ones. */
static void a_block_stops_where_it_belongs(void **state) {
    (void)state;
    for (int k = 0; k < 2; k++) {
        TimeRig rig;
        const double asked = k ? 1e-7 : 1e-5, step = 0.1;
        time_block(&rig);
        time_stage(&rig, 8, 80)->error = asked;
        TimeRun run = time_open(&rig);
        CpsPace pace = {0};
        while (cps_evolution_remaining_count(run.evolution) > 0)
            pace = pace_step(&run, step, asked);
        /* k of both springs, N of the node with half of each element */
        const double loss = 2 * 0.1 * (5 + 0.01) * 9.81 / 800;
        double turn = 0.2;
        while (fabs(turn) > loss / 2) turn = turn > 0 ? loss - turn : -loss - turn;
        char name[48];
        snprintf(name, sizeof name, "block, %.0e m", asked);
        const double off = time_report(name, "place of rest [m]", turn, run.view.position[3]);
        CHECK_LESS(fabs(off), 2 * asked * run.steps);
        CHECK_NEAR(run.motion.velocity[3], 0, 0);
        time_report(name, "last step [s]", step, pace.length);
        CHECK_GREATER(pace.length, step / 2.01); /* two equal ones may share the end */
        time_close(&run, name);
    }
}

/* ---- states ---- */

/* A line that lands on a plane that moves, with an end that swings. */
static void drop_rig(TimeRig *rig, CpsShift *shift) {
    time_begin(rig, 3, 9, 0.7, INFINITY);
    time_plane(rig, 0, 0.4);
    rig->plane.moves = true;
    for (int j = 0; j <= 9; j++) time_node(rig, j, 0.3 * j, 0, 0.2);
    time_stage(rig, 0.6, 6)->error = 1e-4;
    *shift = (CpsShift){.obstacle = 0, .by = {0.1, 0, 0.02}};
    rig->stage[0].shift = shift;
    rig->stage[0].shift_count = 1;
    time_change(rig, CPS_END_KIND_HELD, 2.7, 0, 0.2);
    time_sway(rig, 0.3)->sine[1] = 0.05;
    time_stage(rig, 0.4, 4)->error = 1e-4;
    time_change(rig, CPS_END_KIND_RELEASED, 0, 0, 0);
}

static void states_go_on_with_the_same_bits(void **state) {
    (void)state;
    TimeRig rig;
    CpsShift shift;
    CpsError err;
    drop_rig(&rig, &shift);
    CpsEvolution *one = NULL, *other = NULL;
    if (cps_evolution_create(&rig.scene, &one, &err) ||
        cps_evolution_create(&rig.scene, &other, &err))
        fail_msg("%s", err.message);
    const size_t size = cps_evolution_state_size(one);
    unsigned char *end = malloc(size), *now = malloc(size), *at = malloc(64 * size);
    assert_non_null(end);
    assert_non_null(now);
    assert_non_null(at);
    int steps = 0, rejected = 0;
    while (cps_evolution_remaining_count(one) > 0) {
        if (steps < 64) cps_evolution_save(one, at + (size_t)steps * size);
        if (cps_evolution_step(one, &err)) fail_msg("%s", err.message);
        rejected += cps_evolution_pace(one).rejected;
        steps++;
        CHECK_INT(cps_evolution_report(one).step_count, steps);
    }
    CHECK_INT(cps_evolution_step_count(one), steps);
    CHECK_GREATER(rejected, 0);
    cps_evolution_save(one, end);
    for (int k = 0; k < steps && k < 64; k += 7) {
        if (cps_evolution_load(other, at + (size_t)k * size, size, &err))
            fail_msg("%s", err.message);
        while (cps_evolution_remaining_count(other) > 0)
            if (cps_evolution_step(other, &err)) fail_msg("%s", err.message);
        cps_evolution_save(other, now);
        /* the report's processor time differs */
        const CpsLineView a = cps_evolution_line_view(one, 0),
                          b = cps_evolution_line_view(other, 0);
        assert_memory_equal(a.position, b.position, 30 * sizeof(double));
        assert_memory_equal(a.tension, b.tension, 9 * sizeof(double));
        CHECK_INT(cps_evolution_report(other).step_count, steps);
    }
    free(end);
    free(now);
    free(at);
    cps_evolution_destroy(one);
    cps_evolution_destroy(other);
}

/* ---- bad values ---- */

static void refused(const CpsScene *scene, const char *words) {
    CpsEvolution *evolution = NULL;
    CpsError err;
    CHECK_INT(cps_evolution_create(scene, &evolution, &err), CPS_ERR_ARGUMENT);
    if (!strstr(err.message, words)) fail_msg("%s, expected: %s", err.message, words);
}

static void bad_errors_are_refused(void **state) {
    (void)state;
    TimeRig rig;
    CpsShift shift;
    CpsError err;
    const double bad[] = {-1, NAN, INFINITY, 1e-200};
    drop_rig(&rig, &shift);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        rig.stage[0].error = bad[i];
        refused(&rig.scene, "error is");
    }
    rig.stage[0].error = 1e-4;
    rig.stage[1].duration = 0;
    refused(&rig.scene, "give a duration");
    rig.scene.stage_count = 0;
    rig.scene.in_time = true;
    TimeRun run = time_open(&rig);
    time_step(&run);
    CpsStage move = cps_stage_default();
    move.duration = 0.1;
    move.error = 1e-3;
    CHECK_INT(cps_evolution_move(run.evolution, &move, &err), CPS_ERR_ARGUMENT);
    if (!strstr(err.message, "a move is one step")) fail_msg("%s", err.message);
    CHECK_NEAR(cps_evolution_pace(NULL).length, 0, 0);
    cps_evolution_destroy(run.evolution);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_estimate_is_the_error_of_a_cubic),
        cmocka_unit_test(the_error_of_a_pendulum_falls_with_what_is_asked),
        cmocka_unit_test(the_error_of_a_bar_falls_with_what_is_asked),
        cmocka_unit_test(a_block_stops_where_it_belongs),
        cmocka_unit_test(states_go_on_with_the_same_bits),
        cmocka_unit_test(bad_errors_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
