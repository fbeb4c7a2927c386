/* SPDX-License-Identifier: BSD-3-Clause */
/* Motions in time with known answers: a pendulum, waves in a bar, a hanging chain, a chain that
 * falls, statics as the limit of slow histories. Each figure is printed. */
#include <stdio.h>

#include "time_rig.h"

static const double PI = 3.14159265358979323846;

/* ---- pendulum ---- */

/* The error of the angle of a line of one element, whose mass is at its ends, after two seconds.
 * The tension is checked too: m g cos theta + m L omega^2 at the lowest point. */
static double pendulum(CpsTimeScheme scheme, int steps, double stiffness) {
    TimeRig rig;
    const double angle = 0.9, time = 2;
    time_begin(&rig, 1.5, 1, 2, stiffness);
    rig.scene.time_scheme = scheme;
    time_node(&rig, 1, 1.5 * sin(angle), 0, -1.5 * cos(angle));
    time_stage(&rig, time, steps);
    TimeRun run = time_open(&rig);
    time_steps(&run, 0);
    const double found = atan2(run.view.position[3], -run.view.position[5]),
                 exact = time_pendulum_angle(angle, rig.gravity / 1.5, time);
    char name[48];
    snprintf(name, sizeof name, "pendulum, %s, %d steps", scheme ? "Euler" : "BDF2", steps);
    const double error = time_report(name, "angle after 2 s [rad]", exact, found);
    if (scheme == CPS_TIME_SCHEME_EULER) CHECK_GREATER(run.scheme, 0);
    time_close(&run, name);
    return error;
}

static void a_pendulum_has_the_order_of_the_scheme(void **state) {
    (void)state;
    for (int scheme = 0; scheme < 2; scheme++) {
        double error[4];
        for (int k = 0; k < 4; k++)
            error[k] = pendulum((CpsTimeScheme)scheme, (scheme ? 800 : 200) << k, INFINITY);
        const double order = log2(error[2] / error[3]);
        time_report(scheme ? "pendulum, Euler" : "pendulum, BDF2", "order", scheme ? 1 : 2, order);
        /* what a further halving would change: the next order's part of the error */
        CHECK_NEAR(order, scheme ? 1 : 2, 0.1);
    }
}

/* ---- waves along a bar ---- */

/* A bar held at A and pulled at B with T0, started in its first mode along itself: x(s) = s (1 +
 * T0/EA) + a sin(pi s/(2 L)). The chain of masses has the exact mode too, with the rate
 * (2 c/l) sin(pi l/(4 L)), c = sqrt(EA/m). B is back after a quarter of the period. */
static double bar(int elements, int steps, double *discrete) {
    TimeRig rig;
    const double length = 3, mass = 0.7, stiffness = 5e4, pull = 900, a = 0.005;
    const double c = sqrt(stiffness / mass), rate = PI * c / (2 * length), l = length / elements;
    time_begin(&rig, length, elements, mass, stiffness);
    rig.scene.gravity[2] = rig.line.weight = 0;
    for (int j = 0; j <= elements; j++) {
        const double s = j * l;
        time_node(&rig, j, s * (1 + pull / stiffness) + a * sin(PI * s / (2 * length)), 0, 0);
    }
    rig.line.end[CPS_END_B] = (CpsEnd){.kind = CPS_END_KIND_FREE, .value = {pull, 0, 0}};
    const double period = 2 * PI / rate, h = period / steps;
    time_stage(&rig, period, steps);
    TimeRun run = time_open(&rig);
    const double rest = length * (1 + pull / stiffness);
    double before = a, at = 0;
    for (int k = 0; k < steps && at == 0; k++) {
        time_step(&run);
        const double off = run.view.position[3 * elements] - rest;
        if (off < 0) at = h * (k + before / (before - off)); /* between two steps */
        before = off;
    }
    *discrete = 2 * c / l * sin(PI * l / (4 * length));
    char name[48];
    snprintf(name, sizeof name, "bar, N = %d, %d steps", elements, steps);
    time_close(&run, name);
    return length / at; /* speed of the wave, which has gone along the bar */
}

static void waves_go_along_a_bar_with_their_speed(void **state) {
    (void)state;
    const double speed = sqrt(5e4 / 0.7);
    double error[3], discrete;
    for (int k = 0; k < 3; k++) {
        const int n = 8 << k;
        const double found = bar(n, 1600, &discrete);
        error[k] = time_report("bar", "speed of waves, 1600 steps [m/s]", speed, found);
    }
    /* errors of the mesh, (pi l/(4 L))^2/6 of the speed, and of the scheme, (rate h)^2/3 */
    CHECK_NEAR(log2(error[0] / error[1]), 2, 0.1);
    CHECK_LESS(fabs(error[2]) / speed, pow(PI / (4 * 32), 2) / 6 + pow(2 * PI / 1600, 2));
    const double coarse = bar(8, 100, &discrete), fine = bar(8, 200, &discrete),
                 exact = 2 * 3 / PI * discrete;
    const double order = log2((coarse - exact) / (fine - exact));
    time_report("bar", "order in time", 2, order);
    CHECK_NEAR(order, 2, 0.1);
}

/* ---- hanging chain ---- */

/* J0 by the trapezium rule of its integral, (1/pi) int cos(x sin t) dt, which is exact here. */
static double bessel(double x) {
    double sum = 0;
    for (int i = 0; i < 64; i++) sum += cos(x * sin(PI * i / 64));
    return sum / 64;
}

/* The rate at which a chain swings that hangs from A and starts in a mode of the continuous one,
 * J0(zero sqrt(s/L)), s the length from its free end: from the time of a quarter of the period. */
static double hanging(int elements, int mode, double zero) {
    TimeRig rig;
    const double length = 2, a = 2e-5, l = length / elements;
    const double rate = zero / 2 * sqrt(9.81 / length), period = 2 * PI / rate;
    const int steps = 1200;
    time_begin(&rig, length, elements, 1.3, INFINITY);
    double x[TIME_POINTS], z = 0, before = 0;
    /* from B upwards: J0(zero sqrt(s/L)), s the length from the free end */
    for (int j = 0; j <= elements; j++)
        x[j] = a * bessel(zero * sqrt((double)(elements - j) / elements));
    for (int j = 0; j <= elements; j++) {
        if (j > 0) z -= sqrt(l * l - (x[j] - before) * (x[j] - before));
        before = x[j];
        time_node(&rig, j, x[j] - x[0], 0, z);
    }
    time_stage(&rig, period / 2, steps / 2);
    TimeRun run = time_open(&rig);
    /* the part of the motion in the mode: its mass times the mode's shape */
    double last = 0, at = 0;
    for (int j = 0; j <= elements; j++) last += (j < elements ? 1 : 0.5) * x[j] * (x[j] - x[0]);
    for (int k = 0; at == 0 && cps_evolution_remaining_count(run.evolution) > 0; k++) {
        time_step(&run);
        double now = 0;
        for (int j = 0; j <= elements; j++)
            now += (j < elements ? 1 : 0.5) * x[j] * run.view.position[3 * j];
        if (now < 0) at = period / steps * (k + last / (last - now));
        last = now;
    }
    char name[48];
    snprintf(name, sizeof name, "hanging, N = %d, mode %d", elements, mode);
    time_close(&run, name);
    return PI / 2 / at;
}

static void a_hanging_chain_has_its_frequencies(void **state) {
    (void)state;
    static const double ZERO[3] = {2.404825557695773, 5.520078110286311, 8.653727912911013};
    for (int mode = 0; mode < 3; mode++) {
        const double exact = ZERO[mode] / 2 * sqrt(9.81 / 2);
        double error[3];
        for (int k = 0; k < 3; k++) {
            const int n = (mode ? 20 : 10) << k;
            char figure[48];
            snprintf(figure, sizeof figure, "rate of mode %d, N = %d [rad/s]", mode + 1, n);
            error[k] =
                time_report("hanging chain", figure, exact, hanging(n, mode + 1, ZERO[mode]));
        }
        const double order = log2(error[0] / error[1]);
        time_report("hanging chain", "order of the mesh", 2, order);
        CHECK_NEAR(order, 2, 0.35);
        CHECK_LESS(fabs(error[2]) / exact, mode ? 3e-3 : 1e-3);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_pendulum_has_the_order_of_the_scheme),
        cmocka_unit_test(waves_go_along_a_bar_with_their_speed),
        cmocka_unit_test(a_hanging_chain_has_its_frequencies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
