/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines that move in time on obstacles that give, by known answers: a rope that heaves in the bed,
 * one that is dropped and rises again by what the damping leaves, one that slides, and the rigid
 * bed as the limit. Each figure is printed. */
#include <stdio.h>

#include "splitmix.h"
#include "time_rig.h"

/* A straight rope of `elements`, free at both ends, level at a height, on a bed that gives. */
static void rope_on_bed(TimeRig *rig, double height, int elements, double mass, double stiffness,
                        double damping) {
    time_begin(rig, 4, elements, mass, 1e6);
    time_plane(rig, 0, 0);
    rig->plane.stiffness = stiffness;
    rig->plane.damping = damping;
    rig->line.bearing_width = 0.2;
    rig->line.end[CPS_END_A] = (CpsEnd){.kind = CPS_END_KIND_FREE};
    for (int j = 0; j <= elements; j++) time_node(rig, j, 4.0 * j / elements, 0, height);
}

/* ---- it heaves ---- */

/* m z'' + c b z' + k b z = -m g per metre, never out of the bed. Returns the error of z. */
static double heave(CpsTimeScheme scheme, int steps, double damping) {
    TimeRig rig;
    const double mass = 3, stiffness = 3000, time = 0.8, deep = -0.08, g = 9.81;
    rope_on_bed(&rig, deep, 6, mass, stiffness, damping);
    rig.scene.time_scheme = scheme;
    time_stage(&rig, time, steps);
    TimeRun run = time_open(&rig);
    time_steps(&run, 0);
    const double k = 0.2 * stiffness / mass, decay = 0.2 * damping / mass / 2,
                 rate = sqrt(k - decay * decay), rest = -g / k;
    const double exact = rest + (deep - rest) * exp(-decay * time) *
                                    (cos(rate * time) + decay / rate * sin(rate * time));
    char name[48];
    snprintf(name, sizeof name, "heave, %s, %d steps", scheme ? "Euler" : "BDF2", steps);
    const double error = time_report(name, "place after 0.8 s [m]", exact, run.view.position[2]);
    if (damping > 0) CHECK_GREATER(run.damping, 0);
    time_close(&run, name);
    return error;
}

static void a_rope_heaves_in_the_bed(void **state) {
    (void)state;
    for (int scheme = 0; scheme < 2; scheme++)
        for (int damped = 0; damped < 2; damped++) {
            double error[4];
            for (int k = 0; k < 4; k++)
                error[k] =
                    heave((CpsTimeScheme)scheme, (scheme ? 1600 : 100) << k, damped ? 60.0 : 0.0);
            const double order = log2(error[2] / error[3]);
            time_report(scheme ? "heave, Euler" : "heave, BDF2", "order", scheme ? 1 : 2, order);
            CHECK_NEAR(order, scheme ? 1 : 2, 0.1);
        }
}

/* ---- it is dropped ---- */

/* A rope falls on the bed, and rises again. `grown`: by how much its energy, with that of the bed,
 * has ever been above what it was at first, over all of it; by Euler's method, has grown in a step.
 * Returns how high it rises. */
static double drop(double height, double stiffness, double damping, CpsTimeScheme scheme, int steps,
                   double *grown) {
    TimeRig rig;
    const double mass = 3, g = 9.81, fall = sqrt(2 * height / g), k = 0.2 * stiffness / mass;
    rope_on_bed(&rig, height, 2, mass, stiffness, damping);
    rig.scene.time_scheme = scheme;
    /* until it has fallen, swung in the bed for no more than a period, and risen */
    time_stage(&rig, 2.2 * fall + 6.28318530717959 / sqrt(k), steps);
    TimeRun run = time_open(&rig);
    double top = -INFINITY, all = 0, before = 0;
    while (cps_evolution_remaining_count(run.evolution) > 0) {
        time_step(&run);
        double energy = run.motion.kinetic;
        for (int j = 0; j < 3; j++) {
            const double z = run.view.position[3 * j + 2], part = j == 1 ? 2 : 1;
            energy += part * (mass * g * z + (z < 0 ? 0.1 * stiffness * z * z : 0));
        }
        if (run.steps == 1)
            all = before = energy;
        else if (!((energy - before) / all <= *grown))
            *grown = (energy - before) / all;
        if (scheme == CPS_TIME_SCHEME_EULER) before = energy;
        if (run.landed > 0 && run.view.position[2] > top) top = run.view.position[2];
    }
    CHECK_INT(run.certified, run.steps);
    CHECK_LESS(run.imbalance, 1e-10 * run.turnover);
    CHECK_LESS(run.lifted, 1e-11);
    CHECK_NEAR(run.impact, 0, 0);
    cps_evolution_destroy(run.evolution);
    return top / height;
}

/* How high a rope rises that leaves the bed where its force has vanished, k d + c d' = 0, by a
 * Runge and Kutta method in fine steps. */
static double risen(double height, double stiffness, double damping) {
    const double g = 9.81, k = 0.2 * stiffness / 3, c = 0.2 * damping / 3, h = 1e-6;
    double d = 0, v = sqrt(2 * g * height);
    while (d >= 0 && (v > 0 || k * d + c * v > 0)) {
        const double v1 = g - k * d - c * v, d2 = d + 0.5 * h * v, v2 = v + 0.5 * h * v1,
                     a2 = g - k * d2 - c * v2;
        d += h * v2;
        v += h * a2;
    }
    return (v * v / (2 * g) - d) / height;
}

static void what_is_dropped_rises_by_what_is_left(void **state) {
    (void)state;
    for (int damped = 0; damped < 2; damped++) {
        double grown = -INFINITY, error[3];
        const double damping = damped ? 100 : 0, exact = risen(0.5, 4e3, damping);
        for (int k = 0; k < 3; k++)
            error[k] = time_report("drop", "rises to, of the height", exact,
                                   drop(0.5, 4e3, damping, CPS_TIME_SCHEME_BDF2, 400 << k, &grown));
        CHECK_NEAR(error[2], 0, 0.01);
        CHECK_LESS(fabs(error[2]), 0.6 * fabs(error[0]));
        CHECK_LESS(grown, 1e-12);
    }
    uint64_t random = 20261128;
    double grown = -INFINITY, top = -INFINITY;
    for (int k = 0; k < 200; k++) {
        const double height = pow(10, splitmix(&random, -2, 0.5)),
                     stiffness = pow(10, splitmix(&random, 2.5, 9)),
                     damping = k % 2 ? 0 : stiffness * pow(10, splitmix(&random, -4, 0));
        const double found =
            drop(height, stiffness, damping,
                 k % 4 == 3 ? CPS_TIME_SCHEME_EULER : CPS_TIME_SCHEME_BDF2, 100, &grown);
        if (found > top) top = found;
    }
    time_report("200 drops", "growth of the energy", 0, grown);
    time_report("200 drops", "rises to, of the height, at most", 1, top);
    CHECK_LESS(grown, 1e-12);
    CHECK_LESS(top, 1 + 1e-12);
}

/* ---- it slides ---- */

/* A rope at rest in the bed is thrown along it: v^2/(2 mu g), then rest for good. */
static void a_rope_slides_in_the_bed(void **state) {
    (void)state;
    double found[2];
    for (int k = 0; k < 2; k++) {
        TimeRig rig;
        const double mass = 3, mu = 0.4, speed = 2.5;
        rope_on_bed(&rig, -mass * 9.81 / (0.2 * 4e4), 8, mass, 4e4, 100);
        rig.plane.friction = mu;
        rig.line.velocity[1] = speed;
        time_stage(&rig, 1.2, 100 << k);
        TimeRun run = time_open(&rig);
        time_steps(&run, 0);
        const double exact = speed * speed / (2 * mu * 9.81);
        found[k] = time_report("slide", "distance [m]", exact, run.view.position[1]) / exact;
        CHECK_NEAR(run.motion.velocity[1], 0, 1e-12);
        time_close(&run, "slide");
    }
    CHECK_NEAR(found[0], 0, 0.03);
    CHECK_NEAR(found[1], 0, 0.015);
}

/* ---- the rigid bed is the limit ---- */

/* A rope with one end held is lifted from the ground by the other; where it is then. */
static void draw(double stiffness, double end[3]) {
    TimeRig rig;
    const double sunk = stiffness > 0 ? 2 * 9.81 / (0.2 * stiffness) : 0;
    time_begin(&rig, 6, 12, 2, 1e4);
    time_plane(&rig, 0, 0.3);
    rig.plane.stiffness = stiffness;
    rig.plane.damping = 0.1 * stiffness;
    rig.line.bearing_width = stiffness > 0 ? 0.2 : 0;
    time_stage(&rig, 1, 100);
    time_change(&rig, CPS_END_KIND_HELD, 5.5, 0.3, 0.8);
    for (int j = 0; j <= 12; j++) time_node(&rig, j, 0.499 * j, 0, j % 12 ? -sunk : 0);
    rig.line.end[CPS_END_B] = (CpsEnd){.kind = CPS_END_KIND_AT_START};
    TimeRun run = time_open(&rig);
    time_steps(&run, 0);
    for (int a = 0; a < 3; a++) end[a] = run.view.position[3 * 9 + a];
    time_close(&run, stiffness > 0 ? "soft" : "rigid");
}

static void the_rigid_bed_is_the_limit(void **state) {
    (void)state;
    double rigid[3], soft[3], off[3];
    draw(0, rigid);
    for (int k = 0; k < 3; k++) {
        draw(pow(100, k) * 1e6, soft);
        off[k] = 0;
        for (int a = 0; a < 3; a++) off[k] = fmax(off[k], fabs(soft[a] - rigid[a]));
        time_report("limit", "node off that on rigid ground [m]", 0, off[k]);
    }
    CHECK_LESS(off[2], 1e-4);
    CHECK_LESS(off[2], 0.5 * off[0]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rope_heaves_in_the_bed),
        cmocka_unit_test(what_is_dropped_rises_by_what_is_left),
        cmocka_unit_test(a_rope_slides_in_the_bed),
        cmocka_unit_test(the_rigid_bed_is_the_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
