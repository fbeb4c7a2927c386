/* SPDX-License-Identifier: BSD-3-Clause */
/* Motions in time with friction, landing and slack, with known answers: a node that is dropped does
 * not rise again, a block on springs comes to rest for good, a rope slides so far and no farther, a
 * line that is held aside stays, statics is the limit of slow histories, and a chain whose tip
 * falls faster than freely. Each figure is printed. */
#include <stdio.h>
#include <string.h>

#include "splitmix.h"
#include "time_rig.h"

static const double PI = 3.14159265358979323846;

/* ---- drops ---- */

/* A node at the end of a slack line falls from a height, with a velocity along the plane. Returns
 * how high it is above the plane after it has landed; `grown` is by how much its energy has ever
 * grown in a step, over all of it. */
static double drop(uint64_t *random, int steps, CpsTimeScheme scheme, double *grown) {
    TimeRig rig;
    const double height = pow(10, splitmix(random, -2, 0.5)), side = splitmix(random, 0, 1);
    const double stiffness =
        splitmix(random, 0, 1) < 0.5 ? INFINITY : pow(10, splitmix(random, 2, 6));
    time_begin(&rig, 20, 1, pow(10, splitmix(random, -1, 2)), stiffness);
    rig.scene.time_scheme = scheme;
    rig.gravity = 9.81;
    time_plane(&rig, 0, splitmix(random, 0, 1));
    time_node(&rig, 1, side, 0.3, height);
    for (int a = 0; a < 2; a++) rig.line.velocity[a] = splitmix(random, -3, 3);
    const double fall = sqrt(2 * height / rig.gravity);
    time_stage(&rig, 2 * fall, steps);
    TimeRun run = time_open(&rig);
    double above = 0, all = 0, before = 0;
    while (cps_evolution_remaining_count(run.evolution) > 0) {
        const double last = run.steps ? run.view.position[5] : height;
        time_step(&run);
        const double weight = run.view.load[5];
        const double energy = run.motion.kinetic - weight * run.view.position[5];
        if (run.steps == 1)
            all = before = energy;
        else if (!((energy - before) / all <= *grown))
            *grown = (energy - before) / all;
        before = energy;
        (void)last;
        if (run.landed > 0 && run.motion.landed == 0 && !(run.view.position[5] / height <= above))
            above = run.view.position[5] / height;
    }
    CHECK_INT(run.landed, 1);
    CHECK_INT(run.certified, run.steps);
    CHECK_LESS(run.imbalance, 1e-10 * run.turnover);
    /* the approach: half its mass times the square of what it falls with, to first order in h */
    CHECK_RELATIVE(run.impact, run.view.load[5] * -height, 5.0 / steps);
    cps_evolution_destroy(run.evolution);
    return above;
}

static void what_is_dropped_does_not_rise_again(void **state) {
    (void)state;
    uint64_t random = 20261125;
    double above = 0, grown = 0;
    for (int k = 0; k < 400; k++) {
        const double found =
            drop(&random, k % 2 ? 83 : 217,
                 k % 4 == 3 ? CPS_TIME_SCHEME_EULER : CPS_TIME_SCHEME_BDF2, &grown);
        if (!(found <= above)) above = found;
    }
    time_report("400 drops", "rise after landing, of the height", 0, above);
    time_report("400 drops", "growth of the energy in a step", 0, grown);
    CHECK_LESS(above, 1e-12);
    CHECK_LESS(grown, 1e-12);
}

/* ---- block on springs ---- */

enum { TURNS = 32 };

/* A heavy node between two stretched springs on a rough plane: its turning points, which become
 * nearer to the middle by 2 mu N/k each; returns their number. */
static int block(int steps, double turn[TURNS], double *rest, double *last) {
    TimeRig rig;
    time_block(&rig);
    time_stage(&rig, 8, steps);
    TimeRun run = time_open(&rig);
    int count = 0, going = -1;
    double x = 0.2, before = 0.2, stopped = 0;
    turn[count++] = x;
    while (cps_evolution_remaining_count(run.evolution) > 0) {
        time_step(&run);
        before = x;
        x = run.view.position[3];
        if ((x - before) * going < 0 && fabs(x - before) > 1e-9) {
            /* the parabola through the last three places would be nearer; the greatest place lies
             * within (a h^2) of its top */
            if (count < TURNS) turn[count++] = before;
            going = -going;
        }
        if (run.motion.velocity[3] == 0) stopped++;
    }
    *rest = x;
    *last = fabs(x - before);
    time_report("block", "steps at rest, exactly", stopped, stopped);
    CHECK_GREATER(stopped, steps / 4);
    time_close(&run, "block");
    return count;
}

static void a_block_on_springs_comes_to_rest_for_good(void **state) {
    (void)state;
    const double k = 2 * 400, bound = 0.1 * (5 + 0.01) * 9.81;
    double worst[2] = {0, 0};
    for (int i = 0; i < 2; i++) {
        double turn[TURNS], rest, last;
        const int count = block(2000 << i, turn, &rest, &last);
        double expected = 0.2;
        int turns = 1;
        for (double sign = -1; expected > bound / k; sign = -sign, turns++) {
            if (expected - 2 * bound / k < bound / k && expected - 2 * bound / k < 0) break;
            expected -= 2 * bound / k;
            if (turns < count) {
                const double error =
                    time_report("block", "turning point [m]", sign * expected, turn[turns]);
                if (!(fabs(error) <= worst[i])) worst[i] = fabs(error);
            }
        }
        time_report("block", "place of rest [m]", (turns % 2 ? 1 : -1) * expected, rest);
        time_report("block", "last motion [m]", 0, last);
        CHECK_LESS(fabs(rest), bound / k * (1 + 1e-9));
        CHECK_NEAR(last, 0, 0);
    }
    time_report("block", "order of the turning points", 2, log2(worst[0] / worst[1]));
    CHECK_GREATER(log2(worst[0] / worst[1]), 1.7);
}

/* ---- sliding ---- */

/* A rope, straight on a rough plane, that slides along itself or across: v0^2/(2 mu g). */
static double slide(int steps, double vx, double vy, CpsTimeScheme scheme) {
    TimeRig rig;
    const double mu = 0.35, speed = hypot(vx, vy);
    const int elements = 7;
    time_begin(&rig, 3, elements, 0.8, 1e5);
    time_plane(&rig, 1, mu);
    rig.scene.time_scheme = scheme;
    rig.line.end[CPS_END_A] = rig.line.end[CPS_END_B] = (CpsEnd){.kind = CPS_END_KIND_FREE};
    for (int j = 0; j <= elements; j++) time_node(&rig, j, 3.0 * j / elements, 0, 1);
    rig.line.velocity[0] = vx;
    rig.line.velocity[1] = vy;
    const double stop = speed / (mu * rig.gravity), exact = speed * stop / 2;
    time_stage(&rig, 1.5 * stop, steps);
    TimeRun run = time_open(&rig);
    time_steps(&run, 0);
    double worst = 0;
    for (int j = 0; j <= elements; j++) {
        const double way =
            hypot(run.view.position[3 * j] - 3.0 * j / elements, run.view.position[3 * j + 1]);
        if (!(fabs(way - exact) <= fabs(worst))) worst = way - exact;
        CHECK_NEAR(hypot(run.motion.velocity[3 * j], run.motion.velocity[3 * j + 1]), 0, 1e-12);
    }
    time_report("sliding rope", "way until it stops [m]", exact, exact + worst);
    time_report("sliding rope", "energy lost by friction [J]", 0.5 * 2.4 * speed * speed, run.lost);
    time_close(&run, "sliding rope");
    return worst / exact;
}

static void a_rope_slides_its_distance(void **state) {
    (void)state;
    for (int k = 0; k < 2; k++) {
        const double along = slide(100 << k, 2, 0, CPS_TIME_SCHEME_BDF2),
                     across = slide(100 << k, 1.2, -1.6, CPS_TIME_SCHEME_BDF2),
                     euler = slide(100 << k, 2, 0, CPS_TIME_SCHEME_EULER);
        /* it stops within one step of the exact time, and the first step is an Euler step */
        CHECK_LESS(fabs(along), 3.0 / (100 << k));
        CHECK_LESS(fabs(across), 3.0 / (100 << k));
        CHECK_LESS(fabs(euler), 3.0 / (100 << k));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_dropped_does_not_rise_again),
        cmocka_unit_test(a_block_on_springs_comes_to_rest_for_good),
        cmocka_unit_test(a_rope_slides_its_distance),
    };
    (void)PI;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
