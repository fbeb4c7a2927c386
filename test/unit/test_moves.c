/* SPDX-License-Identifier: BSD-3-Clause */
/* Moves beside the history: their answers where these are known, what is refused and why, what
 * follows a target that no line can reach. (That moves have the bits of a history:
 * test/property/random_moves.c.) */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/evolve.h"
#include "check.h"
#include "straight_rope.h"

/* mu w = 0.25 N/m, EA = 10 N: pulled by u, the end carries sqrt(2 mu w EA u) until all slides */
static const double MU = 0.25 / 9.81, WEIGHT = 9.81, EA = 10, LENGTH = 6.28;

static CpsObstacle bed(double far) {
    CpsObstacle plane = cps_obstacle_default();
    plane.name = "bed";
    plane.friction = MU;
    plane.point[0] = far;
    return plane;
}

/* A rope along x on a bed, with a history or without; far: where its end A is. */
static CpsEvolution *rope_at(double far, double stiffness, int obstacles,
                             const CpsObstacle *obstacle, const CpsStage *stage) {
    const double point[6] = {far, 0, 0, far + LENGTH, 0, 0};
    const CpsLine line = straight_rope(point, LENGTH, 200, WEIGHT, stiffness);
    CpsScene scene = cps_scene_default();
    scene.obstacle_count = obstacles;
    scene.obstacle = obstacle;
    scene.line_count = 1;
    scene.line = &line;
    scene.stage_count = stage ? 1 : 0;
    scene.stage = stage;
    CpsEvolution *evolution = NULL;
    CpsError err;
    if (cps_evolution_create(&scene, &evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    return evolution;
}

static CpsStatus move_end(CpsEvolution *evolution, CpsEndKind kind, double x, double y, double z,
                          CpsError *err) {
    const CpsChange change = {.line = 0, .end = CPS_END_B, .to = {kind, {x, y, z}}};
    CpsStage move = cps_stage_default();
    move.change_count = 1;
    move.change = &change;
    return cps_evolution_move(evolution, &move, err);
}

static void expect_move(CpsEvolution *evolution, CpsEndKind kind, double x, double y, double z,
                        CpsOutcome outcome) {
    CpsError err;
    if (move_end(evolution, kind, x, y, z, &err) != CPS_OK) fail_msg("%s", err.message);
    const CpsStepReport report = cps_evolution_report(evolution);
    assert_string_equal(report.name, "move");
    CHECK_INT((int)report.outcome, (int)outcome);
}

static void expect_refused(CpsStatus status, const CpsError *err, const char *words) {
    CHECK_INT((int)status, (int)CPS_ERR_ARGUMENT);
    if (!strstr(err->message, words)) fail_msg("'%s' lacks '%s'", err->message, words);
}

static double tension(const CpsEvolution *evolution) {
    return cps_evolution_line_report(evolution, 0).end[CPS_END_B].tension;
}

static void an_end_that_is_moved_carries_what_friction_does(void **state) {
    (void)state;
    /* the same far from the origin, where the local origin has to be taken from targets as well */
    const double place[] = {0, 4e6};
    for (int k = 0; k < 2; k++) {
        const CpsObstacle plane = bed(place[k]);
        CpsEvolution *evolution = rope_at(place[k], EA, 1, &plane, NULL);
        for (int i = 1; i <= 5; i++) {
            const double u = 0.02 * i;
            expect_move(evolution, CPS_END_KIND_HELD, place[k] + LENGTH + u, 0, 0,
                        CPS_OUTCOME_SOLVED);
            /* the mesh: half an element's friction, squared */
            CHECK_RELATIVE(tension(evolution), sqrt(2 * MU * WEIGHT * EA * u), 1e-3);
            CHECK_INT(cps_evolution_report(evolution).step_count, i);
        }
        /* let go to half the force: the end springs back by the slip of 2 mu (M77's memory) */
        const double force = 0.5 * tension(evolution), before = tension(evolution);
        expect_move(evolution, CPS_END_KIND_FREE, force, 0, 0, CPS_OUTCOME_SOLVED);
        const double u = before * before / (2 * MU * WEIGHT * EA) -
                         (before - force) * (before - force) / (4 * MU * WEIGHT * EA);
        const CpsLineReport report = cps_evolution_line_report(evolution, 0);
        CHECK_NEAR(report.end[CPS_END_B].position[0], place[k] + LENGTH + u, 1e-4);
        cps_evolution_destroy(evolution);
    }
}

static void *saved(const CpsEvolution *evolution) {
    void *bytes = malloc(cps_evolution_state_size(evolution));
    assert_non_null(bytes);
    cps_evolution_save(evolution, bytes);
    return bytes;
}

static void expect_state(const CpsEvolution *evolution, void *before) {
    void *now = saved(evolution);
    assert_memory_equal(before, now, cps_evolution_state_size(evolution));
    free(now);
}

static void a_target_out_of_reach_leaves_the_last_state(void **state) {
    (void)state;
    const CpsObstacle plane = bed(0);
    CpsEvolution *evolution = rope_at(0, INFINITY, 1, &plane, NULL),
                 *other = rope_at(0, INFINITY, 1, &plane, NULL);
    expect_move(evolution, CPS_END_KIND_HELD, LENGTH - 0.1, 0.5, 0, CPS_OUTCOME_SOLVED);
    expect_move(other, CPS_END_KIND_HELD, LENGTH - 0.1, 0.5, 0, CPS_OUTCOME_SOLVED);
    void *before = saved(evolution);
    for (int twice = 0; twice < 2; twice++)
        expect_move(evolution, CPS_END_KIND_HELD, LENGTH + 1, 0, 0, CPS_OUTCOME_INFEASIBLE);
    CHECK_INT(cps_evolution_report(evolution).step_count, 2);
    CHECK_NEAR(cps_evolution_line_report(evolution, 0).proof_length, 1, 1e-9);
    expect_state(evolution, before);
    /* refused nonsense does not count as a move either */
    CpsError err;
    expect_refused(move_end(evolution, CPS_END_KIND_HELD, NAN, 0, 0, &err), &err,
                   "expected finite numbers");
    expect_state(evolution, before);
    expect_move(evolution, CPS_END_KIND_HELD, LENGTH - 0.2, 0.5, 0, CPS_OUTCOME_SOLVED);
    expect_move(other, CPS_END_KIND_HELD, LENGTH - 0.2, 0.5, 0, CPS_OUTCOME_SOLVED);
    const CpsLineView a = cps_evolution_line_view(evolution, 0),
                      b = cps_evolution_line_view(other, 0);
    assert_memory_equal(a.position, b.position, 3 * 201 * sizeof *a.position);
    assert_memory_equal(a.tension, b.tension, 200 * sizeof *a.tension);
    /* taken back in place of the next move */
    expect_move(evolution, CPS_END_KIND_HELD, LENGTH + 1, 0, 0, CPS_OUTCOME_INFEASIBLE);
    assert_int_equal(cps_evolution_take_back(evolution, NULL), CPS_OK);
    CHECK_INT((int)cps_evolution_report(evolution).outcome, (int)CPS_OUTCOME_SOLVED);
    CHECK_INT(cps_evolution_report(evolution).step_count, 2);
    free(before);
    cps_evolution_destroy(other);
    cps_evolution_destroy(evolution);
}

static void a_path_through_an_obstacle_is_refused(void **state) {
    (void)state;
    for (int far = 0; far < 2; far++) {
        const double x = far ? 5e6 : 0;
        CpsObstacle obstacle[2] = {bed(x), cps_obstacle_default()};
        obstacle[1].name = "post";
        obstacle[1].kind = CPS_OBSTACLE_CYLINDER;
        obstacle[1].radius = 0.5;
        obstacle[1].point[0] = x + 5;
        obstacle[1].point[1] = 2;
        obstacle[1].axis[1] = 0;
        obstacle[1].axis[2] = 1;
        CpsEvolution *evolution = rope_at(x, EA, 2, obstacle, NULL);
        CpsError err;
        /* B is free, and grabbed; then held */
        expect_refused(move_end(evolution, CPS_END_KIND_HELD, x + 4, 4, 0, &err), &err,
                       "rope.B is grabbed at");
        expect_move(evolution, CPS_END_KIND_HELD, x + 6, 2, 0, CPS_OUTCOME_SOLVED);
        expect_refused(move_end(evolution, CPS_END_KIND_HELD, x + 4, 2, 0, &err), &err,
                       "through obstacle 'post', up to 0.5 m deep: add way points");
        expect_refused(move_end(evolution, CPS_END_KIND_HELD, x + 5, 2, 0, &err), &err,
                       "is moved to 0.5 m below obstacle 'post'");
        assert_string_equal(err.where, "rope.B");
        expect_move(evolution, CPS_END_KIND_HELD, x + 5, 3, 0, CPS_OUTCOME_SOLVED);
        cps_evolution_destroy(evolution);
    }
}

static void moves_and_stages_alternate(void **state) {
    (void)state;
    const CpsObstacle plane = bed(0);
    const CpsChange pull = {.line = 0,
                            .end = CPS_END_B,
                            .to = {CPS_END_KIND_HELD, {LENGTH + 0.2, 0, 0}}};
    CpsStage stage = cps_stage_default();
    stage.name = "pull";
    stage.step_count = 2;
    stage.change_count = 1;
    stage.change = &pull;
    CpsEvolution *evolution = rope_at(0, EA, 1, &plane, &stage);
    CpsStage heavy = cps_stage_default();
    heavy.name = "heavy";
    heavy.gravity_changes = true;
    heavy.gravity[2] = -4 * 9.81;
    assert_int_equal(cps_evolution_move(evolution, &heavy, NULL), CPS_OK);
    assert_string_equal(cps_evolution_report(evolution).name, "heavy");
    CHECK_INT(cps_evolution_remaining_count(evolution), 2);
    CHECK_INT(cps_evolution_step_count(evolution), 3);
    assert_int_equal(cps_evolution_step(evolution, NULL), CPS_OK);
    assert_string_equal(cps_evolution_report(evolution).name, "pull 1/2");
    /* the gravity of the move stays, and friction with it */
    CHECK_RELATIVE(tension(evolution), sqrt(2 * 4 * MU * WEIGHT * EA * 0.1), 2e-3);
    CpsError err;
    expect_refused(move_end(evolution, CPS_END_KIND_HELD, LENGTH, 0, 0, &err), &err,
                   "stage 'pull' of the history is under way: take its other 1 steps first");
    expect_refused(cps_evolution_take_back(evolution, &err), &err, "no move");
    assert_int_equal(cps_evolution_step(evolution, NULL), CPS_OK);
    CHECK_RELATIVE(tension(evolution), sqrt(2 * 4 * MU * WEIGHT * EA * 0.2), 2e-3);
    CHECK_INT(cps_evolution_remaining_count(evolution), 0);
    expect_move(evolution, CPS_END_KIND_HELD, LENGTH + 0.3, 0, 0, CPS_OUTCOME_SOLVED);
    CHECK_RELATIVE(tension(evolution), sqrt(2 * 4 * MU * WEIGHT * EA * 0.3), 2e-3);
    cps_evolution_destroy(evolution);
}

static void no_move_follows_a_history_that_ended(void **state) {
    (void)state;
    const CpsObstacle plane = bed(0);
    const CpsChange tear = {.line = 0,
                            .end = CPS_END_B,
                            .to = {CPS_END_KIND_HELD, {2 * LENGTH, 0, 0}}};
    CpsStage stage = cps_stage_default();
    stage.name = "tear";
    stage.change_count = 1;
    stage.change = &tear;
    CpsEvolution *evolution = rope_at(0, INFINITY, 1, &plane, &stage);
    void *before = saved(evolution);
    assert_int_equal(cps_evolution_step(evolution, NULL), CPS_OK);
    CHECK_INT((int)cps_evolution_report(evolution).outcome, (int)CPS_OUTCOME_INFEASIBLE);
    CpsError err;
    expect_refused(move_end(evolution, CPS_END_KIND_HELD, LENGTH, 0, 0, &err), &err,
                   "the history ended in a step without an equilibrium");
    assert_int_equal(cps_evolution_load(evolution, before, cps_evolution_state_size(evolution),
                                        NULL),
                     CPS_OK);
    expect_move(evolution, CPS_END_KIND_HELD, LENGTH - 0.1, 0, 0, CPS_OUTCOME_SOLVED);
    free(before);
    cps_evolution_destroy(evolution);
}

static bool always(void *user) { return ++*(int *)user > 0; }

static void an_interrupted_move_has_no_effect(void **state) {
    (void)state;
    const CpsObstacle plane = bed(0);
    CpsEvolution *evolution = rope_at(0, EA, 1, &plane, NULL);
    expect_move(evolution, CPS_END_KIND_HELD, LENGTH + 0.1, 0, 0, CPS_OUTCOME_SOLVED);
    void *before = saved(evolution);
    int asked = 0;
    assert_int_equal(cps_evolution_interrupt(evolution, always, &asked, NULL), CPS_OK);
    CpsError err;
    CHECK_INT((int)move_end(evolution, CPS_END_KIND_HELD, LENGTH, 1, 0, &err),
              (int)CPS_ERR_INTERRUPTED);
    assert_true(asked > 0);
    expect_state(evolution, before);
    expect_refused(cps_evolution_take_back(evolution, &err), &err, "no move");
    free(before);
    cps_evolution_destroy(evolution);
}

static void nonsense_is_refused(void **state) {
    (void)state;
    const CpsObstacle plane = bed(0);
    CpsEvolution *evolution = rope_at(0, EA, 1, &plane, NULL);
    void *before = saved(evolution);
    CpsError err;
    CpsStage move = cps_stage_default();
    expect_refused(cps_evolution_move(NULL, &move, &err), &err, "both needed");
    expect_refused(cps_evolution_move(evolution, NULL, &err), &err, "both needed");
    expect_refused(cps_evolution_take_back(NULL, &err), &err, "NULL");
    expect_refused(cps_evolution_take_back(evolution, &err), &err, "no move");
    move.cookie = 0;
    expect_refused(cps_evolution_move(evolution, &move, &err), &err,
                   "move '': not made by cps_stage_default()");
    move = cps_stage_default();
    move.name = "jerk";
    move.step_count = 2;
    expect_refused(cps_evolution_move(evolution, &move, &err), &err,
                   "move 'jerk': steps is 2: a move is one step");
    move.step_count = 1;
    move.change_count = 1; /* and no array */
    expect_refused(cps_evolution_move(evolution, &move, &err), &err, "found 1 changes");
    move.change_count = 0;
    move.turn_count = -1;
    expect_refused(cps_evolution_move(evolution, &move, &err), &err, "found -1 turns");
    const CpsTurn turn = {.obstacle = 0, .angle = 1};
    move.turn_count = 1;
    move.turn = &turn;
    expect_refused(cps_evolution_move(evolution, &move, &err), &err, "is a plane");
    expect_state(evolution, before);
    free(before);
    cps_evolution_destroy(evolution);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_end_that_is_moved_carries_what_friction_does),
        cmocka_unit_test(a_target_out_of_reach_leaves_the_last_state),
        cmocka_unit_test(a_path_through_an_obstacle_is_refused),
        cmocka_unit_test(moves_and_stages_alternate),
        cmocka_unit_test(no_move_follows_a_history_that_ended),
        cmocka_unit_test(an_interrupted_move_has_no_effect),
        cmocka_unit_test(nonsense_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
