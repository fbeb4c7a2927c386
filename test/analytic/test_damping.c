/* SPDX-License-Identifier: BSD-3-Clause */
/* Internal damping of lines that move in time, by known answers: a mass on one element, a mode of a
 * bar, a line that goes slack. Each figure is printed. */
#include <stdio.h>

#include "time_rig.h"

static const double PI = 3.14159265358979323846;

/* ---- a mass on an element ---- */

/* m x'' + (BA/l) x' + (EA/l) (x - rest) = 0 from x(0) = rest + a, at rest. The element of length l
 * has half of its mass at B; a pull keeps it taut. Returns the error of x after `time`. */
static double oscillator(CpsTimeScheme scheme, int steps) {
    TimeRig rig;
    const double length = 2, mass = 3, stiffness = 4e4, pull = 2000, a = 0.02, time = 0.2,
                 damping = 300;
    time_begin(&rig, length, 1, mass, stiffness);
    rig.scene.gravity[2] = rig.line.weight = 0;
    rig.scene.time_scheme = scheme;
    rig.line.damping = damping;
    rig.line.end[CPS_END_B] = (CpsEnd){.kind = CPS_END_KIND_FREE, .value = {pull, 0, 0}};
    const double rest = length * (1 + pull / stiffness);
    time_node(&rig, 1, rest + a, 0, 0);
    time_stage(&rig, time, steps);
    TimeRun run = time_open(&rig);
    time_steps(&run, 0);
    const double m = mass * length / 2, decay = damping / length / (2 * m),
                 square = stiffness / length / m, rate = sqrt(square - decay * decay);
    const double exact =
        rest + a * exp(-decay * time) * (cos(rate * time) + decay / rate * sin(rate * time));
    char name[48];
    snprintf(name, sizeof name, "mass, %s, %d steps", scheme ? "Euler" : "BDF2", steps);
    const double error = time_report(name, "place after 0.2 s [m]", exact, run.view.position[3]);
    /* all of its energy but what is left goes to damping, and to the scheme */
    CHECK_GREATER(run.damping, 0);
    time_close(&run, name);
    return error;
}

static void a_mass_on_an_element_decays(void **state) {
    (void)state;
    for (int scheme = 0; scheme < 2; scheme++) {
        double error[4];
        for (int k = 0; k < 4; k++)
            error[k] = oscillator((CpsTimeScheme)scheme, (scheme ? 1600 : 100) << k);
        const double order = log2(error[2] / error[3]);
        time_report(scheme ? "mass, Euler" : "mass, BDF2", "order", scheme ? 1 : 2, order);
        CHECK_NEAR(order, scheme ? 1 : 2, 0.1);
    }
}

/* ---- a mode of a bar ---- */

/* A bar held at A and pulled at B, started in its first mode along itself, which decays by
 * exp(-(BA/EA) w^2 t/2), w the rate of the chain of masses. */
static void a_mode_of_a_bar_decays(void **state) {
    (void)state;
    enum { ELEMENTS = 16 };
    TimeRig rig;
    const double length = 3, mass = 0.7, stiffness = 5e4, pull = 900, a = 0.005, damping = 20;
    const double l = length / ELEMENTS,
                 w = 2 * sqrt(stiffness / mass) / l * sin(PI * l / (4 * length));
    time_begin(&rig, length, ELEMENTS, mass, stiffness);
    rig.scene.gravity[2] = rig.line.weight = 0;
    rig.line.damping = damping;
    for (int j = 0; j <= ELEMENTS; j++) {
        const double s = j * l;
        time_node(&rig, j, s * (1 + pull / stiffness) + a * sin(PI * s / (2 * length)), 0, 0);
    }
    rig.line.end[CPS_END_B] = (CpsEnd){.kind = CPS_END_KIND_FREE, .value = {pull, 0, 0}};
    const double decay = damping / stiffness * w * w / 2, rate = sqrt(w * w - decay * decay),
                 time = 3 * 2 * PI / rate;
    time_stage(&rig, time, 6000);
    TimeRun run = time_open(&rig);
    time_steps(&run, 0);
    const double found = run.view.position[3 * ELEMENTS] - length * (1 + pull / stiffness);
    /* 2000 steps a period: (w h)^3 of BDF2 a period is 3e-8 of the amplitude, (w h)^2/3 of the
     * phase 3e-6 of it */
    CHECK_NEAR(time_report("bar", "amplitude after three periods [m]", a * exp(-decay * time),
                           found),
               0, 1e-5 * a);
    CHECK_BETWEEN(exp(-decay * time), 0.01, 0.9);
    time_close(&run, "bar");
}

/* ---- slack ---- */

/* A mass that is thrown up towards the hook from a stretched element: damping never pushes, and
 * where the element is slack the mass flies on as if alone. */
static void a_slack_element_does_not_push(void **state) {
    (void)state;
    TimeRig rig;
    const double length = 1, stiffness = 1e4, h = 1e-3;
    time_begin(&rig, length, 1, 2, stiffness);
    rig.line.damping = 500;
    rig.line.velocity[2] = 3;
    time_node(&rig, 1, 0, 0, -1.01);
    time_stage(&rig, 200 * h, 200);
    TimeRun run = time_open(&rig);
    double before = 3, least = INFINITY, off = 0, elongation = INFINITY;
    while (cps_evolution_remaining_count(run.evolution) > 0) {
        time_step(&run);
        const double speed = run.motion.velocity[5];
        least = fmin(least, run.view.segment_force[2]);
        off = fmax(off, fabs(speed - before + rig.gravity * h));
        /* the elongation goes back to 0 as exp(-EA t/BA), here 0.05 s */
        CHECK_LESS(run.motion.elongation[0], elongation);
        elongation = run.motion.elongation[0];
        before = speed;
    }
    const double left = 0.01 * exp(-stiffness / 500 * 200 * h);
    time_report("slack", "least tension [N]", 0, least);
    time_report("slack", "elongation after 0.2 s [-]", left, elongation);
    CHECK_NEAR(time_report("slack", "change of speed off [m/s]", 0, off), 0, 1e-9);
    CHECK_BETWEEN(least, -1e-9, 1e-6);
    CHECK_NEAR(elongation, left, 1e-3 * left);
    time_close(&run, "slack");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_mass_on_an_element_decays),
        cmocka_unit_test(a_mode_of_a_bar_decays),
        cmocka_unit_test(a_slack_element_does_not_push),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
