/* SPDX-License-Identifier: BSD-3-Clause */
/* Ends that are let go and lines that part (capstan/failure.h): springs in parallel by hand, a rope
 * that hangs from what is left, the order of breaks, and moves taken back. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/failure.h"
#include "check.h"

/* Weightless bars side by side along x, each from its anchor at x = 0 to a knot which is pulled
 * along x: T = k (x - l), so n bars share the pull, and the nearest to its break_at goes first. */
enum { BARS = 3, KNOT = 0, ANCHORS = 1, STEPS = 4 };
static const double LENGTH = 10, EA = 1e5, PULL = 3000;

typedef struct Bars {
    CpsLine line[BARS];
    CpsPoint point[1 + BARS];
    CpsPointChange pull, more;
    CpsChange release;
    CpsStage stage[3];
    CpsScene scene;
} Bars;

static void bars(Bars *b, const double break_at[BARS]) {
    static const char *const LINE[BARS] = {"low", "middle", "high"}, *const POINT[1 + BARS] = {
                                                                         "knot", "first", "second",
                                                                         "third"};
    *b = (Bars){.scene = cps_scene_default()};
    memset(b->scene.gravity, 0, sizeof b->scene.gravity);
    for (int i = 0; i <= BARS; i++) {
        b->point[i] = cps_point_default();
        b->point[i].name = POINT[i];
    }
    b->point[KNOT].kind = CPS_POINT_KIND_FREE;
    b->point[KNOT].position[0] = LENGTH;
    for (int i = 0; i < BARS; i++) {
        b->line[i] = cps_line_default();
        b->line[i].name = LINE[i];
        b->line[i].length = LENGTH;
        b->line[i].element_count = 4;
        b->line[i].stiffness = EA;
        b->line[i].start.kind = CPS_START_STATIC;
        b->line[i].end[CPS_END_A].kind = CPS_END_KIND_POINT;
        b->line[i].end_point[CPS_END_A] = ANCHORS + i;
        b->line[i].end[CPS_END_B].kind = CPS_END_KIND_POINT;
        b->line[i].end_point[CPS_END_B] = KNOT;
        b->line[i].has_break_at = break_at[i] > 0;
        b->line[i].break_at = break_at[i];
    }
    b->pull = (CpsPointChange){.point = KNOT, .kind = CPS_POINT_KIND_FREE, .value = {PULL, 0, 0}};
    b->stage[0] = cps_stage_default();
    b->stage[0].name = "pull";
    b->stage[0].step_count = STEPS;
    b->stage[0].point_change_count = 1;
    b->stage[0].point_change = &b->pull;
    b->scene.line_count = BARS;
    b->scene.line = b->line;
    b->scene.point_count = 1 + BARS;
    b->scene.point = b->point;
    b->scene.stage_count = 1;
    b->scene.stage = b->stage;
}

static CpsEvolution *evolve(const CpsScene *scene) {
    CpsEvolution *evolution = NULL;
    CpsError err;
    if (cps_evolution_create(scene, &evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    return evolution;
}

static CpsOutcome step(CpsEvolution *evolution) {
    CpsError err;
    if (cps_evolution_step(evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    return cps_evolution_report(evolution).outcome;
}

/* The history of bars at full pull in STEPS: in each step bars that are whole share pull k/STEPS;
 * the first in order of share that is above parts, and the others are looked at again. */
static void bars_part_in_order(void **state) {
    (void)state;
    static const double BREAK_AT[][BARS] = {{600, 0, 0},      {600, 1100, 0},     {1100, 600, 1900},
                                            {800, 850, 1600}, {2000, 2100, 2200}, {700, 700, 0}};
    for (size_t c = 0; c < sizeof BREAK_AT / sizeof *BREAK_AT; c++) {
        Bars b;
        bars(&b, BREAK_AT[c]);
        CpsEvolution *evolution = evolve(&b.scene);
        bool whole[BARS] = {true, true, true};
        int left = BARS, breaks = 0;
        CHECK_INT(step(evolution), CPS_OUTCOME_SOLVED);
        for (int k = 1; k <= STEPS; k++) {
            const double pull = PULL * k / STEPS;
            CHECK_INT(step(evolution), CPS_OUTCOME_SOLVED);
            assert_false(cps_evolution_break(evolution).is_break);
            for (bool again = true; again;) {
                int worst = -1;
                double most = 1;
                for (int i = 0; i < BARS; i++) {
                    const CpsLineReport report = cps_evolution_line_report(evolution, i);
                    const double want = whole[i] ? pull / left : 0;
                    /* rounding of places of 10 m beside strains of 1e-2: 1e-13 */
                    CHECK_NEAR(report.end[CPS_END_B].tension, want, 1e-9 * pull);
                    const CpsLineFailure failure = cps_evolution_line_failure(evolution, i);
                    CHECK_INT(failure.release[CPS_END_A], CPS_RELEASE_NONE);
                    CHECK_INT(failure.release[CPS_END_B],
                              whole[i] ? CPS_RELEASE_NONE : CPS_RELEASE_BY_BREAK);
                    CHECK_INT(failure.has_break_at, BREAK_AT[c][i] > 0);
                    if (BREAK_AT[c][i] > 0) CHECK_NEAR(failure.share, want / BREAK_AT[c][i], 1e-9);
                    if (whole[i] && BREAK_AT[c][i] > 0 && want / BREAK_AT[c][i] > most) {
                        most = want / BREAK_AT[c][i];
                        worst = i;
                    }
                }
                again = worst >= 0;
                CHECK_INT(cps_evolution_breaks(evolution), again);
                if (!again) break;
                const int before = cps_evolution_remaining_count(evolution);
                const CpsOutcome outcome = step(evolution);
                const CpsBreak parted = cps_evolution_break(evolution);
                assert_true(parted.is_break);
                CHECK_INT(parted.line, worst);
                CHECK_INT(parted.end, CPS_END_B); /* of equals B */
                CHECK_NEAR(parted.tension, pull / left, 1e-9 * pull);
                CHECK_NEAR(parted.break_at, BREAK_AT[c][worst], 0);
                breaks++;
                whole[worst] = false;
                left--;
                if (left == 0) { /* nothing holds the knot */
                    CHECK_INT(outcome, CPS_OUTCOME_UNBOUNDED);
                    CHECK_INT(cps_evolution_remaining_count(evolution), 0);
                    k = STEPS;
                    break;
                }
                CHECK_INT(outcome, CPS_OUTCOME_SOLVED);
                CHECK_INT(cps_evolution_remaining_count(evolution),
                          before - 1 + cps_evolution_breaks(evolution));
            }
        }
        printf("case %zu: %d breaks, %d bars left\n", c, breaks, left);
        cps_evolution_destroy(evolution);
    }
}

/* A rope on two points, let go at B: it hangs from A, T = w (L - s), and its end is w L^2 / (2 EA)
 * below its length: exact for elements of one weight, whose tensions are those in their middles. */
static void what_is_let_go_hangs(void **state) {
    (void)state;
    static const double WEIGHT = 40;
    Bars b;
    bars(&b, (double[BARS]){0});
    b.scene.gravity[2] = -9.81;
    b.scene.line_count = 1;
    b.scene.point_count = 2;
    b.scene.stage_count = 3;
    b.point[KNOT].kind = CPS_POINT_KIND_HELD;
    b.line[0].weight = WEIGHT;
    b.release = (CpsChange){.line = 0, .end = CPS_END_B, .to = {.kind = CPS_END_KIND_RELEASED}};
    CpsChange grab = {.line = 0, .end = CPS_END_B, .to = {CPS_END_KIND_HELD, {3, 0, -9}}};
    for (int i = 0; i < 3; i++) {
        b.stage[i] = cps_stage_default();
        b.stage[i].name = "stage";
    }
    b.stage[1].change = &b.release;
    b.stage[2].change = &grab;
    b.stage[1].change_count = b.stage[2].change_count = 1;
    CpsEvolution *evolution = evolve(&b.scene);
    for (int i = 0; i < 3; i++) CHECK_INT(step(evolution), CPS_OUTCOME_SOLVED);
    const CpsLineReport report = cps_evolution_line_report(evolution, 0);
    const double lower[3] = {0, 0, -LENGTH - WEIGHT * LENGTH * LENGTH / (2 * EA)};
    CHECK_VECTOR(report.end[CPS_END_B].position, lower, 1e-9 * LENGTH);
    CHECK_RELATIVE(report.end[CPS_END_A].tension, WEIGHT * LENGTH, 1e-9);
    CHECK_INT(cps_evolution_line_failure(evolution, 0).release[CPS_END_B], CPS_RELEASE_BY_STAGE);
    CHECK_NEAR(report.ledger.ends, 0, 1e-12); /* nothing pulls at B, and A stays */
    /* the energy that the fall sets free is the imbalance */
    CHECK_NEAR(report.ledger.imbalance, -report.ledger.gravity - report.ledger.elastic, 1e-9);
    CHECK_GREATER(report.ledger.imbalance, 100);
    /* a later stage takes hold of it where it is */
    CHECK_INT(step(evolution), CPS_OUTCOME_SOLVED);
    CHECK_VECTOR(cps_evolution_line_report(evolution, 0).end[CPS_END_B].position, grab.to.value,
                 1e-12);
    CHECK_INT(cps_evolution_line_failure(evolution, 0).release[CPS_END_B], CPS_RELEASE_TAKEN);
    cps_evolution_destroy(evolution);
}

/* A move that lets go, taken back; a move that makes a bar part, saved with the break due; and no
 * move before it. */
static void moves_let_go_and_are_taken_back(void **state) {
    (void)state;
    Bars b;
    bars(&b, (double[BARS]){0, 0, 1200});
    b.scene.stage_count = 0;
    CpsEvolution *evolution = evolve(&b.scene);
    CpsError err;
    CHECK_INT(step(evolution), CPS_OUTCOME_SOLVED);
    b.stage[0].step_count = 1;
    CHECK_INT(cps_evolution_move(evolution, &b.stage[0], &err), CPS_OK);
    const size_t size = cps_evolution_state_size(evolution);
    unsigned char *before = malloc(size), *after = malloc(size);
    assert_true(before && after);
    b.release = (CpsChange){.line = 1, .end = CPS_END_B, .to = {.kind = CPS_END_KIND_RELEASED}};
    CpsStage move = cps_stage_default();
    move.change_count = 1;
    move.change = &b.release;
    cps_evolution_save(evolution, before);
    CHECK_INT(cps_evolution_move(evolution, &move, &err), CPS_OK);
    CHECK_NEAR(cps_evolution_line_report(evolution, 0).end[0].tension, PULL / 2, 1e-9 * PULL);
    CHECK_INT(cps_evolution_line_failure(evolution, 1).release[CPS_END_B], CPS_RELEASE_BY_STAGE);
    CHECK_INT(cps_evolution_take_back(evolution, &err), CPS_OK);
    cps_evolution_save(evolution, after);
    assert_memory_equal(before, after, size);
    CHECK_INT(cps_evolution_line_failure(evolution, 1).release[CPS_END_B], CPS_RELEASE_NONE);
    /* again, and now bar 2 carries PULL/2 > 1200 N: it parts next */
    CHECK_INT(cps_evolution_move(evolution, &move, &err), CPS_OK);
    CHECK_INT(cps_evolution_breaks(evolution), true);
    CHECK_INT(cps_evolution_remaining_count(evolution), 1);
    CHECK_INT(cps_evolution_move(evolution, &b.stage[0], &err), CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "above its break_at"));
    cps_evolution_save(evolution, before);
    CHECK_INT(step(evolution), CPS_OUTCOME_SOLVED);
    cps_evolution_save(evolution, after);
    CHECK_NEAR(cps_evolution_line_report(evolution, 0).end[0].tension, PULL, 1e-9 * PULL);
    CHECK_INT(cps_evolution_take_back(evolution, &err), CPS_ERR_ARGUMENT);
    /* from the state with the break due, in another evolution, the same bits but for the time */
    CpsEvolution *other = evolve(&b.scene);
    if (cps_evolution_load(other, before, size, &err) != CPS_OK) fail_msg("%s", err.message);
    CHECK_INT(cps_evolution_breaks(other), true);
    CHECK_INT(step(other), CPS_OUTCOME_SOLVED);
    for (int i = 0; i < BARS; i++) {
        const CpsLineView one = cps_evolution_line_view(evolution, i),
                          two = cps_evolution_line_view(other, i);
        assert_memory_equal(one.position, two.position, 15 * sizeof(double));
        assert_memory_equal(one.segment_force, two.segment_force, 12 * sizeof(double));
    }
    const CpsBreak parted = cps_evolution_break(other);
    CHECK_INT(parted.is_break && parted.line == 2 && parted.end == CPS_END_B, true);
    /* a move may take hold of what has parted */
    CpsChange hold = {.line = 2, .end = CPS_END_B, .to = {CPS_END_KIND_HELD, {LENGTH, 1, 0}}};
    move.change = &hold;
    CHECK_INT(cps_evolution_move(other, &move, &err), CPS_OK);
    CHECK_INT(cps_evolution_line_failure(other, 2).release[CPS_END_B], CPS_RELEASE_TAKEN);
    free(before);
    free(after);
    cps_evolution_destroy(other);
    cps_evolution_destroy(evolution);
}

/* A rope pulled at its held end B beyond its break_at by a stage of several steps parts there, and
 * what the stage says of that end afterwards is left alone; with the ends exchanged too. */
static void a_stage_leaves_alone_what_has_parted(void **state) {
    (void)state;
    for (int end = 0; end < 2; end++) {
        CpsScene scene = cps_scene_default();
        memset(scene.gravity, 0, sizeof scene.gravity);
        CpsLine line = cps_line_default();
        double point[6] = {0, 0, 0, LENGTH, 0, 0};
        CpsChange pull = {.line = 0, .end = end, .to = {CPS_END_KIND_HELD, {0}}};
        pull.to.value[0] = end == CPS_END_B ? LENGTH + 1 : -1;
        CpsStage stage[2] = {cps_stage_default(), cps_stage_default()};
        stage[0].name = stage[1].name = "pull";
        stage[0].step_count = 5;
        stage[0].change_count = stage[1].change_count = 1;
        stage[0].change = stage[1].change = &pull;
        line.name = "rope";
        line.length = LENGTH;
        line.element_count = 5;
        line.stiffness = EA;
        line.start = (CpsStart){.kind = CPS_START_STRAIGHT, .point_count = 2, .point = point};
        for (int e = 0; e < 2; e++) line.end[e].kind = CPS_END_KIND_AT_START;
        line.has_break_at = true;
        line.break_at = 5000; /* EA times 0.05: half way through the stage */
        scene.line_count = 1;
        scene.line = &line;
        scene.stage_count = 2;
        scene.stage = stage;
        CpsEvolution *evolution = evolve(&scene);
        int taken = 0, breaks = 0;
        for (; cps_evolution_remaining_count(evolution) > 0; taken++) {
            CHECK_INT(step(evolution), CPS_OUTCOME_SOLVED);
            const CpsBreak parted = cps_evolution_break(evolution);
            if (!parted.is_break) continue;
            CHECK_INT(taken, 3); /* after 0.06 in the third step */
            /* equally taut all along, of equals B */
            CHECK_INT(parted.end, CPS_END_B);
            CHECK_RELATIVE(parted.tension, 6000, 1e-9);
            breaks++;
        }
        CHECK_INT(breaks, 1);
        CHECK_INT(taken, 7);
        const CpsLineView view = cps_evolution_line_view(evolution, 0);
        CHECK_INT(view.end[CPS_END_B].kind, CPS_END_KIND_FREE);
        CHECK_INT(view.end[CPS_END_A].kind, CPS_END_KIND_HELD);
        CHECK_NEAR(view.end[CPS_END_A].value[0], end == CPS_END_A ? -1 : 0, 1e-15);
        for (int e = 0; e < 5; e++) CHECK_NEAR(view.tension[e], 0, 1e-9 * EA);
        cps_evolution_destroy(evolution);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bars_part_in_order),
        cmocka_unit_test(what_is_let_go_hangs),
        cmocka_unit_test(moves_let_go_and_are_taken_back),
        cmocka_unit_test(a_stage_leaves_alone_what_has_parted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
