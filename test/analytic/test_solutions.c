/* SPDX-License-Identifier: BSD-3-Clause */
/* S90 results 4.3 and 4.4, theorem 6.3, corollary 6.4 and formula (55): configurations judged with known energies, and
 * slack laid out. */
#include <stdio.h>
#include <string.h>

#include "capstan/solutions.h"
#include "cases.h"

enum { ELEMENTS = 100, COORDINATES = 3 * (ELEMENTS + 1) };

static const double TOLERANCE = 1e-8;

typedef struct Bench {
    Case c;
    Run run;
    CpsLineView view;
    double position[COORDINATES];
} Bench;

static CpsJudgementReport judge(Bench *b) {
    CpsJudgementReport report;
    CpsError err = {0};
    if (cps_solution_judge(&b->view, b->position, TOLERANCE, &report, &err) != CPS_OK) fail_msg("%s", err.message);
    // the three gaps are never negative: they are sums of squares
    CHECK_BETWEEN(report.tension, 0, INFINITY);
    CHECK_BETWEEN(report.contact, 0, INFINITY);
    CHECK_BETWEEN(report.sliding, 0, INFINITY);
    return report;
}

static CpsSlackReport complete(Bench *b, CpsCompletion how) {
    CpsSlackReport report;
    CpsError err = {0};
    if (cps_solution_complete(&b->view, how, b->position, &report, &err) != CPS_OK) fail_msg("%s", err.message);
    return report;
}

static void take_own(Bench *b) { memcpy(b->position, b->view.position, sizeof b->position); }

/* K = l = rho0 g = 1 on a bed; end B somewhere on it by force or held */
static void open_bench(Bench *b, double mu, double stiffness) {
    case_begin(&b->c, 1, ELEMENTS, 1, stiffness);
    case_bed(&b->c, mu);
    case_straight(&b->c, 0, 1);
    b->c.scene.friction = CPS_FRICTION_FROZEN;
}

static void solve_bench(Bench *b) {
    b->run = case_open(&b->c);
    b->view = case_step(&b->run);
    take_own(b);
}

/* A slack line on a smooth bed, its ends at half its length: the chain that P4.2 returns is outside Kin; the tent and
 * the meander are in it, solve P3.1, and have no more energy. All of it is loose. */
static void slack_on_a_smooth_bed(void **state) {
    (void)state;
    for (int inextensible = 0; inextensible < 2; inextensible++) {
        Bench b;
        open_bench(&b, 0, inextensible ? INFINITY : 1);
        case_move(&b.c, 1, 0.5, 0.1, 0);
        solve_bench(&b);
        CpsJudgementReport own = judge(&b);
        assert_int_equal(own.judgement, CPS_JUDGED_RELAXED);
        CHECK_GREATER(own.shortening, 0.3);
        for (CpsCompletion how = CPS_COMPLETION_TENT; how <= CPS_COMPLETION_MEANDER; how++) {
            CpsSlackReport slack = complete(&b, how);
            CHECK_NEAR(slack.slack, 1, 1e-12);
            CHECK_NEAR(slack.loose, 1, 1e-12);
            CHECK_NEAR(slack.left, 0, 0);
            CHECK_INT(slack.parts, 1);
            CpsSlackPart part;
            CHECK_INT(cps_solution_slack(&b.view, 1, &part), 1);
            CHECK_NEAR(part.to - part.from, 1, 1e-12);
            assert_true(part.loose && part.grounded);
            CpsJudgementReport laid = judge(&b);
            assert_int_equal(laid.judgement, CPS_JUDGED_SOLUTION);
            // positions of order 1 to rounding, over elements of 0.01
            CHECK_LESS(show("slack laid out", "1 - |x'|", 0, laid.shortening), 1e-12);
            CHECK_LESS(show("slack laid out", "energy above the minimum [J]", 0, laid.energy), 1e-9);
        }
        case_close(&b.run);
    }
}

/* An odd number of elements between ends that meet: no two sides close, a third one does. */
static void slack_between_ends_that_meet(void **state) {
    (void)state;
    Bench b;
    open_bench(&b, 0, 1);
    b.c.line.elements = 7;
    case_move(&b.c, 1, 0.05, 0, 0);
    b.run = case_open(&b.c);
    b.view = case_step(&b.run);
    for (CpsCompletion how = CPS_COMPLETION_TENT; how <= CPS_COMPLETION_MEANDER; how++) {
        CpsSlackReport slack = complete(&b, how);
        CHECK_NEAR(slack.left, 0, 0);
        CpsJudgementReport laid = judge(&b);
        assert_int_equal(laid.judgement, CPS_JUDGED_SOLUTION);
        CHECK_LESS(laid.shortening, 1e-12);
    }
    case_close(&b.run);
}

/* The same with one node lifted: the tensions are still those of the solution, its own (55), but the bed pushed there.
 * The energy is the weight's, R z. Proposition 7.4 as printed would let it pass. */
static void lifted_loop(void **state) {
    (void)state;
    Bench b;
    open_bench(&b, 0, 1);
    case_move(&b.c, 1, 0.5, 0, 0);
    solve_bench(&b);
    const double z = 0.004; /* less than slack elements of 0.01 over 0.005 can reach: no tension */
    const int node = 3 * 40;
    b.position[node + 2] += z;
    CpsJudgementReport report = judge(&b);
    assert_int_equal(report.judgement, CPS_JUDGED_CONTACT);
    CHECK_NEAR(show("lifted loop", "energy, w h z [J]", z / ELEMENTS, report.contact), 0, 1e-9);
    CHECK_NEAR(report.energy, report.contact, 1e-9);
    CHECK_NEAR(report.arc_length, 0.40, 1e-12);
    case_close(&b.run);
}

/* S90 annex 5: T = 0 up to abar and still only one solution, for |phi| < A holds it (against "unique only if T > 0",
 * result 4.4 (ii)). Moved aside it costs A |u|; and there is nothing to lay out. */
static void slack_held_by_friction(void **state) {
    (void)state;
    Bench b;
    open_bench(&b, 1, 1);
    case_force(&b.c, 1, -0.4, 0, 0);
    solve_bench(&b);
    assert_int_equal(judge(&b).judgement, CPS_JUDGED_SOLUTION);
    CpsSlackReport slack = complete(&b, CPS_COMPLETION_MEANDER);
    CHECK_NEAR(show("annex 5", "slack, abar [m]", 0.6, slack.slack), 0, 1.5 / ELEMENTS);
    CpsSlackPart part;
    CHECK_INT(cps_solution_slack(&b.view, 1, &part), 1);
    assert_false(part.loose);
    CHECK_NEAR(part.from, 0, 0);
    CHECK_NEAR(part.to, slack.slack, 1e-12);
    CHECK_NEAR(slack.loose, 0, 0);
    CHECK_NEAR(slack.held, slack.slack, 1e-12);
    CHECK_INT(slack.parts, 0);

    // node 30 along the line by a thousandth: the elements beside it stay below their length or stretch by 0.1
    const double u = 1e-6;
    take_own(&b);
    b.position[3 * 30 + 1] += u;
    CpsJudgementReport report = judge(&b);
    // too little for the tolerance of 1e-8 of the scale 0.5 J: A h u = 1e-8 J
    CHECK_NEAR(report.sliding, u / ELEMENTS, 1e-9);
    b.position[3 * 30 + 1] += 9 * u;
    report = judge(&b);
    assert_int_equal(report.judgement, CPS_JUDGED_SLIDING);
    CHECK_NEAR(report.arc_length, 0.30, 1e-12);
    case_close(&b.run);
}

/* Other tensions, in energies known: pulled along the bed by H with T = K e = H (mu = 0), shortened by a part s
 * everywhere: J rises by l (K/2) s^2. The lumped tension is constant. */
static void other_tensions(void **state) {
    (void)state;
    Bench b;
    open_bench(&b, 0, 1);
    case_force(&b.c, 1, 0.5, 0, 0);
    solve_bench(&b);
    assert_int_equal(judge(&b).judgement, CPS_JUDGED_SOLUTION);
    const double s = 0.1;
    for (int j = 0; j <= ELEMENTS; j++) b.position[3 * j] -= s * j / ELEMENTS;
    CpsJudgementReport report = judge(&b);
    assert_int_equal(report.judgement, CPS_JUDGED_TENSION);
    CHECK_NEAR(show("other tensions", "energy, K s^2/2 [J]", s * s / 2, report.energy), 0, 1e-8);

    // turned by an angle in the plane: F (1 + T/K) l (1 - cos)
    take_own(&b);
    const double angle = 0.2;
    for (int j = 0; j <= ELEMENTS; j++) {
        double x = b.position[3 * j];
        b.position[3 * j] = x * cos(angle);
        b.position[3 * j + 1] = x * sin(angle);
    }
    report = judge(&b);
    assert_int_equal(report.judgement, CPS_JUDGED_TENSION);
    CHECK_NEAR(show("turned", "energy, F L (1 - cos) [J]", 0.5 * 1.5 * (1 - cos(angle)), report.energy), 0, 1e-8);
    case_close(&b.run);
}

/* Outside C, and a held end elsewhere. */
static void outside_the_constraints(void **state) {
    (void)state;
    Bench b;
    open_bench(&b, 0.3, 1);
    case_force(&b.c, 1, 0.5, 0, 0);
    solve_bench(&b);
    b.position[3 * 20 + 2] = -0.001;
    CpsJudgementReport report = judge(&b);
    assert_int_equal(report.judgement, CPS_JUDGED_PENETRATES);
    CHECK_NEAR(report.penetration, 0.001, 1e-9);
    CHECK_NEAR(report.arc_length, 0.20, 1e-12);
    take_own(&b);
    b.position[1] = 0.01;
    report = judge(&b);
    assert_int_equal(report.judgement, CPS_JUDGED_ENDS);
    CHECK_NEAR(report.end_error, 0.01, 1e-12);
    case_close(&b.run);
}

/* The sum of gaps is J** + j at y less the minimum, whatever y in C (3): against the energies themselves, at a made-up
 * y. */
static void gaps_are_the_energy(void **state) {
    (void)state;
    Bench b;
    open_bench(&b, 0.3, 1);
    case_force(&b.c, 1, 0.5, 0.2, 0.1);
    solve_bench(&b);
    double energy = -cps_evolution_report(b.run.evolution).certificate.primal;
    for (int j = 1; j <= ELEMENTS; j++) {
        double *x = &b.position[3 * j];
        x[0] += 0.02 * sin(1.7 * j), x[1] += 0.02 * cos(0.9 * j), x[2] += 0.01 * (1 + sin(j));
    }
    for (int i = 0; i < ELEMENTS; i++) {
        const double *x = &b.position[3 * i];
        double stretch = sqrt(pow(x[3] - x[0], 2) + pow(x[4] - x[1], 2) + pow(x[5] - x[2], 2)) * ELEMENTS;
        energy += pow(fmax(0, stretch - 1), 2) / 2 / ELEMENTS;
    }
    for (int j = 0; j <= ELEMENTS; j++) {
        const double *x = &b.position[3 * j], *r = &b.view.reference[3 * j], *f = &b.view.load[3 * j];
        energy += b.view.friction_bound[j] * hypot(x[0] - r[0], x[1] - r[1]) - f[0] * x[0] - f[1] * x[1] - f[2] * x[2];
    }
    CpsJudgementReport report = judge(&b);
    assert_int_not_equal(report.judgement, CPS_JUDGED_SOLUTION);
    // the step's own gap, at most 1e-8 of its scale
    CHECK_NEAR(show("gaps and energy", "J** + j above the minimum [J]", energy, report.energy), 0, 1e-8);
    case_close(&b.run);
}

static void refused(void **state) {
    (void)state;
    Bench b;
    open_bench(&b, 0, 1);
    case_force(&b.c, 1, 0.5, 0, 0);
    solve_bench(&b);
    CpsJudgementReport report;
    CpsError err;
    assert_int_equal(cps_solution_judge(&b.view, b.position, 0, &report, &err), CPS_ERR_ARGUMENT);
    assert_int_equal(cps_solution_judge(&b.view, NULL, 1e-8, &report, &err), CPS_ERR_ARGUMENT);
    b.position[7] = NAN;
    assert_int_equal(cps_solution_judge(&b.view, b.position, 1e-8, &report, &err), CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "node 2"));
    assert_int_equal(cps_solution_complete(&b.view, (CpsCompletion)7, b.position, NULL, &err), CPS_ERR_ARGUMENT);
    case_close(&b.run);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slack_on_a_smooth_bed), cmocka_unit_test(slack_between_ends_that_meet),
        cmocka_unit_test(lifted_loop),           cmocka_unit_test(slack_held_by_friction),
        cmocka_unit_test(other_tensions),        cmocka_unit_test(outside_the_constraints),
        cmocka_unit_test(gaps_are_the_energy),   cmocka_unit_test(refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
