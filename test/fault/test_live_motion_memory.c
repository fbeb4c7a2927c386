/* SPDX-License-Identifier: BSD-3-Clause */
/* Memory runs out while a program moves a line with drag and damping, a clump and a body with a
 * member in waves, with and without its velocity, and takes moves back, saves states and gives them
 * to another evolution. Each allocation is refused once: the call says so and leaves the state as
 * it was, byte by byte, and when it is made again all goes on to the same bits; everything is given
 * back. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "capstan/follow.h"
#include "refuse.h"

enum { ELEMENTS = 8, NUMBERS = 2 * 3 * (ELEMENTS + 1), ROOM = 1 << 17 };

static CpsError err;

typedef struct Sea {
    CpsLine line[2];
    CpsPoint point[3];
    CpsBody body;
    CpsMember member;
    CpsWave wave;
    CpsWaves waves;
    CpsCurrentRow row;
    CpsCurrent current;
    CpsLineLoads loads;
    CpsScene scene;
} Sea;

static const double AT[3][3] = {{0, 0, 0}, {3, 0, -1}, {5, 0, 1}};

static void make_line(Sea *sea, int i) {
    CpsLine *line = &sea->line[i];
    *line = cps_line_default();
    line->name = i ? "b" : "a";
    line->length = sqrt(i ? 8 : 10);
    line->element_count = ELEMENTS;
    line->weight = 9.81;
    line->stiffness = 1e4;
    line->inertia = 1;
    line->quasi_static = i == 1;
    line->damping = i ? 0 : 30;
    if (i == 0) line->loads = &sea->loads;
    line->start = (CpsStart){.kind = CPS_START_STRAIGHT, .point_count = 2, .point = AT[i]};
    for (int end = 0; end < 2; end++) {
        line->end[end].kind = CPS_END_KIND_POINT;
        line->end_point[end] = i + end;
    }
}

static void make(Sea *sea) {
    static const char *const NAME[] = {"anchor", "clump", "eye"};
    *sea = (Sea){.member = {.to = {1, 0, 1}, .diameter = 0.1, .normal = 1, .added_normal = 1},
                 .wave = {.amplitude = 0.2, .period = 3},
                 .loads = {.drag = {.diameter = 0.02, .normal = 1.2, .added_normal = 1}},
                 .body = cps_body_default(),
                 .scene = cps_scene_default()};
    sea->waves = (CpsWaves){.depth = 20, .wave_count = 1, .wave = &sea->wave};
    sea->current =
        (CpsCurrent){.density = 1000, .row_count = 1, .row = &sea->row, .waves = &sea->waves};
    sea->body.name = "body";
    sea->body.kind = CPS_BODY_KIND_FREE;
    sea->body.mass = 5;
    sea->body.weight = 49;
    memcpy(sea->body.position, AT[2], sizeof AT[2]);
    for (int i = 0; i < 3; i++) sea->body.inertia[i] = 2;
    sea->body.member_count = 1;
    sea->body.member = &sea->member;
    for (int i = 0; i < 3; i++) {
        sea->point[i] = cps_point_default();
        sea->point[i].name = NAME[i];
        if (i < 2) memcpy(sea->point[i].position, AT[i], sizeof AT[i]);
    }
    sea->point[1].kind = CPS_POINT_KIND_FREE;
    sea->point[1].weight = 20;
    sea->point[1].inertia = 2;
    sea->point[2].kind = CPS_POINT_KIND_ON_BODY;
    for (int i = 0; i < 2; i++) make_line(sea, i);
    sea->scene.in_time = true;
    sea->scene.has_water_surface = true;
    sea->scene.water_surface = 4;
    sea->scene.current = &sea->current;
    sea->scene.line_count = 2;
    sea->scene.line = sea->line;
    sea->scene.point_count = 3;
    sea->scene.point = sea->point;
    sea->scene.body_count = 1;
    sea->scene.body = &sea->body;
}

/* What the calls need, and what came of them. */
typedef struct Run {
    const CpsScene *scene;
    CpsEvolution *evolution, *other;
    CpsPointChange change;
    double place[NUMBERS];
} Run;

static unsigned char kept[ROOM], now[ROOM], saved[ROOM];

static bool sway(void *user, double time, const CpsEvolution *evolution, CpsStage *step) {
    Run *run = user;
    (void)evolution;
    run->change = (CpsPointChange){.point = 0, .value = {0.3 * time, 0, 0.1 * time}};
    step->point_change = &run->change;
    step->point_change_count = 1;
    return true;
}

static CpsStatus create(Run *run) {
    return cps_evolution_create(run->scene, &run->evolution, &err);
}
static CpsStatus move(Run *run) {
    CpsStage stage = cps_stage_default();
    stage.duration = 0.05;
    return cps_evolution_move(run->evolution, &stage, &err);
}
static CpsStatus lead(Run *run) { /* with the velocity of the anchor */
    CpsStage stage = cps_stage_default();
    run->change = (CpsPointChange){.point = 0,
                                   .value = {0.01, 0, 0.002},
                                   .has_velocity = true,
                                   .velocity = {0.4, 0, 0.1}};
    stage.duration = 0.05;
    stage.point_change = &run->change;
    stage.point_change_count = 1;
    return cps_evolution_move(run->evolution, &stage, &err);
}
static CpsStatus follow(Run *run) {
    return cps_evolution_follow(run->evolution, 0.1, 2, sway, run, &err);
}
static CpsStatus take_back(Run *run) { return cps_evolution_take_back(run->evolution, &err); }
static CpsStatus create_other(Run *run) {
    return cps_evolution_create(run->scene, &run->other, &err);
}
static CpsStatus hand_over(Run *run) {
    const size_t size = cps_evolution_state_size(run->evolution);
    cps_evolution_save(run->evolution, saved);
    const CpsStatus status = cps_evolution_load(run->other, saved, size, &err);
    if (status != CPS_OK) return status;
    CpsEvolution *swap = run->evolution;
    run->evolution = run->other;
    run->other = swap;
    return CPS_OK;
}
static CpsStatus settle(Run *run) {
    CpsStage stage = cps_stage_default();
    return cps_evolution_move(run->evolution, &stage, &err);
}

typedef CpsStatus Call(Run *run);
static Call *const CALL[] = {create,    move,   take_back, move, lead,         take_back,
                             lead,      follow, take_back, move, create_other, lead,
                             hand_over, follow, settle,    move};
enum { CALLS = sizeof CALL / sizeof *CALL };

/* All calls, each again where memory was refused; returns how many were refused. */
static int live_through(Run *run) {
    int refused = 0;
    for (int k = 0; k < CALLS; k++) {
        const size_t size = cps_evolution_state_size(run->evolution);
        assert_true(size <= ROOM);
        cps_evolution_save(run->evolution, kept);
        CpsStatus status = CALL[k](run);
        if (status == CPS_OK) continue;
        if (status != CPS_ERR_MEMORY || err.status != status || !err.message[0])
            fail_msg("call %d: %s: %s", k, cps_status_name(status), err.message);
        allowed = -1;
        refused++;
        assert_int_equal(cps_evolution_state_size(run->evolution), size);
        cps_evolution_save(run->evolution, now);
        if (memcmp(kept, now, size) != 0) fail_msg("call %d left something behind", k);
        status = CALL[k](run);
        if (status != CPS_OK) fail_msg("call %d again: %s", k, err.message);
    }
    for (int i = 0; i < 2; i++) {
        const CpsLineView view = cps_evolution_line_view(run->evolution, i);
        memcpy(&run->place[i * NUMBERS / 2], view.position, NUMBERS / 2 * sizeof(double));
    }
    assert_true(cps_outcome_is_certified(cps_evolution_report(run->evolution).outcome));
    cps_evolution_destroy(run->evolution);
    cps_evolution_destroy(run->other);
    return refused;
}

static void each_allocation(void **state) {
    (void)state;
    static Sea sea;
    make(&sea);
    Run usual = {.scene = &sea.scene};
    assert_int_equal(live_through(&usual), 0);
    long tried = 0, refused = 0;
    for (bool reached = true; reached; tried++) {
        Run run = {.scene = &sea.scene};
        const long before = live;
        allowed = tried;
        const int count = live_through(&run);
        reached = count > 0 || allowed < 0;
        allowed = -1;
        refused += count;
        if (live != before) fail_msg("allocation %ld: %ld blocks lost", tried, live - before);
        if (memcmp(run.place, usual.place, sizeof run.place) != 0)
            fail_msg("allocation %ld: other bits", tried);
    }
    if (refused == 0) skip(); /* built as shared libraries they cannot be reached */
    print_message("%ld allocations, each refused\n", refused);
    assert_int_equal(refused, tried - 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_allocation)};
    return cmocka_run_group_tests_name("motion without memory", tests, NULL, NULL);
}
