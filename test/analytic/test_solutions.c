/* SPDX-License-Identifier: BSD-3-Clause */
/* S90 results 4.3 and 4.4, theorem 6.3, corollary 6.4 and formula (55): configurations judged with
 * known energies, and slack laid out. */
#include <stdio.h>
#include <string.h>

#include "capstan/evolve.h"
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
    if (cps_solution_judge(&b->view, b->position, TOLERANCE, &report, &err) != CPS_OK)
        fail_msg("%s", err.message);
    // the three gaps are never negative: they are sums of squares
    CHECK_BETWEEN(report.tension, 0, INFINITY);
    CHECK_BETWEEN(report.contact, 0, INFINITY);
    CHECK_BETWEEN(report.sliding, 0, INFINITY);
    return report;
}

static CpsSlackReport complete(Bench *b, CpsCompletion how) {
    CpsSlackReport report;
    CpsError err = {0};
    if (cps_solution_complete(&b->view, how, b->position, &report, &err) != CPS_OK)
        fail_msg("%s", err.message);
    return report;
}

static void take_own(Bench *b) { memcpy(b->position, b->view.position, sizeof b->position); }

/* K = l = rho0 g = 1 on a bed; end B somewhere on it by force or held */
static void open_bench(Bench *b, double mu, double stiffness) {
    case_begin(&b->c, 1, ELEMENTS, 1, stiffness);
    case_bed(&b->c, mu);
    case_straight(&b->c, 0, 1);
    b->c.scene.friction_policy = CPS_FRICTION_POLICY_FROZEN;
}

static void solve_bench(Bench *b) {
    b->run = case_open(&b->c);
    b->view = case_step(&b->run);
    take_own(b);
}

/* A slack line on a smooth bed, its ends at half its length: the chain of least motion is outside
 * Kin, near B, which has gone aside; the tent and the meander are in it, solve P3.1, and have no
 * more energy. All of it is loose. */
static void slack_on_a_smooth_bed(void **state) {
    (void)state;
    for (int inextensible = 0; inextensible < 2; inextensible++) {
        Bench b;
        open_bench(&b, 0, inextensible ? INFINITY : 1);
        case_move(&b.c, 1, 0.5, 0.1, 0);
        solve_bench(&b);
        CpsJudgementReport own = judge(&b);
        assert_int_equal(own.judgement, CPS_JUDGEMENT_RELAXED);
        CHECK_GREATER(own.shortening, 0.1);
        for (CpsCompletion how = CPS_COMPLETION_SHORTEST; how < CPS_COMPLETION_COUNT; how++) {
            CpsSlackReport slack = complete(&b, how);
            CHECK_NEAR(slack.slack, 1, 1e-12);
            CHECK_NEAR(slack.loose, 1, 1e-12);
            CHECK_NEAR(slack.left, 0, 0);
            CHECK_INT(slack.part_count, 1);
            CpsSlackPart part;
            CHECK_INT(cps_solution_slack(&b.view, 1, &part), 1);
            CHECK_NEAR(part.to - part.from, 1, 1e-12);
            assert_true(part.loose && part.grounded);
            CpsJudgementReport laid = judge(&b);
            assert_int_equal(laid.judgement, CPS_JUDGEMENT_SOLUTION);
            // positions of order 1 to rounding, over elements of 0.01
            CHECK_LESS(show("slack laid out", "1 - |x'|", 0, laid.shortening), 1e-12);
            CHECK_LESS(show("slack laid out", "energy above the minimum [J]", 0, laid.energy),
                       1e-9);
        }
        case_close(&b.run);
    }
}

/* An odd number of elements between ends that meet: no two sides close, a third one does. */
static void slack_between_ends_that_meet(void **state) {
    (void)state;
    Bench b;
    open_bench(&b, 0, 1);
    b.c.line.element_count = 7;
    case_move(&b.c, 1, 0.05, 0, 0);
    b.run = case_open(&b.c);
    b.view = case_step(&b.run);
    for (CpsCompletion how = CPS_COMPLETION_SHORTEST; how < CPS_COMPLETION_COUNT; how++) {
        CpsSlackReport slack = complete(&b, how);
        CHECK_NEAR(slack.left, 0, 0);
        CpsJudgementReport laid = judge(&b);
        assert_int_equal(laid.judgement, CPS_JUDGEMENT_SOLUTION);
        CHECK_LESS(laid.shortening, 1e-12);
    }
    case_close(&b.run);
}

/* Laid out in each shape, by the program: C, |x'| and the place of the ends are looked at node by
 * node, on the bed z = 0. */
static void check_laid(Bench *b, bool closes) {
    for (CpsCompletion how = CPS_COMPLETION_SHORTEST; how < CPS_COMPLETION_COUNT; how++) {
        CpsSlackReport slack = complete(b, how);
        CHECK_BETWEEN(slack.left, closes ? 0 : 0.1, closes ? 0 : 1);
        assert_int_equal(judge(b).judgement,
                         closes ? CPS_JUDGEMENT_SOLUTION : CPS_JUDGEMENT_RELAXED);
        if (closes)
            for (int i = 0; i < b->view.element_count; i++) {
                const double *x = &b->position[3 * i];
                double length =
                    sqrt(pow(x[3] - x[0], 2) + pow(x[4] - x[1], 2) + pow(x[5] - x[2], 2));
                CHECK_BETWEEN(length / b->view.element_length[i], 1 - 1e-9, INFINITY);
                CHECK_BETWEEN(x[2], -1e-12, INFINITY);
                // what the bed carries stays on it; 1e-9 N is far below a node's weight of 0.01 N
                if (i > 0 && b->view.reaction[i] > 1e-9) CHECK_BETWEEN(x[2], -1e-12, 1e-9);
            }
        const int tip = 3 * b->view.element_count;
        for (int k = 0; k < 3; k++) {
            CHECK_NEAR(b->position[k], b->view.position[k], 0);
            CHECK_NEAR(b->position[tip + k], b->view.position[tip + k], 0);
        }
    }
}

/* An end held above a smooth bed: by less than an element, which comes down without tension, and by
 * so much that some hang. */
static void slack_below_a_lifted_end(void **state) {
    (void)state;
    const double height[] = {0.005, 0.0099, 0.3};
    for (int k = 0; k < 3; k++) {
        Bench b;
        open_bench(&b, 0, k == 2 ? 1 : INFINITY);
        case_move(&b.c, 1, 0.5, 0.1, height[k]);
        solve_bench(&b);
        check_laid(&b, true);
        case_close(&b.run);
    }
}

/* Elements of uneven length: two sides need not close, three do; and where one element is longer
 * than all others and the chord nothing does. */
static void slack_of_uneven_elements(void **state) {
    (void)state;
    static const double MESH[][6] = {{0.3, 0.01, 0.29, 0.1, 0.25, 0.05},
                                     {0.02, 0.04, 0.08, 0.16, 0.32, 0.38},
                                     {0.08, 0.08, 0.08, 0.1, 0.12, 0.54},
                                     {0.1, 0.02, 0.62, 0.06, 0.1, 0.1}};
    const double chord[] = {0.003, 0.001, 0.52, 0.2};
    for (int k = 0; k < 4; k++) {
        Bench b;
        open_bench(&b, 0, 1);
        b.c.line.element_count = 6;
        b.c.line.element_length = MESH[k];
        case_move(&b.c, 1, chord[k], 0, 0);
        solve_bench(&b);
        check_laid(&b, k < 3);
        case_close(&b.run);
    }
}

/* Straight at its length between two held ends on a smooth bed: without tension, and nothing can
 * move. */
static void straight_slack(void **state) {
    (void)state;
    Bench b;
    open_bench(&b, 0, 1);
    case_move(&b.c, 1, 1, 0, 0);
    solve_bench(&b);
    CpsSlackPart part;
    CHECK_INT(cps_solution_slack(&b.view, 1, &part), 1);
    assert_false(part.loose);
    case_close(&b.run);
}

/* The scale of a judgement is that of the certificate, (5). */
static void scale_of_a_judgement(void **state) {
    (void)state;
    Bench b;
    open_bench(&b, 0.3, 1);
    case_force(&b.c, 1, 0.5, 0.2, 0.1);
    solve_bench(&b);
    const double scale = cps_evolution_line_report(b.run.evolution, 0).certificate.scale;
    CHECK_NEAR(judge(&b).scale, scale, 1e-12 * scale);
    case_close(&b.run);
}

/* The same with one node lifted: the tensions are still those of the solution, its own (55), but
 * the bed pushed there. The energy is the weight's, R z. Proposition 7.4 as printed would let it
 * pass. */
static void lifted_loop(void **state) {
    (void)state;
    Bench b;
    open_bench(&b, 0, 1);
    case_move(&b.c, 1, 0.5, 0, 0);
    solve_bench(&b);
    for (int j = 0; j <= ELEMENTS; j++)
        b.position[3 * j] = 0.5 * j / ELEMENTS; /* a chain, evenly shortened */
    const double z = 0.004; /* less than slack elements of 0.01 over 0.005 can reach: no tension */
    const int node = 3 * 40;
    b.position[node + 2] += z;
    CpsJudgementReport report = judge(&b);
    assert_int_equal(report.judgement, CPS_JUDGEMENT_CONTACT);
    CHECK_NEAR(show("lifted loop", "energy, w h z [J]", z / ELEMENTS, report.contact), 0, 1e-9);
    CHECK_NEAR(report.energy, report.contact, 1e-9);
    CHECK_NEAR(report.arc_length, 0.40, 1e-12);
    case_close(&b.run);
}

/* S90 annex 5: T = 0 up to abar and still only one solution, for |phi| < A holds it (against
 * "unique only if T > 0", result 4.4 (ii)). Moved aside it costs A |u|; and there is nothing to lay
 * out. */
static void slack_held_by_friction(void **state) {
    (void)state;
    Bench b;
    open_bench(&b, 1, 1);
    case_force(&b.c, 1, -0.4, 0, 0);
    solve_bench(&b);
    assert_int_equal(judge(&b).judgement, CPS_JUDGEMENT_SOLUTION);
    CpsSlackReport slack = complete(&b, CPS_COMPLETION_MEANDER);
    CHECK_NEAR(show("annex 5", "slack, abar [m]", 0.6, slack.slack), 0, 1.5 / ELEMENTS);
    CpsSlackPart part;
    CHECK_INT(cps_solution_slack(&b.view, 1, &part), 1);
    assert_false(part.loose);
    CHECK_NEAR(part.from, 0, 0);
    CHECK_NEAR(part.to, slack.slack, 1e-12);
    CHECK_NEAR(slack.loose, 0, 0);
    CHECK_NEAR(slack.held, slack.slack, 1e-12);
    CHECK_INT(slack.part_count, 0);

    assert_true(part.has_friction && !part.sliding && part.grounded);
    // a made-up friction force at its bound: the elements beside it are straight at their length,
    // and hold node 30
    static double own_friction[COORDINATES], shorter[COORDINATES];
    memcpy(own_friction, b.view.friction_force, sizeof own_friction);
    own_friction[3 * 30 + 1] = b.view.friction_bound[30];
    CpsLineView made_up = b.view;
    made_up.friction_force = own_friction;
    CHECK_INT(cps_solution_slack(&made_up, 1, &part), 1);
    assert_true(part.at_bound && !part.sliding);
    // and where they are short it may slide on
    for (int k = 0; k < COORDINATES; k++) shorter[k] = 0.9 * b.view.position[k];
    made_up.position = shorter;
    CHECK_INT(cps_solution_slack(&made_up, 1, &part), 1);
    assert_true(part.sliding);

    // node 30 along the line by a thousandth: the elements beside it stay below their length or
    // stretch by 0.1
    const double u = 1e-6;
    take_own(&b);
    b.position[3 * 30 + 1] += u;
    CpsJudgementReport report = judge(&b);
    // too little for the tolerance of 1e-8 of the scale 0.5 J: A h u = 1e-8 J
    CHECK_NEAR(report.sliding, u / ELEMENTS, 1e-9);
    b.position[3 * 30 + 1] += 9 * u;
    report = judge(&b);
    assert_int_equal(report.judgement, CPS_JUDGEMENT_SLIDING);
    CHECK_NEAR(report.arc_length, 0.30, 1e-12);
    case_close(&b.run);
}

/* Other tensions, in energies known: pulled along the bed by H with T = K e = H (mu = 0), shortened
 * by a part s everywhere: J rises by l (K/2) s^2. The lumped tension is constant. */
static void other_tensions(void **state) {
    (void)state;
    Bench b;
    open_bench(&b, 0, 1);
    case_force(&b.c, 1, 0.5, 0, 0);
    solve_bench(&b);
    assert_int_equal(judge(&b).judgement, CPS_JUDGEMENT_SOLUTION);
    const double s = 0.1;
    for (int j = 0; j <= ELEMENTS; j++) b.position[3 * j] -= s * j / ELEMENTS;
    CpsJudgementReport report = judge(&b);
    assert_int_equal(report.judgement, CPS_JUDGEMENT_TENSION);
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
    assert_int_equal(report.judgement, CPS_JUDGEMENT_TENSION);
    CHECK_NEAR(show("turned", "energy, F L (1 - cos) [J]", 0.5 * 1.5 * (1 - cos(angle)),
                    report.energy),
               0, 1e-8);
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
    assert_int_equal(report.judgement, CPS_JUDGEMENT_PENETRATES);
    CHECK_NEAR(report.penetration, 0.001, 1e-9);
    CHECK_NEAR(report.arc_length, 0.20, 1e-12);
    take_own(&b);
    b.position[1] = 0.01;
    report = judge(&b);
    assert_int_equal(report.judgement, CPS_JUDGEMENT_ENDS);
    CHECK_NEAR(report.end_error, 0.01, 1e-12);
    case_close(&b.run);
}

/* The sum of gaps is J** + j at y less the minimum, whatever y in C (3): against the energies
 * themselves, at a made-up y. */
static void gaps_are_the_energy(void **state) {
    (void)state;
    Bench b;
    open_bench(&b, 0.3, 1);
    case_force(&b.c, 1, 0.5, 0.2, 0.1);
    solve_bench(&b);
    double energy = -cps_evolution_report(b.run.evolution).certificate.primal;
    for (int j = 1; j <= ELEMENTS; j++) {
        double *x = &b.position[3 * j];
        x[0] += 0.02 * sin(1.7 * j);
        x[1] += 0.02 * cos(0.9 * j);
        x[2] += 0.01 * (1 + sin(j));
    }
    for (int i = 0; i < ELEMENTS; i++) {
        const double *x = &b.position[3 * i];
        double stretch =
            sqrt(pow(x[3] - x[0], 2) + pow(x[4] - x[1], 2) + pow(x[5] - x[2], 2)) * ELEMENTS;
        energy += pow(fmax(0, stretch - 1), 2) / 2 / ELEMENTS;
    }
    for (int j = 0; j <= ELEMENTS; j++) {
        const double *x = &b.position[3 * j], *r = &b.view.reference[3 * j],
                     *f = &b.view.load[3 * j];
        energy += b.view.friction_bound[j] * hypot(x[0] - r[0], x[1] - r[1]) - f[0] * x[0] -
                  f[1] * x[1] - f[2] * x[2];
    }
    CpsJudgementReport report = judge(&b);
    assert_int_not_equal(report.judgement, CPS_JUDGEMENT_SOLUTION);
    // the step's own gap, at most 1e-8 of its scale
    CHECK_NEAR(show("gaps and energy", "J** + j above the minimum [J]", energy, report.energy), 0,
               1e-8);
    case_close(&b.run);
}

/* The three shapes: to and fro stays on the chord, by less than an element; straight pieces are
 * straight, half the length each; and a meander goes to both sides. */
static void shapes_of_completion(void **state) {
    (void)state;
    Bench b;
    open_bench(&b, 0, 1);
    case_move(&b.c, 1, 0.6, 0, 0);
    solve_bench(&b);
    const double h = 1.0 / ELEMENTS;
    complete(&b, CPS_COMPLETION_SHORTEST);
    for (int j = 0; j <= ELEMENTS; j++) {
        CHECK_BETWEEN(b.position[3 * j], -h, 0.6 + h);
        CHECK_BETWEEN(b.position[3 * j + 1], -h, h);
    }
    // sides 0.5, 0.5, chord 0.6: the corner is at (0.3, 0.4)
    complete(&b, CPS_COMPLETION_STRAIGHT);
    CHECK_NEAR(b.position[3 * 50], 0.3, 1e-12);
    CHECK_NEAR(fabs(b.position[3 * 50 + 1]), 0.4, 1e-12);
    CHECK_NEAR(b.position[3 * 25], 0.15, 1e-12);
    // one element up by 0.8 h, one down, all the way
    complete(&b, CPS_COMPLETION_MEANDER);
    for (int j = 0; j <= ELEMENTS; j++)
        CHECK_NEAR(fabs(b.position[3 * j + 1]), j % 2 ? 0.8 * h : 0, 1e-12);
    case_close(&b.run);
}

/* Pulled taut on a smooth bed, then let go: nothing holds the end. "Straight" lays the line on from
 * A at its length. */
static void loose_end(void **state) {
    (void)state;
    Bench b;
    open_bench(&b, 0, 1);
    case_force(&b.c, 1, 0.3, 0.1, 0);
    case_force(&b.c, 1, 0, 0, 0);
    solve_bench(&b);
    b.view = case_step(&b.run);
    CpsSlackPart part;
    CHECK_INT(cps_solution_slack(&b.view, 1, &part), 1);
    assert_true(part.loose && part.grounded && !part.has_friction);
    for (CpsCompletion how = CPS_COMPLETION_SHORTEST; how < CPS_COMPLETION_COUNT; how++) {
        complete(&b, how);
        assert_int_equal(judge(&b).judgement, CPS_JUDGEMENT_SOLUTION);
        const double *tip = &b.position[3 * ELEMENTS];
        if (how == CPS_COMPLETION_STRAIGHT) CHECK_NEAR(hypot(tip[0], tip[1]), 1, 1e-12);
    }
    case_close(&b.run);
}

/* Remark 7.10.1, K infinite: P4.2 has |x'| <= 1 and the tension is its multiplier. The
 * configuration, here straight at rest, may be unique and the tension field not (against result 4.4
 * (i) carried over): pulled by 0.4 N on a bed that can hold 1 N/m, friction may take it near the
 * tip or evenly all along. Both fields balance, and both prove x. */
static void inextensible_tensions(void **state) {
    (void)state;
    Bench b;
    open_bench(&b, 1, INFINITY);
    case_force(&b.c, 1, 0.4, 0, 0);
    solve_bench(&b);
    static double force[3 * ELEMENTS], own_friction[COORDINATES];
    for (int field = 0; field < 2; field++) {
        double tension = 0.4;
        for (int i = ELEMENTS - 1; i >= 0; i--) {
            // node i + 1 first: what friction takes there, never beyond its bound
            const double bound = b.view.friction_bound[i + 1];
            const double taken = field ? 0.4 * bound : fmin(bound, tension);
            own_friction[3 * (i + 1)] = -taken;
            tension -= taken;
            force[3 * i] = tension;
        }
        b.view.segment_force = force;
        b.view.friction_force = own_friction;
        CpsJudgementReport report = judge(&b);
        assert_int_equal(report.judgement, CPS_JUDGEMENT_SOLUTION);
        // at 0.5 m: 0, or 0.4 N less 0.4 of the half of the line beyond
        CHECK_NEAR(show("K infinite, two fields", "tension at 0.5 m [N]", field ? 0.2 : 0,
                        force[3 * 50]),
                   0, 0.005);
        CHECK_LESS(show("K infinite, two fields", "gap of x [J]", 0, report.energy), 1e-9);
    }
    case_close(&b.run);
}

/* the outcome of the first step, and how much its proof shows */
static CpsOutcome outcome_of(const Case *c, double *proof) {
    CpsEvolution *evolution;
    CpsError err = {0};
    if (cps_evolution_create(&c->scene, &evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    assert_int_equal(cps_evolution_step(evolution, &err), CPS_OK);
    const CpsLineReport line = cps_evolution_line_report(evolution, 0);
    *proof = line.outcome == CPS_OUTCOME_INFEASIBLE ? line.proof_length : line.proof_force;
    cps_evolution_destroy(evolution);
    return line.outcome;
}

/* Remark 7.5.3: what is coercive has a minimum, and the rest is told apart. Elastic and held at A:
 * always. No end held and pulled by more than friction bears: unbounded. Inextensible and held too
 * far apart: nothing to minimise over. */
static void existence(void **state) {
    (void)state;
    double proof;
    Bench b;
    open_bench(&b, 0.3, 1);
    case_force(&b.c, 1, 3, 0, 2);
    assert_int_equal(outcome_of(&b.c, &proof), CPS_OUTCOME_SOLVED);

    open_bench(&b, 0.3, 1);
    b.c.line.end[CPS_END_A] = (CpsEnd){.kind = CPS_END_KIND_FREE};
    case_force(&b.c, 1, 0.5, 0, 0);
    assert_int_equal(outcome_of(&b.c, &proof), CPS_OUTCOME_UNBOUNDED);
    CHECK_NEAR(show("no end held", "fall, f - mu w l [N]", 0.2, proof), 0, 0.3 / ELEMENTS + 1e-9);

    open_bench(&b, 0.3, INFINITY);
    case_move(&b.c, 1, 1.2, 0, 0);
    assert_int_equal(outcome_of(&b.c, &proof), CPS_OUTCOME_INFEASIBLE);
    CHECK_NEAR(show("too far apart", "excess [m]", 0.2, proof), 0, 1e-9);
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
    assert_int_equal(cps_solution_judge(&b.view, b.position, 1e-8, &report, &err),
                     CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "node 2"));
    assert_int_equal(cps_solution_complete(&b.view, (CpsCompletion)7, b.position, NULL, &err),
                     CPS_ERR_ARGUMENT);
    case_close(&b.run);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slack_on_a_smooth_bed),
        cmocka_unit_test(slack_between_ends_that_meet),
        cmocka_unit_test(slack_below_a_lifted_end),
        cmocka_unit_test(slack_of_uneven_elements),
        cmocka_unit_test(straight_slack),
        cmocka_unit_test(scale_of_a_judgement),
        cmocka_unit_test(lifted_loop),
        cmocka_unit_test(slack_held_by_friction),
        cmocka_unit_test(other_tensions),
        cmocka_unit_test(outside_the_constraints),
        cmocka_unit_test(gaps_are_the_energy),
        cmocka_unit_test(shapes_of_completion),
        cmocka_unit_test(loose_end),
        cmocka_unit_test(inextensible_tensions),
        cmocka_unit_test(existence),
        cmocka_unit_test(refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
