/* SPDX-License-Identifier: BSD-3-Clause */
/* S90 annex 5 and the counter-examples of annex 6, all with K = l = 1, rho0 g = -1, a plane bed z =
 * 0; and the chain of small links of remark 2.3.5. */
#include <stdio.h>
#include <stdlib.h>

#include "cases.h"
#include "measure.h"

enum { ELEMENTS = 200 };

static void unit_line(Case *c, double friction, double x_to) {
    case_begin(c, 1, ELEMENTS, 1, 1);
    c->scene.friction_policy = CPS_FRICTION_POLICY_FROZEN; /* the annexes speak of P2.1 */
    case_bed(c, friction);
    case_straight(c, 0, x_to);
}

static double force(const CpsLineView *view, int element) {
    const double *p = &view->segment_force[3 * (size_t)element];
    return sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
}

/* Annex 5: a straight line without tension, mu = 1, its end pushed back by f = -eta e1. P10.1 has
 * no solution; the one of P2.1 (the printed formula is lost) follows from d(T t)/da + phi = 0: near
 * the tip t = -e1 and the line moves along -e1, so that phi = +e1 and T' = 1, T(1) = eta. Hence T =
 * a - abar, abar = 1 - eta, x' = -(1 + T) e1:
 *   x = a e1 up to abar,   x = [abar - (a - abar) - (a - abar)^2/2] e1 beyond.
 * In the discrete line the fold lies at a node or inside an element, which misplaces the part
 * beyond by up to 2 h. */
static void annex_5(void **state) {
    (void)state;
    Case c;
    const double eta = 0.6175, abar = 1 - eta, h = 1.0 / ELEMENTS;
    unit_line(&c, 1, 1);
    case_force(&c, 1, -eta, 0, 0);
    Run run = case_open(&c);
    CpsLineView view = case_step(&run);
    double place = 0, rest = 0, tension = 0;
    for (int j = 0; j <= ELEMENTS; j++) {
        double a = view.arc_length[j], b = fmax(0, a - abar), x = fmin(a, abar) - b - b * b / 2;
        double error = fabs(view.position[3 * (size_t)j] - x);
        if (a < abar - h) rest = fmax(rest, error);
        if (a >= abar - h) place = fmax(place, error);
    }
    for (int i = 0; i < ELEMENTS; i++) {
        double middle = view.arc_length[i] + h / 2, exact = fmax(0, middle - abar);
        if (fabs(middle - abar) > h) tension = fmax(tension, fabs(force(&view, i) - exact));
    }
    // sign of the friction: +e1 near the tip
    double friction = view.friction_force[3 * (size_t)(ELEMENTS - 1)] / h;
    CHECK_NEAR(show("annex 5", "friction near the tip [N/m]", 1, friction), 0, 1e-4);
    CHECK_LESS(show("annex 5", "place, part that rests [m]", 0, rest), run.motion_error + 1e-12);
    CHECK_LESS(show("annex 5", "place, part folded back [m]", 0, place), 2 * h);
    CHECK_LESS(show("annex 5", "tension [N]", 0, tension),
               run.tension_error * sqrt(ELEMENTS) + 1e-12);
    case_close(&run);
}

/* Example 11.1: the part beyond abar stands upright over the bed, no force; contact as S90 (35), so
 * that it falls through. Printed is T = 0, which cannot carry the hanging part: P2.1 gives T = 1 -
 * a beyond abar, and the tip at -(L + L^2/2), L = 1 - abar. Exact in the lumped line (tension
 * linear, midpoint rule). */
static void example_11_1(void **state) {
    (void)state;
    Case c;
    const double abar = 0.5, part = 1 - abar, h = 1.0 / ELEMENTS;
    unit_line(&c, 0.3, 1);
    case_corner(&c, abar);
    c.scene.contact_policy = CPS_CONTACT_POLICY_REFERENCE;
    case_force(&c, 1, 0, 0, 0);
    case_force(&c, 1, 0, 0, 0);
    case_force(&c, 1, 0, 0, -0.5);
    Run run = case_open(&c);
    CpsLineView view = case_step(&run);
    double tension = 0;
    for (int i = ELEMENTS / 2; i < ELEMENTS; i++) {
        tension = fmax(tension, fabs(force(&view, i) - (1 - view.arc_length[i] - h / 2)));
    }
    const double *tip = &view.position[3 * ELEMENTS];
    CHECK_LESS(show("example 11.1", "tension, T = l - a [N]", 0, tension),
               run.tension_error * sqrt(ELEMENTS) + 1e-12);
    CHECK_NEAR(show("example 11.1", "height of the tip [m]", -part - part * part / 2, tip[2]), 0,
               run.motion_error);
    // what is below touches nothing and stays free: nothing changes, and a pull stretches it on by
    // f L/K
    view = case_step(&run);
    tip = &view.position[3 * ELEMENTS];
    CHECK_NEAR(show("example 11.1, again", "height of the tip [m]", -part - part * part / 2,
                    tip[2]),
               0, run.motion_error);
    view = case_step(&run);
    tip = &view.position[3 * ELEMENTS];
    CHECK_NEAR(show("example 11.1, pulled down", "height of the tip [m]",
                    -part - part * part / 2 - 0.5 * part, tip[2]),
               0, run.motion_error);
    case_close(&run);
}

/* Example 11.2: x_R = -a e1 and f = mu e1 + e3 turn the line over: x = [a + mu sec(theta) a^2/2] t,
 * T = mu sec(theta) a, with t = (cos, 0, sin) theta, theta = arctan(1/mu), phi = -mu e1. R = 0 all
 * along and T = 0 at a = 0, where sliding, lifting and slack begin together: the tolerance is what
 * the certificate guarantees, no more. */
static void example_11_2(void **state) {
    (void)state;
    Case c;
    const double mu = 0.4, theta = atan(1 / mu), slope = mu / cos(theta), h = 1.0 / ELEMENTS;
    unit_line(&c, mu, -1);
    case_force(&c, 1, mu, 0, 1);
    Run run = case_open(&c);
    CpsLineView view = case_step(&run);
    double tension = 0, place = 0, reaction = 0;
    for (int i = 0; i < ELEMENTS; i++) {
        tension = fmax(tension, fabs(force(&view, i) - slope * (view.arc_length[i] + h / 2)));
    }
    for (int j = 0; j <= ELEMENTS; j++) {
        double a = view.arc_length[j], along = a + slope * a * a / 2;
        const double *x = &view.position[3 * (size_t)j];
        place = fmax(place, hypot(x[0] - along * cos(theta), x[2] - along * sin(theta)));
        if (j > 0) reaction = fmax(reaction, view.reaction[j]);
    }
    CHECK_LESS(show("example 11.2", "tension [N]", 0, tension), run.tension_error * sqrt(ELEMENTS));
    CHECK_LESS(show("example 11.2", "place [m]", 0, place), run.motion_error * sqrt(ELEMENTS));
    // R is bounded by the tensions on its two sides
    CHECK_LESS(show("example 11.2", "reaction [N]", 0, reaction),
               2 * run.tension_error * sqrt(ELEMENTS));
    case_close(&run);
}

/* the printed configuration of example 11.3 as a record for the checker's arithmetic */
static Record printed_11_3(const CpsLineView *view) {
    size_t n = ELEMENTS + 1;
    Record r = {.nodes = n,
                .elements = ELEMENTS,
                .contacts = 1,
                .compliance = 1,
                .least_compliance = 1,
                .largest_compliance = 1,
                .end_kind = {END_HELD, END_FREE},
                .held_position = {{0, 0, 0}, {NAN, NAN, NAN}},
                .applied_force = {{NAN, NAN, NAN}, {0, 0, 1}}};
    Vector **vector[] = {&r.reference, &r.position, &r.load,         &r.normal,
                         &r.friction,  &r.slip,     &r.segment_force};
    double **scalar[] = {&r.element_compliance,
                         &r.element_length,
                         &r.gap,
                         &r.friction_bound,
                         &r.reaction,
                         &r.tension,
                         &r.mu,
                         &r.turn,
                         &r.obstacle};
    for (size_t k = 0; k < sizeof vector / sizeof *vector; k++)
        assert_non_null(*vector[k] = calloc(n, sizeof(Vector)));
    for (size_t k = 0; k < sizeof scalar / sizeof *scalar; k++)
        assert_non_null(*scalar[k] = calloc(n, sizeof(double)));
    double h = 1.0 / ELEMENTS;
    for (size_t j = 0; j < n; j++) {
        double a = view->arc_length[j];
        r.reference[j][0] = a;
        r.position[j][2] = a + a * a / 2;
        r.load[j][2] = view->load[3 * j + 2];
        r.normal[j][2] = 1;
        r.friction_bound[j] = view->friction_bound[j];
    }
    for (size_t i = 0; i < ELEMENTS; i++) {
        r.element_length[i] = h;
        r.element_compliance[i] = 1;
        r.segment_force[i][2] = r.tension[i] = view->arc_length[i] + h / 2;
    }
    return r;
}

/* Example 11.3: f = e3, x_R = a e1. The true equilibrium x = (a + a^2/2) e3, T = a e3, phi = 0
 * balances, but slides by u_T = -a e1 against no friction: the law is violated by the work mu a, in
 * all mu/2 (lumping is exact for a linear field). It is refused; the step has another solution,
 * with a lower J + j, which is certified. */
static void example_11_3(void **state) {
    (void)state;
    Case c;
    const double mu = 0.4;
    unit_line(&c, mu, 1);
    case_force(&c, 1, 0, 0, 1);
    Run run = case_open(&c);
    CpsLineView view = case_step(&run);
    Record printed = printed_11_3(&view);
    Surface bed = {.kind = SURFACE_PLANE, .axis = {0, 0, 1}, .mu = {mu, mu}};
    const Source source = {.surfaces = 1, .surface = &bed};
    Measures m = measure(&source, &printed, SIGHT_REFERENCE);
    CpsCertificate own = cps_evolution_report(run.evolution).certificate;
    assert_null(m.missing);
    CHECK_LESS(show("example 11.3, printed", "imbalance of forces [N]", 0, m.force), 1e-14);
    CHECK_NEAR(show("example 11.3, printed", "law residual [J]", mu / 2, m.law), 0, 1e-14);
    CHECK_GREATER(show("example 11.3, printed", "gap / scale", 0, m.gap / m.scale), 0.01);
    CHECK_GREATER(show("example 11.3", "J + j, printed and own [J]", own.primal, m.primal), 0.01);
    show("example 11.3", "gap / scale of the own solution", 0, own.gap / own.scale);
    record_destroy(&printed);
    case_close(&run);
}

/* Remark 2.3.5: a chain of small links has T = 0 for |x'| <= 1. Ends at half its length apart on a
 * smooth bed: the relaxed problem is that of the chain, without tension and without energy, at any
 * stretch up to 1. */
static void chain_of_small_links(void **state) {
    (void)state;
    Case c;
    unit_line(&c, 0, 1);
    case_move(&c, 1, 0.5, 0, 0);
    Run run = case_open(&c);
    CpsLineView view = case_step(&run);
    double tension = 0, stretch = 0;
    for (int i = 0; i < ELEMENTS; i++) {
        const double *x = &view.position[3 * (size_t)i];
        double length = sqrt(pow(x[3] - x[0], 2) + pow(x[4] - x[1], 2) + pow(x[5] - x[2], 2));
        tension = fmax(tension, force(&view, i));
        stretch = fmax(stretch, length * ELEMENTS - 1);
    }
    CHECK_LESS(show("chain, slack", "tension [N]", 0, tension), run.tension_error * sqrt(ELEMENTS));
    CHECK_LESS(show("chain, slack", "largest |x'| - 1", 0, stretch),
               run.tension_error * sqrt(ELEMENTS));
    case_close(&run);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(annex_5),
        cmocka_unit_test(example_11_1),
        cmocka_unit_test(example_11_2),
        cmocka_unit_test(example_11_3),
        cmocka_unit_test(chain_of_small_links),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
