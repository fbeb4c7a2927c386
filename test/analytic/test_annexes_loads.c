/* SPDX-License-Identifier: BSD-3-Clause */
/* The annexes of S90 with forces that depend on the place, U of (11): existence from coercivity
 * (remark 7.5.3), and which configurations are solutions where the line is slack (theorem 6.3 and
 * proposition 7.4, x in dU*(dU)). */
#include <math.h>
#include <string.h>

#include "capstan/evolve.h"
#include "check.h"

typedef struct Case {
    CpsScene scene;
    CpsLine line;
    CpsObstacle bed;
    CpsStage stage;
    CpsChange change;
    CpsLineLoads loads;
    CpsSpring spring;
    double point[9];
} Case;

/* A line of length 1 and weight 1 on a bed, straight from 0 to e1, with frozen friction. */
static void begin(Case *c, int n, double ea, double friction) {
    static const double straight[6] = {0, 0, 0, 1, 0, 0};
    c->scene = cps_scene_default();
    c->scene.friction_policy = CPS_FRICTION_POLICY_FROZEN;
    c->line = cps_line_default();
    c->bed = cps_obstacle_default();
    c->stage = cps_stage_default();
    c->spring = (CpsSpring){.to = 1};
    c->loads = (CpsLineLoads){.spring_count = 1, .spring = &c->spring};
    memcpy(c->point, straight, sizeof straight);
    c->line.start = (CpsStart){.kind = CPS_START_STRAIGHT, .point_count = 2, .point = c->point};
    c->line.name = "line";
    c->line.length = 1;
    c->line.element_count = n;
    c->line.weight = 1;
    c->line.stiffness = ea;
    c->line.loads = &c->loads;
    c->bed.name = "bed";
    c->bed.friction = friction;
    c->stage.name = "load";
    c->stage.step_count = 1;
    c->stage.change = &c->change;
    c->stage.change_count = 1;
    c->scene.line = &c->line;
    c->scene.line_count = 1;
    c->scene.obstacle = &c->bed;
    c->scene.obstacle_count = 1;
    c->scene.stage = &c->stage;
    c->scene.stage_count = 1;
}

static CpsEvolution *solved(const Case *c, CpsOutcome outcome) {
    CpsError err;
    CpsEvolution *evolution = NULL;
    if (cps_evolution_create(&c->scene, &evolution, &err)) fail_msg("%s", err.message);
    assert_int_equal(cps_evolution_step(evolution, &err), CPS_OK);
    assert_int_equal(cps_evolution_line_report(evolution, 0).outcome, outcome);
    return evolution;
}

/* Remark 7.5.3. Nothing holds the line, mu w l = 0.3 N, and 0.5 N pull at B: without U the energy
 * falls without end. A spring F(x(l)) = (k/2) |x(l) - e1|^2 makes J** + j coercive; all of the line
 * slides, and B stays where 0.5 - k u = 0.3. */
static void potential_of_the_end(void **state) {
    (void)state;
    for (int with = 0; with < 2; with++) {
        const double k = 2;
        Case c;
        begin(&c, 40, 50, 0.3);
        c.line.end[0] = (CpsEnd){CPS_END_KIND_FREE, {0, 0, 0}};
        c.change = (CpsChange){.line = 0, .end = CPS_END_B, .to = {CPS_END_KIND_FREE, {0.5, 0, 0}}};
        c.spring = (CpsSpring){.from = 1, .to = 1, .stiffness = {k, k, k}, .place = {1, 0, 0}};
        if (!with) c.line.loads = NULL;
        CpsEvolution *evolution = solved(&c, with ? CPS_OUTCOME_SOLVED : CPS_OUTCOME_UNBOUNDED);
        const CpsLineView view = cps_evolution_line_view(evolution, 0);
        if (with) {
            CHECK_NEAR(view.position[3 * 40] - 1, 0.2 / k, 1e-9);
            for (int j = 0; j <= 40; j++) assert_true(view.position[3 * j] > j / 40.0);
        }
        cps_evolution_destroy(evolution);
    }
}

/* Where the line goes whose end B comes back to `to`, from a start that bends to one side. */
static void slack_places(double side, bool with, double out[3 * 21]) {
    Case c;
    begin(&c, 20, INFINITY, 0);
    const double bent[9] = {0, 0, 0, 0.4, 0.3 * side, 0, 0.8, 0, 0};
    memcpy(c.point, bent, sizeof bent);
    c.line.start.kind = CPS_START_POLYLINE;
    c.line.start.point_count = 3;
    c.change = (CpsChange){.line = 0, .end = CPS_END_B, .to = {CPS_END_KIND_HELD, {0.6, 0, 0}}};
    c.spring = (CpsSpring){.to = 1, .stiffness = {0.02, 0.03, 0}, .place = {0.3, 0.1, 0}};
    if (!with) c.line.loads = NULL;
    CpsEvolution *evolution = solved(&c, CPS_OUTCOME_SOLVED);
    memcpy(out, cps_evolution_line_view(evolution, 0).position, 3 * 21 * sizeof *out);
    cps_evolution_destroy(evolution);
}

/* Theorem 6.3: on a smooth bed any layout of the slack is a solution where U is the weight alone,
 * and two starts end in two of them; with a strictly convex U the solutions of P4.2 are one, from
 * both starts. */
static void slack_in_a_field(void **state) {
    (void)state;
    double left[63], right[63], apart[2] = {0};
    for (int with = 0; with < 2; with++) {
        slack_places(1, with, left);
        slack_places(-1, with, right);
        for (int i = 0; i < 63; i++) apart[with] = fmax(apart[with], fabs(left[i] - right[i]));
    }
    print_message("slack from two starts: %.2g m apart, with U %.2g m\n", apart[0], apart[1]);
    assert_true(apart[0] > 0.1);
    assert_true(apart[1] < 1e-6);
}

/* Nothing holds an inextensible line in the field (k/2) |x - a|^2 per length: the only solution of
 * P4.2 has all of it at a, where |x'| = 0. That is outside Kin, so P3.1, whose infimum is the same,
 * has none. */
static void all_at_the_centre(void **state) {
    (void)state;
    Case c;
    begin(&c, 30, INFINITY, 0);
    c.line.weight = 0;
    c.scene.obstacle_count = 0;
    c.line.end[0] = (CpsEnd){CPS_END_KIND_FREE, {0, 0, 0}};
    c.change = (CpsChange){.line = 0, .end = CPS_END_B, .to = {CPS_END_KIND_FREE, {0, 0, 0}}};
    c.spring = (CpsSpring){.to = 1,
                           .stiffness = {3, 2, 4},
                           .place = {0.2, 0.5, -0.7},
                           .coupling = {1, -0.5, 0.3}};
    CpsEvolution *evolution = solved(&c, CPS_OUTCOME_SOLVED);
    const CpsLineView view = cps_evolution_line_view(evolution, 0);
    for (int j = 0; j <= 30; j++)
        for (int a = 0; a < 3; a++) CHECK_NEAR(view.position[3 * j + a], c.spring.place[a], 1e-9);
    for (int i = 0; i < 30; i++) assert_true(view.tension[i] < 1e-9);
    cps_evolution_destroy(evolution);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(potential_of_the_end),
        cmocka_unit_test(slack_in_a_field),
        cmocka_unit_test(all_at_the_centre),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
