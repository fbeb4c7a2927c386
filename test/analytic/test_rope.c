/* SPDX-License-Identifier: BSD-3-Clause */
/* A rope on a table (M77, remark of section 11) compared with closed forms.
 *
 * A straight rope of length L pulled at an angle psi < 90 degrees: all of it except the end moves
 * along itself with W cos(psi), so gamma = f w W [ (L - h/2) cos(psi) + h/2 ] with elements of
 * length h: the end node, with the friction f w h/2, moves with W. A rope in an arc of radius R and
 * angle theta <= pi/2, at rest or sliding: T'^2 + (T/R)^2 <= (f w)^2, so the tension is at most f w
 * R sin(theta). */
#include <stdio.h>
#include <stdlib.h>

#include "capstan/planar.h"
#include "check.h"

static const double PI = 3.14159265358979323846;

/* A rope, its system and its motion. */
typedef struct Case {
    double *node;
    CpsRope rope;
    CpsSystem *system;
    CpsMotion *motion;
} Case;

static Case make(int elements, bool held, bool slack) {
    Case c = {.rope = cps_rope_default()};
    c.rope.node_count = elements + 1;
    c.rope.resistance = 1;
    c.rope.driven[0] = held;
    c.rope.driven[1] = true;
    c.rope.slack = slack;
    c.node = malloc(2 * ((size_t)elements + 1) * sizeof *c.node);
    assert_non_null(c.node);
    c.rope.node = c.node;
    return c;
}

static void straight(Case *c, double length) {
    for (int i = 0; i < c->rope.node_count; i++) {
        c->node[2 * i] = length * i / (c->rope.node_count - 1);
        c->node[2 * i + 1] = 0;
    }
}

static void arc(Case *c, double radius, double angle) {
    for (int i = 0; i < c->rope.node_count; i++) {
        const double a = angle * i / (c->rope.node_count - 1);
        c->node[2 * i] = radius * cos(a);
        c->node[2 * i + 1] = radius * sin(a);
    }
}

static CpsMotionReport solve(Case *c, const double *driving) {
    CpsError err = {.message = ""};
    CpsMotionOptions options = cps_motion_options_default();
    options.composition = false;
    if (cps_rope_system(&c->rope, &c->system, &err) != CPS_OK) fail_msg("%s", err.message);
    if (cps_system_solve(c->system, driving, &options, &c->motion, &err) != CPS_OK)
        fail_msg("%s", err.message);
    return cps_motion_report(c->motion);
}

static double tension(const Case *c, int element) {
    return -cps_motion_law_force(c->motion, c->rope.node_count + element)[0];
}

static void finish(Case *c) {
    cps_motion_destroy(c->motion);
    cps_system_destroy(c->system);
    free(c->node);
}

/* no element grows, none pushes, and tension only where the length is kept */
static void check_elements(const Case *c, double scale) {
    for (int i = 0; i + 1 < c->rope.node_count; i++) {
        const double growth = cps_motion_law_velocity(c->motion, c->rope.node_count + i)[0];
        /* residuals of the solver, of unit speeds and forces */
        CHECK_LESS(growth, 1e-9);
        CHECK_GREATER(tension(c, i), -1e-9);
        CHECK_LESS(fabs(growth * tension(c, i)), 1e-8 * scale);
    }
}

static void pulled_aslant(void **state) {
    (void)state;
    const double psi = PI / 3;
    for (int elements = 10; elements <= 1000; elements *= 10) {
        Case c = make(elements, false, true);
        straight(&c, 1);
        const double h = 1.0 / elements;
        const CpsMotionReport r = solve(&c, (double[]){cos(psi), sin(psi)});
        print_message("straight, %d elements: gamma %.12g, gap %.1e\n", elements, r.value,
                      r.upper - r.lower);
        CHECK_INT(r.outcome, CPS_MOTION_OUTCOME_SOLVED);
        /* the solver's own bound, 1e-8 of a scale of about 1 */
        CHECK_NEAR(r.value, (1 - 0.5 * h) * cos(psi) + 0.5 * h, 1e-8);
        assert_true(r.lower <= r.upper);
        /* all nodes but the last follow along the rope */
        const double *v = cps_motion_velocity(c.motion);
        for (int i = 0; i < elements; i++) {
            /* root of the gap, relative to a node's share h */
            CHECK_NEAR(v[2 * i], cos(psi), 1e-5);
            CHECK_NEAR(v[2 * i + 1], 0, 1e-5);
            CHECK_NEAR(tension(&c, i), (i + 0.5) * h, 1e-6);
        }
        check_elements(&c, 1);
        finish(&c);
    }
}

static void arc_bound(void **state) {
    (void)state;
    const double theta = 1;
    for (int elements = 100; elements <= 10000; elements *= 10) {
        Case c = make(elements, false, true);
        arc(&c, 1, theta);
        const CpsMotionReport r = solve(&c, (double[]){-sin(theta), cos(theta)});
        const double last = tension(&c, elements - 1), h = theta / elements;
        print_message("arc, %d elements: largest tension %.9g, bound %.9g\n", elements, last,
                      sin(theta));
        CHECK_INT(r.outcome, CPS_MOTION_OUTCOME_SOLVED);
        /* it is reached up to the half element of friction at the end, T' = cos(theta) */
        CHECK_NEAR(last, sin(theta) - 0.5 * h * cos(theta), 0.5 * h * h + 1e-7);
        CHECK_LESS(last, sin(theta));
        check_elements(&c, 1);
        finish(&c);
    }
}

/* both ends apart: no velocity agrees with an inextensible rope, and the forces that prove it pull
 * it apart */
static void pulled_apart(void **state) {
    (void)state;
    Case c = make(20, true, true);
    straight(&c, 1);
    CpsMotionReport r = solve(&c, (double[]){-1, 0, 1, 0});
    CHECK_INT(r.outcome, CPS_MOTION_OUTCOME_BLOCKED);
    const double *g = cps_motion_resistance(c.motion);
    CHECK_LESS(-g[0] + g[2], 0);
    finish(&c);

    /* towards each other they move alone: the rope between goes slack */
    c = make(20, true, true);
    straight(&c, 1);
    r = solve(&c, (double[]){1, 0, -1, 0});
    CHECK_INT(r.outcome, CPS_MOTION_OUTCOME_SOLVED);
    /* half an element of friction at each end */
    CHECK_NEAR(r.value, 2 * 0.5 / 20, 1e-8);
    finish(&c);
}

/* M77's rope keeps its length: pushed at its end along itself a straight one moves as a whole,
 * gamma = f w L W, with the tension -f w (s + h/2) in the element whose middle is s from the free
 * end; both ends towards each other: no velocity agrees. */
static void inextensible(void **state) {
    (void)state;
    for (int elements = 10; elements <= 1000; elements *= 10) {
        Case c = make(elements, false, false);
        straight(&c, 2);
        const CpsMotionReport r = solve(&c, (double[]){-1, 0});
        CHECK_INT(r.outcome, CPS_MOTION_OUTCOME_SOLVED);
        CHECK_NEAR(r.value, 2, 1e-8); /* the solver's own bound, of a scale of 2 */
        for (int i = 0; i < elements; i++)
            CHECK_NEAR(tension(&c, i), -(i + 0.5) * 2 / elements, 1e-6);
        finish(&c);
    }
    /* an arc pushed back along its end's tangent: no element changes its length, which is dearer
     * than to go slack */
    double value[2];
    for (int slack = 0; slack < 2; slack++) {
        Case c = make(100, false, slack);
        arc(&c, 1, 1);
        value[slack] = solve(&c, (double[]){sin(1), -cos(1)}).value;
        if (!slack)
            for (int i = 0; i < 100; i++)
                CHECK_NEAR(cps_motion_law_velocity(c.motion, c.rope.node_count + i)[0], 0,
                           1e-9); /* linear residual */
        finish(&c);
    }
    CHECK_GREATER(value[0], 10 * value[1]);
    Case c = make(20, true, false);
    straight(&c, 1);
    CHECK_INT(solve(&c, (double[]){1, 0, -1, 0}).outcome, CPS_MOTION_OUTCOME_BLOCKED);
    finish(&c);
}

static void refused(void **state) {
    (void)state;
    CpsSystem *system = NULL;
    CpsError err;
    const double node[] = {0, 0, 1, 0, 1, 0};
    const uint32_t cookie = cps_rope_default().cookie;
    const CpsRope bad[] = {{cookie, 1, node, 1, {false, true}, false},
                           {cookie, 3, node, 1, {false, true}, false},
                           {cookie, 2, node, -1, {false, true}, false},
                           {cookie, 2, node, NAN, {false, true}, false},
                           {cookie, 2, NULL, 1, {false, true}, false},
                           {0, 2, node, 1, {false, true}, false}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        CHECK_INT(cps_rope_system(&bad[i], &system, &err), CPS_ERR_ARGUMENT);
        assert_null(system);
    }
    const CpsRope long_rope = {cookie, CPS_ROPE_MAX_NODES + 1, node, 1, {false, true}, false};
    CHECK_INT(cps_rope_system(&long_rope, &system, &err), CPS_ERR_LIMIT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pulled_aslant), cmocka_unit_test(arc_bound),
        cmocka_unit_test(pulled_apart),  cmocka_unit_test(inextensible),
        cmocka_unit_test(refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
