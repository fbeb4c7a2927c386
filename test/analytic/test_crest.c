/* SPDX-License-Identifier: BSD-3-Clause */
/* A weight on a string pulled over the crest of a drum: the position where it leaves the drum, and
 * that it does not leave before.
 *
 * One inextensible element of 1 m and 2 N, half of it at B; A moves along x at height 1.2 m, the
 * drum has radius 1 m about the y axis. While B lies on the drum and slides, |A - B| = |B| = 1 m
 * place it at the angle
 *
 *     theta = atan(a/h) - acos(sqrt(a^2 + h^2)/2)
 *
 * from the crest, a = x_A. At theta = atan(mu) the weight slides by itself; the string no longer
 * holds it, and B falls to its hanging position, (a, h - 1). That is then the only stable position:
 * for equilibrium on the drum beyond it the string would have to push B. */
#include "rig.h"

static const double HEIGHT = 1.2, LENGTH = 1, WEIGHT = 1;

static double theta_of(double a) { return atan2(a, HEIGHT) - acos(0.5 * hypot(a, HEIGHT)); }

/* x_A where B is at theta on the drum, A ahead of it */
static double a_of(double theta) {
    const double up = HEIGHT - cos(theta);
    return sin(theta) + sqrt(1 - up * up);
}

/* Draw A from where B is at `from` to x_A = `to`; `snaps`: jumps that are reported, of `jump`. */
static void draw(const char *name, double mu, double from, double to, int steps,
                 double path_tolerance, int expected) {
    static Rig rig;
    const double start = a_of(from), limit = a_of(atan(mu));
    rig_begin(&rig, 1, 2 * WEIGHT, INFINITY);
    rig_length(&rig, LENGTH);
    rig.scene.solver.path_tolerance = path_tolerance;
    rig_obstacle(&rig, CPS_OBSTACLE_CYLINDER, mu);
    rig_point(&rig, start, 0, HEIGHT);
    rig_point(&rig, sin(from), 0, cos(from));
    rig_end(&rig, CPS_END_A, CPS_END_KIND_HELD, start, 0, HEIGHT);
    rig_stage(&rig, steps);
    rig_change(&rig, CPS_END_A, CPS_END_KIND_HELD, to, 0, HEIGHT);
    RigRun run = rig_open(&rig);
    int snaps = 0;
    double worst = 0, before = start, least = 0;
    for (int k = 1; k <= steps; k++) {
        const CpsLineView view = rig_step(&run);
        const double a = start + (to - start) * k / steps, theta = theta_of(a);
        const bool on = a < limit;
        /* the string is taut to rounding, and the surface met to 1e-10 of the length */
        worst =
            fmax(worst, fabs(view.position[3] - (on ? sin(theta) : a)) + fabs(view.position[4]));
        worst = fmax(worst, fabs(view.position[5] - (on ? cos(theta) : HEIGHT - LENGTH)));
        const CpsStepReport report = cps_evolution_report(run.evolution);
        least = fmin(least, report.ledger.imbalance);
        if (path_tolerance > 0) CHECK_INT(report.jump_count, !on && before < limit);
        /* the length of the jump, from a place within a part of 2^-10 of the step before the limit
         */
        if (report.jump_count > 0) {
            const double away = hypot(limit - sin(atan(mu)), HEIGHT - LENGTH - cos(atan(mu)));
            rig_show(name, "jump [m]", away, report.jump);
            CHECK_NEAR(report.jump, away, 1e-3);
        }
        snaps += report.jump_count;
        before = a;
    }
    rig_show(name, "worst place [m]", 0, worst);
    rig_show(name, "least imbalance [J]", 0, least);
    CHECK_LESS(worst, 1e-8);
    /* no energy from nowhere: the ledger is open by the trapezium rule's error, at most (W/2) times
     * the square of a step's displacement */
    CHECK_GREATER(least, -0.5 * WEIGHT * pow((to - start) / steps, 2) - 1e-12);
    CHECK_INT(snaps, expected);
    rig_close(&run);
}

static void smooth(void **state) {
    (void)state;
    draw("smooth drum, 20 steps", 0, -0.52, 1.5, 20, 0, 0);
    draw("smooth drum, 100 steps", 0, -0.52, 1.5, 100, 0, 0);
}

static void rough(void **state) {
    (void)state;
    draw("mu = 0.5, 20 steps", 0.5, 0, 2, 20, 0, 0);
    draw("mu = 0.2, 50 steps", 0.2, -0.4, 2, 50, 0, 0);
}

static void reported(void **state) {
    (void)state;
    draw("smooth, path tolerance 1e-3", 0, -0.52, 1.5, 10, 1e-3, 1);
    draw("mu = 0.5, path tolerance 1e-3", 0.5, 0, 2, 10, 1e-3, 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(smooth),
        cmocka_unit_test(rough),
        cmocka_unit_test(reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
