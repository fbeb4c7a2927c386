/* SPDX-License-Identifier: BSD-3-Clause */
/* S90 example 5.7: 6.28 m of cable on a rough bed, pulled up, aside and released; from three
 * initial configurations. */
#include <stdio.h>
#include <string.h>

#include "cases.h"

static const double PI = 3.14159265358979323846;

typedef enum Shape { STRAIGHT, HALF_CIRCLE, CIRCLE } Shape;

static void example(Case *c, int elements, double friction, Shape shape) {
    case_begin(c, 6.28, elements, 9.81, 10);
    case_bed(c, friction);
    if (shape == STRAIGHT) case_straight(c, 0, 6.28);
    if (shape != STRAIGHT) case_arc(c, 6.28 / (shape == CIRCLE ? 2 * PI : PI));
    case_force(c, 1, 0.5, 0.5, 0.5);
    case_force(c, 1, 0, 0, 1);
    case_force(c, 1, 0, 0, 0.5);
    case_force(c, 1, 0, 0, 0);
}

/* minimum and tip of the first step; the figures have seven and six decimals, so half a unit of the
 * last plus the solver's own 1e-8 of the scale */
static void first_step(double friction, CpsFrictionPolicy law, double minimum, const double *tip,
                       double digits) {
    Case c;
    example(&c, 800, friction, STRAIGHT);
    c.scene.friction_policy = law;
    Run run = case_open(&c);
    CpsLineView view = case_step(&run);
    double primal = cps_evolution_report(run.evolution).certificate.primal;
    const double *found = &view.position[3 * (size_t)view.element_count];
    char name[64];
    snprintf(name, sizeof name, "example 5.7, %s = %.6f N/m",
             law == CPS_FRICTION_POLICY_FROZEN ? "A" : "mu w", friction * 9.81);
    if (law == CPS_FRICTION_POLICY_FROZEN)
        CHECK_NEAR(show(name, "minimum of J + j [J]", minimum, primal), 0, 7e-8);
    for (int k = 0; k < 3; k++) CHECK_NEAR(show(name, "tip [m]", tip[k], found[k]), 0, digits);
    while (cps_evolution_remaining_count(run.evolution) > 0) case_step(&run);
    case_close(&run);
}

static void first_step_from_the_straight_line(void **state) {
    (void)state;
    first_step(0.0255, CPS_FRICTION_POLICY_FROZEN, -3.3278892,
               (const double[]){6.168437, 0.918939, 0.017434}, 6e-7);
    first_step(0.25 / 9.81, CPS_FRICTION_POLICY_FROZEN, -3.3280038,
               (const double[]){6.16837, 0.91951, 0.01743}, 6e-6);
}

/* Coulomb's law itself, A = mu R at the configuration reached: another solver's tip, by rounds on
 * A; five decimals */
static void first_step_with_consistent_friction(void **state) {
    (void)state;
    first_step(0.0255, CPS_FRICTION_POLICY_CONSISTENT, NAN,
               (const double[]){6.15607, 0.95754, 0.01738}, 6e-6);
}

/* |tip of Y5 - tip of Y1| */
static double residual_motion(int elements, Shape shape) {
    Case c;
    example(&c, elements, 0.0255, shape);
    Run run = case_open(&c);
    double start[3], sum = 0;
    CpsLineView view = cps_evolution_line_view(run.evolution, 0);
    for (int k = 0; k < 3; k++) start[k] = view.position[3 * (size_t)elements + (size_t)k];
    while (cps_evolution_remaining_count(run.evolution) > 0) view = case_step(&run);
    for (int k = 0; k < 3; k++)
        sum += pow(view.position[3 * (size_t)elements + (size_t)k] - start[k], 2);
    case_close(&run);
    return sqrt(sum);
}

/* "the cable does not come back": the tip ends away from where it began, by the same distance on
 * two meshes (1 %) */
static void does_not_come_back(void **state) {
    (void)state;
    static const char *const NAME[] = {"Y5 - Y1, straight", "Y5 - Y1, half circle",
                                       "Y5 - Y1, circle"};
    for (Shape shape = STRAIGHT; shape <= CIRCLE; shape++) {
        double coarse = residual_motion(400, shape), fine = residual_motion(1600, shape);
        show(NAME[shape], "400 against 1600 elements [m]", fine, coarse);
        CHECK_RELATIVE(coarse, fine, 0.01);
        CHECK_GREATER(fine, 0.1);
    }
}

/* Contact as S90 (35): in Y3 thirteen elements are lifted, which touch nothing in Y4 and Y5 and
 * hang at last from the node before them, with weight w: tip at -(a + w a^2/(2 K)), a = 13 h, exact
 * in the lumped line. The energy is another conic solver's, six decimals. */
static void strict_contact(void **state) {
    (void)state;
    enum { N = 800 };
    Case c;
    example(&c, N, 0.0255, STRAIGHT);
    c.scene.friction_policy = CPS_FRICTION_POLICY_FROZEN;
    c.scene.contact_policy = CPS_CONTACT_POLICY_REFERENCE;
    Run run = case_open(&c);
    CpsLineView view = {0};
    while (cps_evolution_remaining_count(run.evolution) > 0) view = case_step(&run);
    const double a = 13 * 6.28 / N, deep = a + 9.81 * a * a / 20;
    CHECK_NEAR(show("example 5.7, strict, Y5", "height of the tip [m]", -deep,
                    view.position[3 * N + 2]),
               0, 1e-8);
    const double energy = cps_evolution_report(run.evolution).certificate.primal;
    CHECK_NEAR(show("example 5.7, strict, Y5", "minimum of J + j [J]", -0.042095, energy), 0, 6e-7);
    for (int j = 0; j <= N; j++)
        if (view.position[3 * j + 2] < -1e-6) CHECK_NEAR(view.reaction[j], 0, 0);
    case_close(&run);
}

/* With the argument --fine alone: 100 000 elements, each step certified (case_step), where a
 * vertical end of 0.5 N hangs: f/w of line, stretched by f^2/(2 w K), to an element. */
static void fine_mesh(void **state) {
    (void)state;
    enum { N = 100000 };
    Case c;
    example(&c, N, 0.0255, STRAIGHT);
    c.scene.friction_policy = CPS_FRICTION_POLICY_FROZEN;
    Run run = case_open(&c);
    CpsLineView view = {0};
    for (int step = 0; cps_evolution_remaining_count(run.evolution) > 0; step++) {
        view = case_step(&run);
        const double height = 0.5 / 9.81 + 0.25 / (2 * 9.81 * 10);
        if (step == 2)
            CHECK_NEAR(show("example 5.7, Y4", "height of the tip [m]", height,
                            view.position[3 * N + 2]),
                       0, 2 * 6.28 / N);
    }
    case_close(&run);
}

int main(int argc, char **argv) {
    const struct CMUnitTest fine[] = {cmocka_unit_test(fine_mesh)};
    if (argc == 2 && strcmp(argv[1], "--fine") == 0)
        return cmocka_run_group_tests(fine, NULL, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(first_step_from_the_straight_line),
        cmocka_unit_test(first_step_with_consistent_friction),
        cmocka_unit_test(does_not_come_back),
        cmocka_unit_test(strict_contact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
