/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines in time on ground that moves: a belt that takes a line along, a table that turns under one,
 * a floor that throws one up, a post that pushes one aside. Each figure is printed. */
#include <stdio.h>
#include <string.h>

#include "time_rig.h"

static const double PI = 3.14159265358979323846;

/* A line of one element at rest on the plane, on which its ends are free. */
static void begin(TimeRig *rig, CpsTimeScheme scheme, double friction) {
    time_begin(rig, 0.1, 1, 3, INFINITY);
    rig->scene.time_scheme = scheme;
    time_plane(rig, 0, friction);
    rig->plane.moves = true;
    time_node(rig, 0, 2, 0, 0);
    time_node(rig, 1, 2, 0.1, 0);
    rig->line.end[CPS_END_A] = rig->line.end[CPS_END_B] = (CpsEnd){.kind = CPS_END_KIND_FREE};
}

typedef struct Sums {
    double obstacles, dissipated, kinetic, imbalance, turnover;
} Sums;

static void steps(CpsEvolution *evolution, int count, Sums *sums) {
    CpsError err;
    for (int k = 0; k < count; k++) {
        if (cps_evolution_step(evolution, &err)) fail_msg("%s", err.message);
        const CpsLineReport line = cps_evolution_line_report(evolution, 0);
        const CpsLineMotion motion = cps_evolution_line_motion(evolution, 0);
        assert_true(cps_outcome_is_certified(line.outcome));
        sums->obstacles += line.ledger.obstacles;
        sums->dissipated += line.ledger.dissipated;
        sums->kinetic = motion.kinetic;
        sums->imbalance += fabs(line.ledger.imbalance);
        sums->turnover += motion.ledger.turnover;
    }
}

/* The history of `count` steps in which the ground is shifted. */
static TimeRun carried(TimeRig *rig, const CpsShift *shift, double time, int count, Sums *sums) {
    CpsStage *stage = time_stage(rig, time, count);
    stage->shift = shift;
    stage->shift_count = 1;
    TimeRun run = time_open(rig);
    steps(run.evolution, count, sums);
    return run;
}

/* A belt that starts with the velocity V drags a line at rest along: it lags behind by V^2/(2 mu
 * g), then it goes with the belt. The belt does twice the work of the kinetic energy, half of it
 * lost. */
static void a_belt_takes_a_line_along(void **state) {
    (void)state;
    const double speed = 1.5, friction = 0.4, time = 1, mass = 0.3;
    const double lag = speed * speed / (2 * friction * 9.81);
    for (int scheme = 0; scheme < 2; scheme++) {
        double off[2];
        for (int k = 0; k < 2; k++) {
            const int count = 100 << k;
            TimeRig rig;
            begin(&rig, (CpsTimeScheme)scheme, friction);
            const CpsShift shift = {.obstacle = 0, .by = {speed * time, 0, 0}};
            Sums sums = {0};
            TimeRun run = carried(&rig, &shift, time, count, &sums);
            const CpsLineView view = cps_evolution_line_view(run.evolution, 0);
            const CpsLineMotion motion = cps_evolution_line_motion(run.evolution, 0);
            char name[48];
            snprintf(name, sizeof name, "belt, %s, %d steps", scheme ? "Euler" : "BDF2", count);
            off[k] = time_report(name, "lag [m]", lag, speed * time - (view.position[0] - 2)) / lag;
            time_report(name, "velocity [m/s]", speed, motion.velocity[0]);
            time_report(name, "work of the belt [J]", mass * speed * speed, sums.obstacles);
            time_report(name, "lost to friction [J]", mass * speed * speed / 2, sums.dissipated);
            CHECK_NEAR(motion.velocity[0], speed, 1e-9);
            /* by Euler's method the work of equal friction on equal ways */
            CHECK_NEAR(sums.obstacles, mass * speed * speed,
                       (scheme ? 1e-9 : 0.015 / (1 << k)) * mass * speed * speed);
            CHECK_LESS(sums.imbalance, 1e-10 * sums.turnover);
            cps_evolution_destroy(run.evolution);
        }
        /* Euler's method is of the first order; by the other the step in which it comes to rest on
         * the belt is not resolved */
        CHECK_LESS(fabs(off[0]), scheme ? 0.03 : 1e-3);
        CHECK_LESS(fabs(off[1]), scheme ? 0.015 : 2.5e-4);
    }
}

/* A table that turns slowly takes a line round with it: r w^2 < mu g, and at the start it slips by
 * no more than (r w)^2/(2 mu g). */
static void a_table_takes_a_line_round(void **state) {
    (void)state;
    TimeRig rig;
    const double rate = 0.5, time = PI / rate, friction = 0.6;
    begin(&rig, CPS_TIME_SCHEME_BDF2, friction);
    const CpsShift shift = {.obstacle = 0, .turn = {0, 0, PI}};
    CpsStage *stage = time_stage(&rig, time, 400);
    stage->shift = &shift;
    stage->shift_count = 1;
    TimeRun run = time_open(&rig);
    Sums sums = {0};
    steps(run.evolution, 400, &sums);
    const CpsLineView view = cps_evolution_line_view(run.evolution, 0);
    const CpsLineMotion motion = cps_evolution_line_motion(run.evolution, 0);
    const double slip = pow(2 * rate, 2) / (2 * friction * 9.81);
    time_report("table", "x after half a turn [m]", -2, view.position[0]);
    time_report("table", "speed [m/s]", 2 * rate, hypot(motion.velocity[0], motion.velocity[1]));
    time_report("table", "slip that is allowed [m]", slip,
                hypot(view.position[0] + 2, view.position[1]));
    CHECK_LESS(hypot(view.position[0] + 2, view.position[1]), 1.2 * slip);
    CHECK_NEAR(hypot(motion.velocity[0], motion.velocity[1]), 2 * rate, 1e-3 * 2 * rate);
    CHECK_LESS(sums.imbalance, 1e-10 * sums.turnover);
    cps_evolution_destroy(run.evolution);
}

/* A floor that rises with the velocity V and stops throws the line up by V^2/(2 g); it lands after
 * 2 V/g, and stays. */
static void a_floor_throws_a_line_up(void **state) {
    (void)state;
    const double speed = 2, time = 0.2;
    double off[2];
    for (int k = 0; k < 2; k++) {
        TimeRig rig;
        begin(&rig, CPS_TIME_SCHEME_BDF2, 0.3);
        const CpsShift shift = {.obstacle = 0, .by = {0, 0, speed * time}};
        const int count = 400 << k;
        CpsStage *stage = time_stage(&rig, time, 20);
        stage->shift = &shift;
        stage->shift_count = 1;
        time_stage(&rig, 0.6, count);
        TimeRun run = time_open(&rig);
        Sums sums = {0};
        steps(run.evolution, 20, &sums);
        CHECK_NEAR(cps_evolution_line_motion(run.evolution, 0).velocity[2], speed, 1e-9);
        double top = 0, height = 0;
        for (int i = 0; i < count; i++) {
            steps(run.evolution, 1, &sums);
            height = cps_evolution_line_view(run.evolution, 0).position[2] - speed * time;
            if (height > top) top = height;
        }
        char name[48];
        snprintf(name, sizeof name, "floor, %d steps", count);
        const double exact = speed * speed / (2 * 9.81);
        off[k] = time_report(name, "thrown up by [m]", exact, top) / exact;
        time_report(name, "height at the end [m]", 0, height);
        CHECK_NEAR(height, 0, 1e-12);
        CHECK_NEAR(sums.kinetic, 0, 1e-20);
        CHECK_LESS(sums.imbalance, 1e-10 * sums.turnover);
        cps_evolution_destroy(run.evolution);
    }
    /* of the second order in the air, and the top lies between two steps */
    CHECK_LESS(fabs(off[0]), 1e-4);
    CHECK_LESS(fabs(off[1]), 3e-5);
}

/* A post goes from one side of a string to the other and beyond, 12 radii, or turns beside it, in
 * `count` steps: returns how many are certified, and the place of the string's middle. */
static int push(int count, double way, double angle, double *middle) {
    TimeRig rig;
    CpsError err;
    time_begin(&rig, 2, 40, 1, 1000);
    time_plane(&rig, 0, 0.2);
    rig.plane.kind = CPS_OBSTACLE_CYLINDER;
    rig.plane.moves = true;
    rig.plane.radius = 0.05;
    memcpy(rig.plane.point, (double[]){1, 0.3, 0}, sizeof rig.plane.point);
    memcpy(rig.plane.axis, (double[]){0, 0, 1}, sizeof rig.plane.axis);
    for (int j = 0; j <= 40; j++) time_node(&rig, j, 0.05 * j, 0, 0);
    rig.line.end[CPS_END_B].kind = CPS_END_KIND_AT_START;
    const CpsShift shift = {.obstacle = 0, .by = {0, way, 0}};
    const CpsTurn turn = {.obstacle = 0, .angle = angle};
    CpsStage *stage = time_stage(&rig, 1, count);
    stage->shift = &shift;
    stage->shift_count = way != 0;
    stage->turn = &turn;
    stage->turn_count = angle != 0;
    TimeRun run = time_open(&rig);
    int certified = 0;
    for (int k = 0; k < count; k++) {
        if (cps_evolution_step(run.evolution, &err)) fail_msg("%s", err.message);
        const CpsOutcome outcome = cps_evolution_report(run.evolution).outcome;
        certified += cps_outcome_is_certified(outcome);
        assert_true(cps_outcome_is_certified(outcome) || outcome == CPS_OUTCOME_STALLED);
    }
    *middle = cps_evolution_line_view(run.evolution, 0).position[3 * 20 + 1];
    cps_evolution_destroy(run.evolution);
    return certified;
}

/* It goes by no more than a quarter of its radius in a step, and turns by no more than a quarter of
 * a turn, or the step is not certified. */
static void no_step_is_too_long_for_a_post(void **state) {
    (void)state;
    double middle;
    CHECK_INT(push(1, -0.6, 0, &middle), 0);
    CHECK_LESS(push(12, -0.6, 0, &middle), 12);
    CHECK_INT(push(100, -0.6, 0, &middle), 100);
    time_report("post", "middle of the string [m]", -0.35, middle);
    CHECK_LESS(middle, -0.3);
    CHECK_INT(push(1, 0, 2, &middle), 0);
    CHECK_INT(push(2, 0, 2, &middle), 2);
    /* away from the string any speed will do */
    CHECK_INT(push(1, 0.6, 0, &middle), 1);
}

/* A line at rest on a deck goes with it, by three radii of its edges in a step. */
static void a_line_goes_with_a_deck(void **state) {
    (void)state;
    const double by[3] = {1.5, -0.6, 0}, time = 1;
    const int count = 10;
    TimeRig rig;
    begin(&rig, CPS_TIME_SCHEME_BDF2, 0.4);
    rig.plane.kind = CPS_OBSTACLE_BOX;
    memcpy(rig.plane.point, (double[]){1, 0, -0.5}, sizeof rig.plane.point);
    memcpy(rig.plane.shape.size, (double[]){6, 4, 1}, sizeof rig.plane.shape.size);
    rig.plane.radius = 0.05;
    memcpy(rig.line.velocity, by, sizeof by);
    CpsShift shift = {.obstacle = 0};
    memcpy(shift.by, by, sizeof by);
    Sums sums = {0};
    TimeRun run = carried(&rig, &shift, time, count, &sums);
    const double *place = cps_evolution_line_view(run.evolution, 0).position;
    time_report("deck", "x of the line [m]", 2 + by[0], place[0]);
    time_report("deck", "y of the line [m]", by[1], place[1]);
    for (int a = 0; a < 3; a++) CHECK_NEAR(place[a], (a == 0 ? 2 : 0) + by[a], 1e-9);
    cps_evolution_destroy(run.evolution);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_belt_takes_a_line_along),
        cmocka_unit_test(a_table_takes_a_line_round),
        cmocka_unit_test(a_floor_throws_a_line_up),
        cmocka_unit_test(no_step_is_too_long_for_a_post),
        cmocka_unit_test(a_line_goes_with_a_deck),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
