/* SPDX-License-Identifier: BSD-3-Clause */
/* Points where lines meet: answers by hand, the same bits where they must be the same, and what is
 * refused. */
#include <stdlib.h>
#include <string.h>

#include "cases.h"

/* Two weightless strings of one element hang a weight between two anchors at the same height: with
 * the half span a and the length s = sqrt(a^2 + y^2) of a string, 2 EA (s/l - 1) y/s = W. */
static const double HALF_SPAN = 3, LENGTH = 3.5, EA = 2e4, WEIGHT = 1500;

typedef struct Strings {
    CpsLine line[2];
    CpsPoint point[3];
    CpsObstacle bed;
    CpsScene scene;
} Strings;

static void two_strings(Strings *s) {
    static const char *const NAME[] = {"left", "right", "knot"}, *const LINE[] = {"one", "two"};
    *s = (Strings){.scene = cps_scene_default(), .bed = cps_obstacle_default()};
    s->bed.name = "bed";
    for (int i = 0; i < 3; i++) {
        s->point[i] = cps_point_default();
        s->point[i].name = NAME[i];
        s->point[i].position[0] = (i - 0.5) * 2 * HALF_SPAN;
    }
    s->point[2].kind = CPS_POINT_KIND_FREE;
    s->point[2].position[0] = 0.4;
    s->point[2].position[1] = 0.3;
    s->point[2].position[2] = -1;
    s->point[2].weight = WEIGHT;
    for (int i = 0; i < 2; i++) {
        s->line[i] = cps_line_default();
        s->line[i].name = LINE[i];
        s->line[i].length = LENGTH;
        s->line[i].element_count = 1;
        s->line[i].stiffness = EA;
        s->line[i].start.kind = CPS_START_STATIC;
        s->line[i].end[CPS_END_A].kind = CPS_END_KIND_POINT;
        s->line[i].end_point[CPS_END_A] = i;
        s->line[i].end[CPS_END_B].kind = CPS_END_KIND_POINT;
        s->line[i].end_point[CPS_END_B] = 2;
    }
    s->scene.line_count = 2;
    s->scene.line = s->line;
    s->scene.point_count = 3;
    s->scene.point = s->point;
}

static CpsEvolution *evolve(const CpsScene *scene) {
    CpsEvolution *evolution = NULL;
    CpsError err;
    if (cps_evolution_create(scene, &evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    return evolution;
}

static CpsPointReport step_to(CpsEvolution *evolution, int point) {
    CpsError err;
    assert_int_equal(cps_evolution_step(evolution, &err), CPS_OK);
    assert_int_equal(cps_evolution_report(evolution).outcome, CPS_OUTCOME_SOLVED);
    return cps_evolution_point_report(evolution, point);
}

/* The depth at which the strings carry a weight, by bisection. */
static double depth(double weight) {
    double low = 0, high = 100;
    while (high - low > 1e-13 * high) {
        const double y = 0.5 * (low + high), s = hypot(HALF_SPAN, y);
        if (2 * EA * fmax(0, s / LENGTH - 1) * y / s < weight)
            low = y;
        else
            high = y;
    }
    return low;
}

static void a_weight_between_two_strings(void **unused) {
    (void)unused;
    Strings s;
    two_strings(&s);
    CpsEvolution *evolution = evolve(&s.scene);
    const CpsPointReport knot = step_to(evolution, 2),
                         left = cps_evolution_point_report(evolution, 0);
    const double at[3] = {0, 0, -depth(WEIGHT)};
    CHECK_VECTOR(knot.position, at, 1e-10);
    CHECK_NEAR(knot.load[2], -WEIGHT, 0);
    CHECK_NEAR(knot.lines[2], WEIGHT, 1e-6);
    assert_int_equal(knot.state, CPS_POINT_STATE_FREE);
    assert_int_equal(left.state, CPS_POINT_STATE_HELD);
    CHECK_NEAR(left.support[2], WEIGHT / 2, 1e-6);
    CHECK_NEAR(left.support[0] + left.lines[0], 0, 1e-12);
    cps_evolution_destroy(evolution);
}

/* A buoy is a negative weight: the same, upside down. */
static void a_buoy(void **unused) {
    (void)unused;
    Strings s;
    two_strings(&s);
    s.point[2].weight = -WEIGHT;
    CpsEvolution *evolution = evolve(&s.scene);
    const double at[3] = {0, 0, depth(WEIGHT)};
    CHECK_VECTOR(step_to(evolution, 2).position, at, 1e-10);
    cps_evolution_destroy(evolution);
}

/* A clump of weight W on a rough bed, tied by a weightless elastic string to an anchor on the bed.
 * Pulled along the string with P it stays up to mu W; beyond, the string has P - mu W. Let go, it
 * stays while the string has no more than P + mu W, and then creeps back. */
static void a_clump_on_a_rough_bed(void **unused) {
    static const double MU = 0.5;
    (void)unused;
    Strings s;
    two_strings(&s);
    const double hold = MU * WEIGHT, start[3] = {LENGTH, 0, 0};
    CpsPointChange change[4];
    CpsStage stage[4];
    const double pull[4] = {0.9 * hold, 3 * hold, 1.5 * hold, 0};
    const double tension[4] = {0, 2 * hold, 2 * hold, hold};
    s.bed.friction = MU;
    s.scene.obstacle_count = 1;
    s.scene.obstacle = &s.bed;
    for (int a = 0; a < 3; a++) s.point[0].position[a] = 0;
    memcpy(s.point[2].position, start, sizeof start);
    s.line[0].start = (CpsStart){.kind = CPS_START_STRAIGHT,
                                 .point_count = 2,
                                 .point = (const double[6]){0, 0, 0, LENGTH, 0, 0},
                                 .axis = {0, 0, 1}};
    s.scene.line_count = 1;
    s.point[1] = s.point[2];
    s.line[0].end_point[CPS_END_B] = 1;
    s.scene.point_count = 2;
    for (int k = 0; k < 4; k++) {
        stage[k] = cps_stage_default();
        stage[k].name = "pull";
        change[k] =
            (CpsPointChange){.point = 1, .kind = CPS_POINT_KIND_FREE, .value = {pull[k], 0, 0}};
        stage[k].point_change_count = 1;
        stage[k].point_change = &change[k];
    }
    s.scene.stage_count = 4;
    s.scene.stage = stage;
    CpsEvolution *evolution = evolve(&s.scene);
    double before = LENGTH;
    for (int k = 0; k < 4; k++) {
        const CpsPointReport clump = step_to(evolution, 1);
        CHECK_NEAR(clump.position[0], LENGTH * (1 + tension[k] / EA), 1e-9);
        CHECK_NEAR(clump.reaction, WEIGHT, 1e-9);
        CHECK_NEAR(clump.friction[0], tension[k] - pull[k], 1e-5);
        CHECK_NEAR(clump.slip[0], clump.position[0] - before, 1e-12);
        CHECK_NEAR(clump.dissipated, hold * fabs(clump.slip[0]), 1e-6);
        /* the line has no friction of its own: the step's is the clump's, and the ledger has it */
        const CpsStepReport report = cps_evolution_report(evolution);
        CHECK_NEAR(report.dissipated, clump.dissipated, 1e-9);
        CHECK_NEAR(report.ledger.dissipated, clump.dissipated, 1e-9);
        CHECK_NEAR(report.ledger.ends,
                   report.ledger.elastic + report.ledger.gravity + clump.dissipated +
                       report.ledger.imbalance,
                   1e-9);
        assert_int_equal(clump.state,
                         k == 0 || k == 2 ? CPS_POINT_STATE_STICK : CPS_POINT_STATE_SLIP);
        before = clump.position[0];
    }
    cps_evolution_destroy(evolution);
}

/* Lines at a held point that moves have the bits of lines whose ends are held and move. */
static void a_held_point_is_held_ends(void **unused) {
    (void)unused;
    Strings points, ends;
    two_strings(&points);
    two_strings(&ends);
    CpsStage moves[2] = {cps_stage_default(), cps_stage_default()};
    const CpsPointChange point_change = {.point = 2,
                                         .kind = CPS_POINT_KIND_HELD,
                                         .value = {0.2, 0.5, -2}};
    CpsChange change[2];
    points.point[2].kind = CPS_POINT_KIND_HELD;
    points.point[2].weight = 0;
    for (int i = 0; i < 2; i++) {
        change[i] = (CpsChange){.line = i, .end = CPS_END_B, .to = {.kind = CPS_END_KIND_HELD}};
        memcpy(change[i].to.value, point_change.value, sizeof change[i].to.value);
        for (int end = 0; end < 2; end++) {
            CpsEnd *to = &ends.line[i].end[end];
            memcpy(to->value, points.point[points.line[i].end_point[end]].position,
                   sizeof to->value);
            to->kind = CPS_END_KIND_HELD;
        }
        points.line[i].weight = ends.line[i].weight = 30;
        points.line[i].element_count = ends.line[i].element_count = 12;
        moves[i].name = "move";
        moves[i].step_count = 3;
    }
    ends.scene.point_count = 0;
    moves[0].point_change_count = 1;
    moves[0].point_change = &point_change;
    moves[1].change_count = 2;
    moves[1].change = change;
    points.scene.stage_count = ends.scene.stage_count = 1;
    points.scene.stage = &moves[0];
    ends.scene.stage = &moves[1];
    CpsEvolution *a = evolve(&points.scene), *b = evolve(&ends.scene);
    for (int step = 0; step < 4; step++) {
        (void)step_to(a, 2);
        (void)step_to(b, 0);
        for (int i = 0; i < 2; i++)
            assert_memory_equal(cps_evolution_line_view(a, i).position,
                                cps_evolution_line_view(b, i).position, 3 * 13 * sizeof(double));
    }
    cps_evolution_destroy(a);
    cps_evolution_destroy(b);
}

/* A point that is released stays: its force begins with that which held it. Then moves, one of
 * which is taken back, and a state that is loaded, have the same bits as without. */
static void moves_of_points(void **unused) {
    (void)unused;
    Strings s;
    two_strings(&s);
    s.point[2].kind = CPS_POINT_KIND_HELD;
    s.point[2].weight = 0;
    CpsEvolution *evolution = evolve(&s.scene), *other = evolve(&s.scene);
    CpsError err;
    (void)step_to(evolution, 2);
    const CpsPointReport held = cps_evolution_point_report(evolution, 2);
    CpsPointChange change = {.point = 2, .kind = CPS_POINT_KIND_FREE, .value = {0}};
    CpsStage move = cps_stage_default();
    memcpy(change.value, held.support, sizeof change.value);
    move.point_change_count = 1;
    move.point_change = &change;
    assert_int_equal(cps_evolution_move(evolution, &move, &err), CPS_OK);
    CHECK_VECTOR(cps_evolution_point_report(evolution, 2).position, held.position, 1e-9);
    void *state = malloc(cps_evolution_state_size(evolution));
    cps_evolution_save(evolution, state);
    change.value[2] -= 300;
    assert_int_equal(cps_evolution_move(evolution, &move, &err), CPS_OK);
    const CpsPointReport lower = cps_evolution_point_report(evolution, 2);
    assert_int_equal(cps_evolution_take_back(evolution, &err), CPS_OK);
    CHECK_VECTOR(cps_evolution_point_report(evolution, 2).position, held.position, 1e-9);
    assert_int_equal(cps_evolution_load(other, state, cps_evolution_state_size(other), &err),
                     CPS_OK);
    assert_int_equal(cps_evolution_move(evolution, &move, &err), CPS_OK);
    assert_int_equal(cps_evolution_move(other, &move, &err), CPS_OK);
    const CpsPointReport again = cps_evolution_point_report(evolution, 2),
                         loaded = cps_evolution_point_report(other, 2);
    assert_memory_equal(again.position, lower.position, sizeof lower.position);
    assert_memory_equal(loaded.position, lower.position, sizeof lower.position);
    /* to be held again, from where it is */
    change.kind = CPS_POINT_KIND_HELD;
    change.value[0] = 0.1;
    change.value[1] = 0;
    change.value[2] = -2;
    assert_int_equal(cps_evolution_move(evolution, &move, &err), CPS_OK);
    CHECK_VECTOR(cps_evolution_point_report(evolution, 2).position, change.value, 0);
    free(state);
    cps_evolution_destroy(evolution);
    cps_evolution_destroy(other);
}

/* Points that no line connects do not count for each other: a light point beside a mooring with
 * forces that are 1e9 times as large has its own place, and what falls there is told to fall, by
 * its whole weight. */
static void a_light_point_beside_a_heavy_one(void **unused) {
    (void)unused;
    for (int falls = 0; falls < 2; falls++) {
        Strings light, heavy;
        CpsLine line[4];
        CpsPoint point[6];
        two_strings(&light);
        two_strings(&heavy);
        for (int i = 0; i < 3; i++) {
            static const char *const NAME[] = {"left_2", "right_2", "knot_2"};
            point[i] = light.point[i];
            point[3 + i] = heavy.point[i];
            point[3 + i].name = NAME[i];
            point[3 + i].position[1] += 20;
        }
        for (int i = 0; i < 2; i++) {
            line[i] = light.line[i];
            line[2 + i] = heavy.line[i];
            line[2 + i].name = i == 0 ? "three" : "four";
            line[2 + i].stiffness = 1e9 * EA;
            for (int end = 0; end < 2; end++) line[2 + i].end_point[end] += 3;
            if (falls) point[i].kind = CPS_POINT_KIND_FREE;
        }
        point[5].weight = 1e9 * WEIGHT;
        light.scene.line = line;
        light.scene.line_count = 4;
        light.scene.point = point;
        light.scene.point_count = 6;
        CpsEvolution *evolution = evolve(&light.scene);
        CpsError err;
        assert_int_equal(cps_evolution_step(evolution, &err), CPS_OK);
        const CpsPointReport knot = cps_evolution_point_report(evolution, 2);
        const double at[3] = {0, 0, -depth(WEIGHT)};
        assert_int_equal(knot.has_place, !falls);
        if (!falls) CHECK_VECTOR(knot.position, at, 1e-10);
        for (int i = 0; i < 4; i++)
            assert_int_equal(cps_evolution_line_report(evolution, i).outcome,
                             i < 2 && falls ? CPS_OUTCOME_UNBOUNDED : CPS_OUTCOME_SOLVED);
        const CpsLineReport report = cps_evolution_line_report(evolution, 1);
        const double down[3] = {0, 0, -1};
        if (falls) CHECK_NEAR(report.proof_force / WEIGHT, 1, 1e-12);
        if (falls) CHECK_VECTOR(report.proof, down, 1e-12);
        cps_evolution_destroy(evolution);
    }
}

/* What held a clump held its weight as well: released to that force, it stays on the way there. */
static void a_clump_that_is_released(void **unused) {
    (void)unused;
    Strings s;
    two_strings(&s);
    s.point[2].kind = CPS_POINT_KIND_HELD;
    CpsEvolution *evolution = evolve(&s.scene);
    const CpsPointReport held = step_to(evolution, 2);
    cps_evolution_destroy(evolution);
    CpsPointChange change = {.point = 2, .kind = CPS_POINT_KIND_FREE, .value = {0}};
    CpsStage stage = cps_stage_default();
    memcpy(change.value, held.support, sizeof change.value);
    change.value[2] += WEIGHT;
    stage.name = "release";
    stage.step_count = 4;
    stage.point_change_count = 1;
    stage.point_change = &change;
    s.scene.stage_count = 1;
    s.scene.stage = &stage;
    evolution = evolve(&s.scene);
    for (int step = 0; step < 5; step++)
        CHECK_VECTOR(step_to(evolution, 2).position, held.position, 1e-9);
    cps_evolution_destroy(evolution);
}

/* Any number of threads gives the same bits, and a far origin the same answer. */
static void threads_and_origin(void **unused) {
    (void)unused;
    Strings near, many, far;
    two_strings(&near);
    two_strings(&many);
    two_strings(&far);
    many.scene.solver.thread_count = 2;
    for (int i = 0; i < 3; i++) far.point[i].position[0] += 1e6;
    CpsEvolution *a = evolve(&near.scene), *b = evolve(&many.scene), *c = evolve(&far.scene);
    const CpsPointReport one = step_to(a, 2), two = step_to(b, 2), three = step_to(c, 2);
    assert_memory_equal(one.position, two.position, sizeof one.position);
    CHECK_NEAR(three.position[0], 1e6, 1e-9);
    CHECK_NEAR(three.position[2], one.position[2], 1e-9);
    cps_evolution_destroy(a);
    cps_evolution_destroy(b);
    cps_evolution_destroy(c);
}

static void expect_refused(const CpsScene *scene, const char *where, const char *part) {
    CpsError err = {0};
    assert_int_not_equal(cps_scene_check(scene, &err), CPS_OK);
    if (!strstr(err.where, where) || !strstr(err.message, part))
        fail_msg("at '%s': %s; expected at '%s': ..%s..", err.where, err.message, where, part);
}

static void what_is_refused(void **unused) {
    (void)unused;
    Strings s;
    CpsPointChange change = {.point = 2, .kind = CPS_POINT_KIND_FREE, .value = {0}};
    CpsChange end_change = {.line = 0, .end = CPS_END_B, .to = {.kind = CPS_END_KIND_HELD}};
    CpsStage stage = cps_stage_default();
    stage.name = "stage";
    two_strings(&s);
    s.line[1].end_point[CPS_END_B] = 3;
    expect_refused(&s.scene, "lines", "point 3: there are 3");
    two_strings(&s);
    s.line[0].end_point[CPS_END_A] = -1;
    expect_refused(&s.scene, "lines", "point -1");
    two_strings(&s);
    s.point[1] = (CpsPoint){.name = "right"};
    expect_refused(&s.scene, "points", "cps_point_default");
    two_strings(&s);
    s.point[1].name = "left";
    expect_refused(&s.scene, "points", "same name");
    two_strings(&s);
    s.point[1].name = "one";
    expect_refused(&s.scene, "points", "a line has the same name");
    two_strings(&s);
    s.line[1].end_point[CPS_END_A] = 0;
    expect_refused(&s.scene, "points.right", "no line ends there");
    two_strings(&s);
    s.point[2].position[1] = NAN;
    expect_refused(&s.scene, "points.knot", "finite");
    two_strings(&s);
    s.point[2].weight = INFINITY;
    expect_refused(&s.scene, "points.knot", "finite");
    two_strings(&s);
    s.point[0].force[0] = 1;
    expect_refused(&s.scene, "points.left", "it is held");
    two_strings(&s);
    s.scene.obstacle_count = 1;
    s.scene.obstacle = &s.bed;
    expect_refused(&s.scene, "points.knot", "1 m below obstacle 'bed'");
    two_strings(&s);
    s.scene.obstacle_count = 1;
    s.scene.obstacle = &s.bed;
    s.bed.point[2] = -5;
    s.bed.has_friction_lateral = true;
    s.bed.friction_lateral = 0.3;
    expect_refused(&s.scene, "points.knot", "friction has directions");
    two_strings(&s);
    s.scene.stage_count = 1;
    s.scene.stage = &stage;
    stage.change_count = 1;
    stage.change = &end_change;
    expect_refused(&s.scene, "history[1].one.B", "change the point instead");
    stage.change_count = 0;
    stage.point_change_count = 1;
    stage.point_change = &change;
    change.point = 3;
    expect_refused(&s.scene, "history[1]", "names point 3");
    change.point = 2;
    change.value[0] = NAN;
    expect_refused(&s.scene, "history[1].knot.point", "finite");
    s.scene.obstacle_count = 1;
    s.scene.obstacle = &s.bed;
    s.bed = cps_obstacle_default();
    s.bed.name = "bed";
    s.bed.point[2] = -5;
    change = (CpsPointChange){.point = 0, .kind = CPS_POINT_KIND_HELD, .value = {-3, 0, -6}};
    expect_refused(&s.scene, "history[1].left.point", "1 m below obstacle 'bed'");
}

/* A line between two free points that nothing holds, pulled apart by F, turns with its loads in one
 * step: it is as long as F makes it, along them, and no farther away than its length. */
static void an_unheld_line_turns(void **unused) {
    (void)unused;
    static const double LONG = 6, PULL = 5, STIFF = 1e4;
    for (int k = 0; k < 9; k++) {
        const double angle = 0.35 * (k + 1), scale = pow(10, k % 3 - 1);
        Strings s;
        two_strings(&s);
        s.scene.line_count = 1;
        s.scene.point_count = 2;
        s.line[0].length = LONG * scale;
        s.line[0].element_count = 1 + k % 3;
        s.line[0].stiffness = STIFF;
        s.line[0].end_point[CPS_END_B] = 1;
        CpsPointChange change[2];
        for (int i = 0; i < 2; i++) {
            const double sign = i == 0 ? -1 : 1;
            s.point[i].kind = CPS_POINT_KIND_FREE;
            s.point[i].position[0] = i * LONG * scale;
            s.point[i].force[0] = sign * PULL;
            change[i] =
                (CpsPointChange){.point = i,
                                 .kind = CPS_POINT_KIND_FREE,
                                 .value = {sign * PULL * cos(angle), sign * PULL * sin(angle), 0}};
        }
        CpsStage stage = cps_stage_default();
        stage.name = "turn";
        stage.point_change = change;
        stage.point_change_count = 2;
        s.scene.stage = &stage;
        s.scene.stage_count = 1;
        CpsEvolution *evolution = evolve(&s.scene);
        step_to(evolution, 0);
        const CpsPointReport a = step_to(evolution, 0),
                             b = cps_evolution_point_report(evolution, 1);
        const double length = LONG * scale * (1 + PULL / STIFF);
        CHECK_NEAR(b.position[0] - a.position[0], length * cos(angle), 1e-6 * length);
        CHECK_NEAR(b.position[1] - a.position[1], length * sin(angle), 1e-6 * length);
        CHECK_NEAR(b.position[2] - a.position[2], 0, 1e-6 * length);
        assert_true(hypot(a.position[0], a.position[1]) < 2 * length);
        cps_evolution_destroy(evolution);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_unheld_line_turns),
        cmocka_unit_test(a_weight_between_two_strings),
        cmocka_unit_test(a_buoy),
        cmocka_unit_test(a_clump_on_a_rough_bed),
        cmocka_unit_test(a_held_point_is_held_ends),
        cmocka_unit_test(moves_of_points),
        cmocka_unit_test(a_light_point_beside_a_heavy_one),
        cmocka_unit_test(a_clump_that_is_released),
        cmocka_unit_test(threads_and_origin),
        cmocka_unit_test(what_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
