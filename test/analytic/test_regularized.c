/* SPDX-License-Identifier: BSD-3-Clause */
/* S90 section 5 and annex 4 (theorems 9.1, 9.2, result 5.6): the regularised method goes to the
 * solution of P4.2 with the rates that each parameter should show; S90 annex 5: the consistent
 * first-order problem P10.1, with and without a solution. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/regularized.h"
#include "cases.h"

enum { ELEMENTS = 200 };

static CpsRegularized *open_regularized(const CpsLineView *view) {
    CpsRegularized *regularized;
    CpsError err = {0};
    if (cps_regularized_create(view, &regularized, &err) != CPS_OK) fail_msg("%s", err.message);
    return regularized;
}

static CpsRegularizedReport solve(CpsRegularized *regularized, CpsRegularizedParameters p) {
    CpsRegularizedReport report;
    CpsError err = {0};
    if (cps_regularized_solve(regularized, &p, 2000, &report, &err) != CPS_OK)
        fail_msg("%s", err.message);
    assert_true(report.converged);
    return report;
}

/* S90 example 5.7, the first force, from a straight line (theory.md): J + j = -3.3278892 J. Frozen
 * bounds, mu = 0.0255.
 */
static void example_5_7(Case *c) {
    case_begin(c, 6.28, 800, 9.81, 10);
    case_bed(c, 0.0255);
    case_straight(c, 0, 6.28);
    c->scene.friction_policy = CPS_FRICTION_POLICY_FROZEN;
    case_force(c, 1, 0.5, 0.5, 0.5);
}

static CpsStudyRow row_of(const CpsStudy *study, CpsStudyStage stage, int from_last) {
    int last = cps_study_row_count(study) - 1;
    while (cps_study_row(study, last).stage != stage) last--;
    return cps_study_row(study, last - from_last);
}

/* Every stage to its limit. What is left at the end is known: under the part that stays down, all
 * but 0.5 N of the weight, the penalty lets the bed's reaction w sink by w/lambda, an energy w^2/(2
 * lambda) per length too low; bending from u = 0 to |u| = 1 over half an element takes (1/n)/h;
 * delta leaves at most delta times the sum of the bounds. */
static void study_of_example_5_7(void **state) {
    (void)state;
    Case c;
    example_5_7(&c);
    Run run = case_open(&c);
    CpsLineView view = case_step(&run);
    CpsRegularized *regularized = open_regularized(&view);
    CpsStudyOptions options = cps_study_options_default(regularized);
    CpsStudy *study;
    CpsError err = {0};
    assert_int_equal(cps_study_run(regularized, &options, NULL, NULL, &study, &err), CPS_OK);
    for (int i = 0; i < cps_study_row_count(study); i++)
        assert_true(cps_study_row(study, i).report.converged);

    // h: piecewise constant slopes, an energy of second order
    for (int back = 0; back < 4; back++) {
        double rate = row_of(study, CPS_STUDY_STAGE_H, back).rate_energy;
        CHECK_NEAR(show("5.7, regularised", "rate in h of the energy", 2, rate), 0, 0.05);
    }
    // lambda: penetrations are R/lambda, energies fall by R^2/(2 lambda): first order, to what the
    // next power leaves
    for (int back = 0; back < 3; back++) {
        double rate = row_of(study, CPS_STUDY_STAGE_LAMBDA, back).rate_energy;
        CHECK_NEAR(show("5.7, regularised", "rate in 1/lambda of the energy", 1, rate), 0, 0.02);
    }
    // n: x'(0) = 0 against |x'| >= 1 makes a layer at the clamped end. Under a tension T it is
    // (1/(n T))^(1/2) wide and costs T times that; once it is thinner than an element, 1/(n h)
    for (int back = 3; back < 6; back++) {
        double rate = row_of(study, CPS_STUDY_STAGE_N, back).rate_energy;
        CHECK_NEAR(show("5.7, regularised", "rate in 1/n of the energy, layer resolved", 0.5, rate),
                   0, 0.1);
    }
    CHECK_NEAR(show("5.7, regularised", "rate in 1/n of the energy, at fixed h", 1,
                    row_of(study, CPS_STUDY_STAGE_N, 0).rate_energy),
               0, 0.01);
    // delta: delta times the bound where the line sticks
    for (int back = 0; back < 3; back++) {
        double rate = row_of(study, CPS_STUDY_STAGE_DELTA, back).rate_energy;
        CHECK_NEAR(show("5.7, regularised", "rate in delta of the energy", 1, rate), 0, 0.02);
    }

    const CpsRegularizedReport last = row_of(study, CPS_STUDY_STAGE_DELTA, 0).report;
    const CpsRegularizedParameters p = row_of(study, CPS_STUDY_STAGE_DELTA, 0).parameters;
    double penalty = 9.81 * 9.81 * (6.28 - 0.5 / 9.81) / (2 * p.penalty),
           bending = p.stiffness / (6.28 / 800);
    double smoothing = p.delta * 0.0255 * 9.81 * 6.28;
    show("5.7, regularised", "J + j [J]", -3.3278892, last.total);
    // digits printed, and 1 % of the penalty's share for the uneven reaction near the tip
    CHECK_NEAR(last.total, -3.3278892 - penalty + bending, 0.01 * penalty + smoothing + 5e-8);
    CHECK_NEAR(last.penetration, 9.81 / p.penalty, 0.01 * 9.81 / p.penalty);
    CHECK_LESS(show("5.7, regularised", "tension, rms [N]", 0, last.tension_rms), 1e-5);
    CHECK_LESS(last.position_max, 1e-5);
    CHECK_LESS(last.creep, 2 * 7.1 * p.delta); /* slid/smooth < 0.99: slid < 7.02 delta */
    // bending forces (1/n)/h^2 are gone
    CHECK_LESS(last.compression, 1e-9);
    cps_study_destroy(study);
    cps_regularized_destroy(regularized);
    case_close(&run);
}

/* A history of the method by itself, each step from its own configuration and reactions, follows
 * the frozen one: Y2 and Y3 of example 5.7 have no loose slack (Y4 has), so that places agree too.
 * Steps do not sink ever deeper: (16), not (35). */
static void own_history_of_example_5_7(void **state) {
    (void)state;
    Case c;
    example_5_7(&c);
    case_force(&c, 1, 0, 0, 1);
    case_force(&c, 1, 0, 0, 0.5);
    case_force(&c, 1, 0, 0, 0);
    Run run = case_open(&c);
    CpsRegularized *last = NULL;
    for (int step = 0; step < 4; step++) {
        CpsLineView view = case_step(&run);
        CpsRegularized *next;
        CpsError err = {0};
        CpsStatus status = last ? cps_regularized_next(&view, 0.0255, last, &next, &err)
                                : cps_regularized_create(&view, &next, &err);
        if (status != CPS_OK) fail_msg("%s", err.message);
        cps_regularized_destroy(last);
        last = next;
        CpsRegularizedParameters fine = cps_regularized_fine(next);
        CpsRegularizedReport report = solve(next, fine);
        CpsRegularizedView own = cps_regularized_view(next);
        double lowest = 0, farthest = 0;
        for (int j = 0; j <= view.element_count; j++) {
            lowest = fmin(lowest, own.position[3 * (size_t)j + 2]);
            for (size_t k = 3 * (size_t)j; k < 3 * (size_t)j + 3; k++)
                farthest = fmax(farthest, fabs(own.position[k] - view.position[k]));
        }
        // tensions keep the size of one step's error; in the last, Y4, slack is loose and its place
        // one of many
        const double tension = step < 3 ? 3e-5 : 4e-5;
        CHECK_LESS(show("5.7, history by itself", "tension, rms [N]", 0, report.tension_rms),
                   tension);
        // w/lambda, and a little more at the edge of the lifted part
        CHECK_BETWEEN(lowest, -2 * 9.81 / fine.penalty, 0);
        if (step < 2) CHECK_LESS(show("5.7, history by itself", "place [m]", 0, farthest), 2e-5);
    }
    cps_regularized_destroy(last);
    case_close(&run);
}

/* Without friction (the statics of [6]) delta has nothing to smooth: any value gives the same. */
static void without_friction(void **state) {
    (void)state;
    Case c;
    case_begin(&c, 1, ELEMENTS, 1, 1);
    case_bed(&c, 0);
    case_straight(&c, 0, 1);
    case_force(&c, 1, 0.4, 0, 0.3);
    Run run = case_open(&c);
    CpsLineView view = case_step(&run);
    CpsRegularized *regularized = open_regularized(&view);
    CpsRegularizedParameters p = {.cookie = cps_regularized_parameters_default().cookie,
                                  .penalty = 1e7,
                                  .stiffness = 1e-11,
                                  .delta = 1};
    CpsRegularizedReport wide = solve(regularized, p);
    p.delta = 1e-6;
    CpsRegularizedReport narrow = solve(regularized, p);
    CHECK_NEAR(wide.friction_energy, 0, 0);
    CHECK_NEAR(wide.total, narrow.total, 1e-12);
    // the penalty alone is seen: at most w^2 l/(2 lambda) = 5e-8 J, and a clamped end of 1/(n h) =
    // 2e-9 J
    CHECK_BETWEEN(show("no friction, regularised", "J** [J]", 0, wide.energy_error), -5.2e-8, 3e-9);
    CHECK_LESS(wide.tension_max, 1e-5);
    cps_regularized_destroy(regularized);
    case_close(&run);
}

/* ---- annex 5 ---- */

typedef struct Annex {
    Case c;
    Run run;
    CpsLineView view;
    CpsRegularized *regularized;
    CpsFirstOrder *first_order;
    CpsFirstOrderReport report;
} Annex;

/* K = l = mu = 1, rho0 g = -1, x_R = a e1, and a force on end B */
static void open_annex(Annex *t, double fx, double fy, double fz) {
    case_begin(&t->c, 1, ELEMENTS, 1, 1);
    case_bed(&t->c, 1);
    case_straight(&t->c, 0, 1);
    t->c.scene.friction_policy = CPS_FRICTION_POLICY_FROZEN; /* (78) */
    case_force(&t->c, 1, fx, fy, fz);
    t->run = case_open(&t->c);
    t->view = case_step(&t->run);
    t->regularized = open_regularized(&t->view);
    CpsError err = {0};
    assert_int_equal(cps_first_order_solve(t->regularized, CPS_FIRST_ORDER_CONTACT_REFERENCE,
                                           &t->first_order, &err),
                     CPS_OK);
    t->report = cps_first_order_report(t->first_order);
}

static void close_annex(Annex *t) {
    cps_first_order_destroy(t->first_order);
    cps_regularized_destroy(t->regularized);
    case_close(&t->run);
}

/* The counter-example: f = -eta e1. The balance (90) alone has u1' = T.e1 = -(a - abar) beyond abar
 * = 1 - eta, against (86); P2.1 turns the part over with T = a - abar (test_annexes.c). Exact in
 * the lumped line with abar at a node. */
static void p10_1_without_solution(void **state) {
    (void)state;
    Annex t;
    const double eta = 0.4, h = 1.0 / ELEMENTS;
    open_annex(&t, -eta, 0, 0);
    assert_int_equal(t.report.outcome, CPS_FIRST_ORDER_OUTCOME_SHORTENS);
    CpsFirstOrderView view = cps_first_order_view(t.first_order);
    double error = 0, mirrored = 0;
    for (int i = 0; i < ELEMENTS; i++) {
        double beyond = fmax(0, view.arc_length[i] + h / 2 - (1 - eta));
        error = fmax(error, fabs(view.strain[i] + beyond));
        mirrored = fmax(mirrored, fabs(t.view.tension[i] - beyond));
    }
    // forces are met to 1e-9 of the load of 1.4 N, strains to that over K, summed along the line
    CHECK_LESS(show("annex 5, P10.1", "strain, u1' = -(a - abar)", 0, error), 1e-7);
    CHECK_LESS(show("annex 5, P2.1", "tension, T = a - abar [N]", 0, mirrored), 1e-4);
    CHECK_NEAR(show("annex 5, P10.1", "length where (86) fails [m]", eta, t.report.shortened), 0,
               1e-12);
    CHECK_NEAR(t.report.least_strain, -(eta - h / 2), 1e-7);
    CHECK_NEAR(t.report.least_strain_arc, 1 - h / 2, 1e-12);
    close_annex(&t);
}

/* Pulled instead, f = +eta e1: the line stays straight, first order is exact, and P10.1 has the
 * solution of P2.1, u = (a - abar)^2/2 beyond abar. */
static void p10_1_with_solution(void **state) {
    (void)state;
    Annex t;
    const double eta = 0.4;
    open_annex(&t, eta, 0, 0);
    assert_int_equal(t.report.outcome, CPS_FIRST_ORDER_OUTCOME_SOLVED);
    CpsFirstOrderView view = cps_first_order_view(t.first_order);
    double error = 0;
    for (int j = 0; j <= ELEMENTS; j++) {
        double beyond = fmax(0, view.arc_length[j] - (1 - eta));
        error = fmax(error, fabs(view.displacement[3 * j] - beyond * beyond / 2));
    }
    CHECK_LESS(show("annex 5, pulled", "displacement [m]", 0, error), 1e-7);
    CHECK_LESS(show("annex 5, pulled", "P10.1 less P2.1 [m]", 0, t.report.against_step), 1e-6);
    close_annex(&t);
}

/* A force across a slack end: (84) has no tension across t_R there. Up, 0.3 less half an element's
 * weight; sideways, 0.3 less half an element's friction. P2.1 lifts or turns the end. */
static void p10_1_across_a_slack_end(void **state) {
    (void)state;
    const double h = 1.0 / ELEMENTS;
    for (int up = 0; up < 2; up++) {
        Annex t;
        open_annex(&t, 0, up ? 0 : 0.3, up ? 0.3 : 0);
        assert_int_equal(t.report.outcome, CPS_FIRST_ORDER_OUTCOME_UNBALANCED);
        // displacements that run away to 1e7 m leave rounding of 1e-7 of the force
        CHECK_NEAR(t.report.unbalanced[up ? 2 : 1], 0.3 - h / 2, 1e-3);
        CHECK_NEAR(t.report.unbalanced_arc, 1, 0);
        close_annex(&t);
    }
}

/* Across a slack end by less than half an element can carry, w h/2 = mu w h/2 = 0.0025 N, or pushed
 * by as much: the lumped line has a solution, and (87) has none, T(l) = df being along t_R and >=
 * 0. */
static void p10_1_of_the_mesh_alone(void **state) {
    (void)state;
    const double h = 1.0 / ELEMENTS, f = 0.4 * h,
                 force[][3] = {{0, f, 0}, {0, 0, f}, {-f, 0, 0}, {f, 0, 0}, {0, 0, -f}};
    for (int k = 0; k < 5; k++) {
        Annex t;
        open_annex(&t, force[k][0], force[k][1], force[k][2]);
        // pulled along, or pressed onto the bed: a solution of the continuum too
        assert_int_equal(t.report.outcome,
                         k < 3 ? CPS_FIRST_ORDER_OUTCOME_MESH : CPS_FIRST_ORDER_OUTCOME_SOLVED);
        for (int c = 0; c < 3; c++)
            CHECK_NEAR(t.report.unbalanced[c], k < 3 ? force[k][c] : 0, 1e-15);
        CHECK_NEAR(t.report.unbalanced_arc, k < 3 ? 1 : 0, 0);
        close_annex(&t);
    }
}

/* Which C: a tip that hangs in the air by one node, held up by the end force, and is let down. (77)
 * asks nothing of a node that does not touch at the reference, and lets it through the bed; (16) at
 * every node stops it there. */
static void p10_1_with_either_contact(void **state) {
    (void)state;
    Case c;
    case_begin(&c, 1, ELEMENTS, 1, 1);
    case_bed(&c, 1);
    case_straight(&c, 0, 1);
    c.scene.friction_policy = CPS_FRICTION_POLICY_FROZEN;
    case_force(&c, 1, 0.5, 0, 0.1);
    case_force(&c, 1, 0.5, 0, 0);
    Run run = case_open(&c);
    case_step(&run);
    CpsLineView view = case_step(&run);
    CpsRegularized *regularized = open_regularized(&view);
    double lowest[2] = {0, 0};
    for (int reached = 0; reached < 2; reached++) {
        CpsFirstOrder *solution;
        CpsError err = {0};
        const CpsFirstOrderContact contact =
            reached ? CPS_FIRST_ORDER_CONTACT_REACHED : CPS_FIRST_ORDER_CONTACT_REFERENCE;
        assert_int_equal(cps_first_order_solve(regularized, contact, &solution, &err), CPS_OK);
        assert_int_equal(cps_first_order_report(solution).contact, contact);
        assert_int_equal(cps_first_order_report(solution).outcome, CPS_FIRST_ORDER_OUTCOME_SOLVED);
        const CpsFirstOrderView u = cps_first_order_view(solution);
        for (int j = 0; j <= ELEMENTS; j++)
            lowest[reached] =
                fmin(lowest[reached], view.reference[3 * j + 2] + u.displacement[3 * j + 2]);
        cps_first_order_destroy(solution);
    }
    CHECK_LESS(show("P10.1, (77)", "lowest node [m]", -0.01, lowest[0]), 0);
    CHECK_BETWEEN(lowest[1], -1e-6, 0);
    cps_regularized_destroy(regularized);
    case_close(&run);
}

/* From a taut reference P10.1 is the linearisation of P2.1: their difference is of second order in
 * the perturbation. The first step pulls the line off a smooth bed, the second changes the force by
 * a little. (On a rough bed the first step's friction, frozen, acts on the lifted line and is gone
 * in the second, so that the reference is no equilibrium of the second.) */
static void p10_1_is_the_first_order(void **state) {
    (void)state;
    double difference[2];
    for (int level = 0; level < 2; level++) {
        Annex t;
        const double size = level ? 1e-3 : 1e-2;
        case_begin(&t.c, 1, ELEMENTS, 1, 1);
        case_bed(&t.c, 0);
        case_straight(&t.c, 0, 1);
        case_force(&t.c, 1, 1, 0, 2);
        case_force(&t.c, 1, 1 + size, 2 * size, 2 - size);
        t.run = case_open(&t.c);
        case_step(&t.run);
        t.view = case_step(&t.run);
        t.regularized = open_regularized(&t.view);
        CpsError err = {0};
        assert_int_equal(cps_first_order_solve(t.regularized, CPS_FIRST_ORDER_CONTACT_REFERENCE,
                                               &t.first_order, &err),
                         CPS_OK);
        t.report = cps_first_order_report(t.first_order);
        assert_int_equal(t.report.outcome, CPS_FIRST_ORDER_OUTCOME_SOLVED);
        CHECK_NEAR(t.report.slack, 0, 0);
        difference[level] = t.report.against_step;
        close_annex(&t);
    }
    // log10 of their quotient, 2 but for the third-order term of a perturbation of 1e-2
    double order10 = log10(difference[0] / difference[1]);
    CHECK_NEAR(show("P10.1 from a taut reference", "order of its error", 2, order10), 0, 0.05);
}

/* S90 example 11.3 with consistent friction: the paper's only equilibrium, x = (a + a^2/2) e3, T =
 * a (exact in the lumped line), which frozen friction does not have (test_annexes.c). */
static void example_11_3_consistent(void **state) {
    (void)state;
    Case c;
    case_begin(&c, 1, ELEMENTS, 1, 1);
    case_bed(&c, 0.4);
    case_straight(&c, 0, 1);
    c.scene.friction_policy = CPS_FRICTION_POLICY_CONSISTENT;
    case_force(&c, 1, 0, 0, 1);
    Run run = case_open(&c);
    CpsLineView view = case_step(&run);
    double place = 0, tension = 0;
    for (int j = 0; j <= ELEMENTS; j++) {
        const double *x = &view.position[3 * (size_t)j], a = view.arc_length[j];
        place = fmax(place, fmax(hypot(x[0], x[1]), fabs(x[2] - a - a * a / 2)));
        if (j > 0) tension = fmax(tension, fabs(view.tension[j - 1] - (a - 0.5 / ELEMENTS)));
    }
    CHECK_LESS(show("example 11.3, consistent", "place [m]", 0, place),
               run.motion_error * sqrt(ELEMENTS) + 1e-12);
    CHECK_LESS(show("example 11.3, consistent", "tension [N]", 0, tension),
               run.tension_error * sqrt(ELEMENTS) + 1e-12);
    case_close(&run);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(study_of_example_5_7),     cmocka_unit_test(own_history_of_example_5_7),
        cmocka_unit_test(without_friction),         cmocka_unit_test(p10_1_without_solution),
        cmocka_unit_test(p10_1_with_solution),      cmocka_unit_test(p10_1_across_a_slack_end),
        cmocka_unit_test(p10_1_of_the_mesh_alone),  cmocka_unit_test(p10_1_with_either_contact),
        cmocka_unit_test(p10_1_is_the_first_order), cmocka_unit_test(example_11_3_consistent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
