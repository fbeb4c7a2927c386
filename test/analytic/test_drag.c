/* SPDX-License-Identifier: BSD-3-Clause */
/* A straight elastic line on a rough bed, pulled along itself: closed forms of drag and of
 * microslip.
 *
 * Pulled by H < mu w L the line slides over the length H/(mu w), the tension falls linearly to 0
 * there and the tip moves H^2/(2 mu w K); a change of the pull by D after that slides back over
 * D/(2 mu w) and moves the tip D^2/(4 mu w K) (Masing). With everything lumped at the nodes the
 * tension of an element is the exact tension at its middle, so that the tip differs only in the one
 * element where sliding ends: at most mu w h^2/(8 K), whatever the load. */
#include <stdio.h>

#include "cases.h"

static const double LENGTH = 100, WEIGHT = 10, FRICTION = 0.5, STIFFNESS = 2e3;

static double tip(const CpsLineView *view) {
    return view->position[3 * (size_t)view->element_count];
}

/* largest difference between the elements' forces and the exact tension at their middles, away from
 * where sliding ends
 */
static double tension_error(const CpsLineView *view, double pull) {
    double worst = 0, density = FRICTION * WEIGHT;
    for (size_t i = 0; i < (size_t)view->element_count; i++) {
        double h = view->element_length[i], middle = view->arc_length[i] + h / 2;
        double exact = fmax(0, pull - density * (LENGTH - middle));
        if (exact > 0 && exact < density * h) continue;
        worst = fmax(worst, fabs(view->segment_force[3 * i] - exact));
    }
    return worst;
}

static void drag(double pull, int elements, int steps) {
    Case c;
    case_begin(&c, LENGTH, elements, WEIGHT, STIFFNESS);
    case_bed(&c, FRICTION);
    case_straight(&c, 0, LENGTH);
    case_force(&c, steps, pull, 0, 0);
    case_force(&c, steps, pull / 4, 0, 0);
    Run run = case_open(&c);
    CpsLineView view = {0};
    for (int k = 0; k < steps; k++) view = case_step(&run);

    // loading
    double density = FRICTION * WEIGHT, h = LENGTH / elements, slip = fmin(LENGTH, pull / density);
    double motion = (pull * slip - density * slip * slip / 2) / STIFFNESS,
           end = density * h * h / (8 * STIFFNESS);
    char name[64];
    snprintf(name, sizeof name, "drag %g N, N = %d, %d steps", pull, elements, steps);
    double error = show(name, "tip motion [m]", motion, tip(&view) - LENGTH);
    CHECK_LESS(fabs(error), end + run.motion_error);
    CHECK_LESS(show(name, "error of the tension [N]", 0, tension_error(&view, pull)),
               run.tension_error * sqrt(elements));
    double slipping = cps_evolution_line_report(run.evolution, 0).slipping;
    if (steps == 1) CHECK_NEAR(show(name, "slip length [m]", slip, slipping), 0, 1.01 * h);

    // unloading by three quarters
    for (int k = 0; k < steps; k++) view = case_step(&run);
    double change = 0.75 * pull, back = change * change / (4 * density * STIFFNESS);
    if (change / (2 * density) <= LENGTH) {
        error = show(name, "tip after unloading [m]", motion - back, tip(&view) - LENGTH);
        CHECK_LESS(fabs(error), 3 * end + run.motion_error);
        if (steps == 1) {
            slipping = cps_evolution_line_report(run.evolution, 0).slipping;
            CHECK_NEAR(show(name, "reverse slip length [m]", change / (2 * density), slipping), 0,
                       1.01 * h);
        }
    }
    case_close(&run);
}

static void straight_drag(void **state) {
    (void)state;
    drag(237.5, 97, 1);
    drag(237.5, 400, 1);
    drag(237.5, 400, 7);
    drag(620, 97, 1); // beyond mu w L = 500 N: the whole line slides
}

/* pretension, then cycles of the end force between base - swing and base + swing: the loss of a
 * closed cycle */
static double cycle(double pretension, double high, double low, int elements, int steps,
                    double *amplitude, double *loss_error, double *motion_error) {
    Case c;
    case_begin(&c, LENGTH, elements, WEIGHT, STIFFNESS);
    case_bed(&c, FRICTION);
    case_straight(&c, 0, LENGTH * (1 + pretension / STIFFNESS));
    case_force(&c, 1, pretension, 0, 0);
    case_force(&c, steps, high, 0, 0);
    case_force(&c, steps, low, 0, 0);
    case_force(&c, steps, high, 0, 0);
    Run run = case_open(&c);
    case_step(&run);
    CpsLineView view = {0};
    for (int k = 0; k < steps; k++) view = case_step(&run);
    double upper = tip(&view);
    run.dissipated = run.motion_error = 0;
    for (int k = 0; k < steps; k++) view = case_step(&run);
    *amplitude = upper - tip(&view);
    for (int k = 0; k < steps; k++) view = case_step(&run);
    *motion_error = run.motion_error;
    *loss_error = 2 * FRICTION * WEIGHT * LENGTH * run.motion_error;
    // what is at rest is found to a few parts in 1e9 of the length in each substep of the loop
    const double closing = show("microslip", "tip after the cycle [m]", upper, tip(&view));
    CHECK_NEAR(closing, 0, fmin(*motion_error, 2 * steps * CPS_TOUCH * LENGTH));
    double loss = run.dissipated;
    case_close(&run);
    return loss;
}

/* loss 2F^3/(3 EA mu w) about a pretension, F^3/(12 EA mu w) between 0 and F; the swing of the tip
 * is F^2/(EA mu w) from -F to F and F^2/(4 EA mu w) from 0 to F. Errors come from the element where
 * sliding ends: order 2 in h. */
static void microslip(const char *name, double pretension, double high, double low, double loss) {
    double density = FRICTION * WEIGHT, swing = high - low,
           exact = swing * swing / (4 * density * STIFFNESS), amplitude, loss_error, motion_error;
    for (int steps = 1; steps <= 5; steps += 4) {
        for (int n = 100; n <= 400; n *= 4) {
            double found = cycle(pretension, high, low, n, steps, &amplitude, &loss_error,
                                 &motion_error),
                   h = LENGTH / n;
            char figure[64];
            snprintf(figure, sizeof figure, "loss, N = %d, %d steps [J]", n, steps);
            double error = show(name, figure, loss, found);
            /* Relative to the sliding length s = swing/(2 mu w): the sum over nodes is the
             * trapezium rule of (s - x)^2, too large by (h/s)^2/2 of its integral; where sliding
             * ends within an element nodes slide up to h^2/8 less, in units where s^2/2 is the
             * tip's way, which takes up to 3 (h/s)^2/4 off again. */
            double part = h * 2 * density / swing;
            CHECK_BETWEEN(error, -part * part / 4 * loss - loss_error,
                          part * part / 2 * loss + loss_error);
            snprintf(figure, sizeof figure, "swing, N = %d, %d steps [m]", n, steps);
            CHECK_LESS(fabs(show(name, figure, exact, amplitude)),
                       part * part / 4 * exact + motion_error);
        }
    }
}

static void microslip_under_pretension(void **state) {
    (void)state;
    double force = 213, density = FRICTION * WEIGHT;
    microslip("microslip, pretension", 300, 300 + force, 300 - force,
              2 * pow(force, 3) / (3 * STIFFNESS * density));
}

static void microslip_of_a_slack_line(void **state) {
    (void)state;
    double force = 213, density = FRICTION * WEIGHT;
    microslip("microslip, slack", 0, force, 0, pow(force, 3) / (12 * STIFFNESS * density));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(straight_drag),
        cmocka_unit_test(microslip_under_pretension),
        cmocka_unit_test(microslip_of_a_slack_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
