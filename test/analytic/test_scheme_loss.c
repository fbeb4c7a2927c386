/* SPDX-License-Identifier: BSD-3-Clause */
/* What the schemes in time lose of a smooth motion, beside what theory says (docs/theory.md 9).
 *
 * Put a smooth motion into the formulas. With the derivative d by time, Euler's method has d - h
 * d^2/2 and the formula of second order d - h^2 d^3/3 + h^3 d^4/4 in place of d. Of the terms
 * beyond d the odd ones change the phase, and the even ones take energy. Of an oscillator of the
 * rate w and the energy U that is
 *
 *     Euler   U w^2 h,      BDF2   U w^4 h^3/2      a second,
 *
 * over whole periods, for within one the energy swings by U (w h)^2. The ledger's entry `scheme`
 * adds up to it. Each figure is printed. */
#include <stdio.h>

#include "time_rig.h"

static const double PI = 3.14159265358979323846;
enum { PERIODS = 4 };

/* The loss in PERIODS periods after a first one, of a mass on a spring, in so many steps a period,
 * as a share of the energy that there was. */
static double loss(CpsTimeScheme scheme, int steps) {
    TimeRig rig;
    const double length = 2, mass = 3, stiffness = 4e4, pull = 2000, a = 0.02,
                 rate = sqrt(stiffness / length / (0.5 * mass * length)), period = 2 * PI / rate;
    time_begin(&rig, length, 1, mass, stiffness);
    rig.scene.gravity[2] = rig.line.weight = 0;
    rig.scene.time_scheme = scheme;
    rig.line.end[CPS_END_B] = (CpsEnd){.kind = CPS_END_KIND_FREE, .value = {pull, 0, 0}};
    time_node(&rig, 1, length * (1 + pull / stiffness) + a, 0, 0);
    time_stage(&rig, (1 + PERIODS) * period, (1 + PERIODS) * steps);
    TimeRun run = time_open(&rig);
    time_steps(&run, steps);
    const double off = run.view.position[3] - length * (1 + pull / stiffness),
                 energy = 0.5 * stiffness / length * off * off + run.motion.kinetic,
                 before = run.scheme;
    time_steps(&run, 0);
    const double lost = (run.scheme - before) / energy, w = rate * period / steps,
                 theory = PERIODS * steps * (scheme ? w * w : 0.5 * w * w * w * w);
    char name[48];
    snprintf(name, sizeof name, "%s, %d steps a period", scheme ? "Euler" : "BDF2", steps);
    time_report(name, "share of the energy lost", theory, lost);
    time_close(&run, name);
    return lost / theory;
}

static void the_loss_has_the_order_of_theory(void **state) {
    (void)state;
    for (int scheme = 0; scheme < 2; scheme++) {
        double share[4];
        for (int k = 0; k < 4; k++)
            share[k] = loss((CpsTimeScheme)scheme, (scheme ? 2000 : 50) << k);
        const double order = (scheme ? 1 : 3) + log2(share[2] / share[3]);
        time_report(scheme ? "Euler" : "BDF2", "order of the loss", scheme ? 1 : 3, order);
        CHECK_NEAR(order, scheme ? 1 : 3, 0.1);
        CHECK_RELATIVE(share[3], 1, 0.02);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_loss_has_the_order_of_theory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
