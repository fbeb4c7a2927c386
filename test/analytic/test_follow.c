/* SPDX-License-Identifier: BSD-3-Clause */
/* Motion and loads in time by a function of a program: of time as the oscillation of a scene; of
 * the state beside the closed form of a damped oscillator. Each figure is printed. */
#include <stdio.h>

#include "capstan/follow.h"
#include "time_rig.h"

static const double PI = 3.14159265358979323846;

/* ---- of time ---- */

static const double PERIOD = 1.7, SIDE[3] = {0.3, -0.2, 0.1};

typedef struct Sway {
    CpsChange change;
    double from[3];
    int left; /* steps until it stops */
} Sway;

static bool swing(void *user, double time, const CpsEvolution *evolution, CpsStage *step) {
    Sway *sway = user;
    (void)evolution;
    for (int a = 0; a < 3; a++)
        sway->change.to.value[a] = sway->from[a] + SIDE[a] * sin(2 * PI * time / PERIOD);
    step->change = &sway->change;
    step->change_count = 1;
    return sway->left-- > 0;
}

static void hang(TimeRig *rig) {
    time_begin(rig, 3, 12, 2, 5e3);
    for (int j = 0; j <= 12; j++) time_node(rig, j, 0.2 * j, 0, 0.2 * j * (j - 12) / 12.0);
    rig->line.end[CPS_END_B].kind = CPS_END_KIND_AT_START;
}

static void a_function_of_time_is_the_oscillation_of_a_scene(void **state) {
    (void)state;
    enum { STEPS = 300 };
    TimeRig rig;
    CpsError err;
    hang(&rig);
    time_stage(&rig, 5, STEPS);
    time_change(&rig, CPS_END_KIND_HELD, 2.4, 0, 0);
    CpsSway *sway = time_sway(&rig, PERIOD);
    for (int a = 0; a < 3; a++) sway->sine[a] = SIDE[a];
    TimeRun run = time_open(&rig);
    time_steps(&run, 0);
    TimeRig other;
    CpsEvolution *evolution;
    hang(&other);
    other.scene.in_time = true;
    Sway own = {.change = {.end = CPS_END_B, .to = {.kind = CPS_END_KIND_HELD}},
                .from = {2.4, 0, 0},
                .left = STEPS + 10};
    if (cps_evolution_create(&other.scene, &evolution, &err)) fail_msg("%s", err.message);
    if (cps_evolution_follow(evolution, 5, STEPS, swing, &own, &err)) fail_msg("%s", err.message);
    const CpsLineView view = cps_evolution_line_view(evolution, 0);
    double off = 0;
    for (int i = 0; i < 3 * 13; i++) off = fmax(off, fabs(view.position[i] - run.view.position[i]));
    /* the shapes are stable, and places of the end are the same to rounding */
    CHECK_LESS(time_report("function of time", "largest difference of places [m]", 0, off), 1e-11);
    CHECK_INT(cps_evolution_report(evolution).step_count, STEPS);
    CHECK_NEAR(cps_evolution_time(evolution), 5, 1e-12);
    /* it stops where it says so */
    own.left = 4;
    if (cps_evolution_follow(evolution, 1, 9, swing, &own, &err)) fail_msg("%s", err.message);
    CHECK_INT(cps_evolution_report(evolution).step_count, STEPS + 4);
    cps_evolution_destroy(evolution);
    time_close(&run, "function of time");
}

/* ---- of the state ---- */

static const double LENGTH = 2, MASS = 3, STIFFNESS = 4e4, PULL = 2000, DAMPER = 120, SIZE = 0.02;

/* A damper of the program's own at end B. */
static bool damp(void *user, double time, const CpsEvolution *evolution, CpsStage *step) {
    CpsChange *change = user;
    const CpsLineMotion motion = cps_evolution_line_motion(evolution, 0);
    (void)time;
    change->to.value[0] = PULL - DAMPER * motion.velocity[3];
    step->change = change;
    step->change_count = 1;
    return true;
}

/* m x'' + c x' + k x = 0: the error of x after `time`. */
static double damped(int steps) {
    TimeRig rig;
    CpsError err;
    CpsEvolution *evolution;
    CpsChange change = {.end = CPS_END_B, .to = {.kind = CPS_END_KIND_FREE}};
    const double rest = LENGTH * (1 + PULL / STIFFNESS), time = 0.2;
    time_begin(&rig, LENGTH, 1, MASS, STIFFNESS);
    rig.scene.gravity[2] = rig.line.weight = 0;
    rig.scene.in_time = true;
    rig.line.end[CPS_END_B] = (CpsEnd){.kind = CPS_END_KIND_FREE, .value = {PULL, 0, 0}};
    time_node(&rig, 1, rest + SIZE, 0, 0);
    if (cps_evolution_create(&rig.scene, &evolution, &err)) fail_msg("%s", err.message);
    if (cps_evolution_follow(evolution, time, steps, damp, &change, &err))
        fail_msg("%s", err.message);
    const double m = 0.5 * MASS * LENGTH, decay = DAMPER / (2 * m),
                 rate = sqrt(STIFFNESS / LENGTH / m - decay * decay),
                 exact = rest + SIZE * exp(-decay * time) *
                                    (cos(rate * time) + decay / rate * sin(rate * time));
    const double error = time_report("function of the state", "place after 0.2 s [m]", exact,
                                     cps_evolution_line_view(evolution, 0).position[3]);
    cps_evolution_destroy(evolution);
    return error;
}

static void a_function_of_the_state_is_one_step_late(void **state) {
    (void)state;
    double error[4];
    for (int k = 0; k < 4; k++) error[k] = damped(400 << k);
    const double order = log2(error[2] / error[3]);
    CHECK_NEAR(time_report("function of the state", "order in h", 1, order), 0, 0.1);
}

/* ---- what is refused ---- */

static void wrong_calls_are_refused(void **state) {
    (void)state;
    TimeRig rig;
    CpsEvolution *evolution;
    CpsError err;
    Sway own = {.change = {.end = CPS_END_B, .to = {.kind = CPS_END_KIND_HELD}}, .left = 1};
    hang(&rig);
    if (cps_evolution_create(&rig.scene, &evolution, &err)) fail_msg("%s", err.message);
    CHECK_INT(cps_evolution_follow(NULL, 1, 1, swing, &own, &err), CPS_ERR_ARGUMENT);
    CHECK_INT(cps_evolution_follow(evolution, 1, 1, NULL, &own, &err), CPS_ERR_ARGUMENT);
    CHECK_INT(cps_evolution_follow(evolution, 0, 1, swing, &own, &err), CPS_ERR_ARGUMENT);
    CHECK_INT(cps_evolution_follow(evolution, NAN, 1, swing, &own, &err), CPS_ERR_ARGUMENT);
    CHECK_INT(cps_evolution_follow(evolution, INFINITY, 1, swing, &own, &err), CPS_ERR_ARGUMENT);
    CHECK_INT(cps_evolution_follow(evolution, 1, 0, swing, &own, &err), CPS_ERR_ARGUMENT);
    /* a scene that is not in time */
    CHECK_INT(cps_evolution_follow(evolution, 1, 1, swing, &own, &err), CPS_ERR_ARGUMENT);
    CHECK_INT(cps_evolution_report(evolution).step_count, 0);
    cps_evolution_destroy(evolution);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_function_of_time_is_the_oscillation_of_a_scene),
        cmocka_unit_test(a_function_of_the_state_is_one_step_late),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
