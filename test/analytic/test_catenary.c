/* SPDX-License-Identifier: BSD-3-Clause */
/* Hanging lines: elastic and inextensible catenary between held ends, and a mooring line on a
 * frictionless bed. */
#include <stdio.h>

#include "cases.h"
#include "catenary.h"

static double first_tension(const CpsLineView *view) {
    const double *p = view->segment_force;
    return hypot(hypot(p[0], p[1]), p[2]);
}

/* The OC3-Hywind line: 902.2 m, 698.094 N/m, EA 384.243 MN, anchor to fairlead 848.67 m by 250
 * m. */
static double laid_anchor_tension(int elements) {
    Case c;
    case_begin(&c, 902.2, elements, 698.094, 384.243e6);
    case_bed(&c, 0);
    case_laid(&c, 848.67, 250);
    Run run = case_open(&c);
    CpsLineView view = case_step(&run);
    double tension = first_tension(&view);
    case_close(&run);
    return tension;
}

/* Touchdown falls between nodes, so the error stays under C h^2 without falling smoothly; C = 1 for
 * h = 1/N, in units of H, is 1.6 times the largest N^2 |error| that was found. */
static void mooring_line_on_the_bed(void **state) {
    (void)state;
    Catenary exact = {.length = 902.2,
                      .weight = 698.094,
                      .stiffness = 384.243e6,
                      .bed = true,
                      .h = 5e5,
                      .v = 4e5};
    assert_true(catenary_solve(&exact, 848.67, 250));
    CHECK_NEAR(show("OC3 line, laid", "own Newton against 736938.32 N", 736938.32, exact.h), 0,
               0.005);
    CHECK_NEAR(show("OC3 line, laid", "vertical force [N]", 535727.45, exact.v), 0, 0.005);
    static const int ELEMENTS[] = {50, 100, 200, 400, 800, 1600};
    for (size_t k = 0; k < sizeof ELEMENTS / sizeof *ELEMENTS; k++) {
        int n = ELEMENTS[k];
        double found = laid_anchor_tension(n);
        char figure[40];
        snprintf(figure, sizeof figure, "anchor tension, N = %d [N]", n);
        double error = show("OC3 line, laid", figure, exact.h, found) / exact.h;
        CHECK_LESS(fabs(error), 1.0 / n / n);
        if (n == 400) CHECK_NEAR(found, 736938.3, 1e-5 * 736938.3);
    }
}

/* tension at mid-length (horizontal force) and place of the middle node, errors against the closed
 * form */
static void hang(int elements, double stiffness, const Catenary *exact, double *tension_error,
                 double *place_error) {
    Case c;
    case_begin(&c, exact->length, elements, exact->weight, stiffness);
    case_laid(&c, 80, 20);
    Run run = case_open(&c);
    CpsLineView view = case_step(&run);
    double x, z;
    catenary_point(exact, exact->length / 2, &x, &z);
    const double *middle = &view.position[3 * (size_t)(elements / 2)];
    *tension_error = fabs(view.segment_force[0]) - exact->h;
    *place_error = hypot(middle[0] - x, middle[2] - z);
    case_close(&run);
}

/* Lumping the weight at the nodes is exact in the forces and a midpoint rule in the shape: order 2.
 * The ratio of successive meshes is asserted within 0.1 of it. */
static void converges(const char *name, double stiffness) {
    Catenary exact = {.length = 100, .weight = 100, .stiffness = stiffness, .h = 4000, .v = 6000};
    assert_true(catenary_solve(&exact, 80, 20));
    double tension[3], place[3];
    for (int k = 0; k < 3; k++) {
        int n = 50 << k;
        hang(n, stiffness, &exact, &tension[k], &place[k]);
        char figure[40];
        snprintf(figure, sizeof figure, "horizontal force, N = %d [N]", n);
        show(name, figure, exact.h, exact.h + tension[k]);
        snprintf(figure, sizeof figure, "place of the middle, N = %d [m]", n);
        show(name, figure, 0, place[k]);
    }
    for (int k = 0; k < 2; k++) {
        CHECK_NEAR(show(name, "order, force", 2, order(tension[k], tension[k + 1])), 0, 0.1);
        CHECK_NEAR(show(name, "order, place", 2, order(place[k], place[k + 1])), 0, 0.1);
    }
}

static void hanging_elastic(void **state) {
    (void)state;
    converges("hanging, EA = 1e5 N", 1e5);
    converges("hanging, EA = 1e9 N", 1e9);
}

static void hanging_inextensible(void **state) {
    (void)state;
    converges("hanging, inextensible", INFINITY);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mooring_line_on_the_bed),
        cmocka_unit_test(hanging_elastic),
        cmocka_unit_test(hanging_inextensible),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
