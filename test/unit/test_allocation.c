/* SPDX-License-Identifier: BSD-3-Clause */
/* Memory: stepping allocates nothing; creating survives every failing allocation and leaks nothing.
 * malloc and its kin are replaced by wrappers that count and can be told to fail (linked with
 * --wrap). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/evolve.h"
#include "check.h"

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *place, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void __real_free(void *place);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *place, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
void __wrap_free(void *place);

static int allocations, live, fail_at = -1;

static bool refuse(void) { return allocations++ == fail_at; }
static void *counted(void *place) {
    live += place != NULL;
    return place;
}
void *__wrap_malloc(size_t size) { return refuse() ? NULL : counted(__real_malloc(size)); }
void *__wrap_calloc(size_t count, size_t size) {
    return refuse() ? NULL : counted(__real_calloc(count, size));
}
void *__wrap_realloc(void *place, size_t size) {
    if (refuse()) return NULL;
    void *moved = __real_realloc(place, size);
    return place ? moved : counted(moved);
}
void *__wrap_aligned_alloc(size_t alignment, size_t size) {
    return refuse() ? NULL : counted(__real_aligned_alloc(alignment, size));
}
void __wrap_free(void *place) {
    live -= place != NULL;
    __real_free(place);
}

static const double ends[] = {0, 0, 0, 6.28, 0, 0};
static const CpsChange pull = {.line = 0,
                               .end = CPS_END_B,
                               .to = {CPS_END_KIND_FREE, {0.5, 0.5, 0.5}}};
static CpsStage stage;

static CpsScene scene(const CpsObstacle *bed, const CpsLine *line) {
    stage = cps_stage_default();
    stage.name = "pull";
    stage.step_count = 3;
    stage.change_count = 1;
    stage.change = &pull;
    CpsScene out = cps_scene_default();
    out.obstacle_count = out.line_count = out.stage_count = 1;
    out.obstacle = bed;
    out.line = line;
    out.stage = &stage;
    return out;
}

static CpsLine rope(void) {
    CpsLine line = cps_line_default();
    line.name = "rope";
    line.length = 6.28;
    line.element_count = 50;
    line.weight = 9.81;
    line.stiffness = 10;
    line.start = (CpsStart){.kind = CPS_START_STRAIGHT, .point_count = 2, .point = ends};
    return line;
}

static CpsObstacle rough(void) {
    CpsObstacle bed = cps_obstacle_default();
    bed.name = "bed";
    bed.friction = 0.0255;
    return bed;
}

/* Steps of a line of this stiffness take no memory; those of an inextensible one choose among
 * forces, and look for their range. */
static void step_all(double stiffness) {
    CpsLine line = rope();
    line.stiffness = stiffness;
    const CpsObstacle bed = rough();
    const CpsScene s = scene(&bed, &line);
    CpsEvolution *evolution;
    assert_int_equal(cps_evolution_create(&s, &evolution, NULL), CPS_OK);
    const int before = allocations;
    while (cps_evolution_remaining_count(evolution) > 0) {
        assert_int_equal(cps_evolution_step(evolution, NULL), CPS_OK);
        assert_int_equal(cps_evolution_report(evolution).outcome, CPS_OUTCOME_SOLVED);
    }
    CHECK_INT(allocations, before);
    cps_evolution_destroy(evolution);
}

/* Steps in time neither: a clump between a line with inertia and a quasi-static one, which ends at
 * a body. */
static void motion_allocates_nothing(void **unused) {
    (void)unused;
    static const char *const NAME[] = {"a", "b", "anchor", "clump", "eye"};
    static const double AT[][3] = {{0, 0, 0}, {3, 0, -1}, {5, 0, 1}};
    CpsLine line[2];
    CpsPoint point[3];
    CpsBody body = cps_body_default();
    CpsStage swing = cps_stage_default();
    swing.name = "swing";
    swing.duration = 0.5;
    swing.step_count = 20;
    body.name = "body";
    body.kind = CPS_BODY_KIND_FREE;
    body.mass = 5;
    body.weight = 49;
    body.position[0] = AT[2][0];
    body.position[2] = AT[2][2];
    for (int i = 0; i < 3; i++) body.inertia[i] = 2;
    const CpsMember member = {.to = {1, 0, 1}, .diameter = 0.1, .normal = 1, .added_normal = 1};
    const CpsWave wave = {.amplitude = 0.2, .period = 3};
    const CpsWaves waves = {.depth = 20, .wave_count = 1, .wave = &wave};
    const CpsCurrentRow still = {.z = 0};
    const CpsCurrent water = {.density = 1000, .row_count = 1, .row = &still, .waves = &waves};
    body.member_count = 1;
    body.member = &member;
    for (int i = 0; i < 3; i++) {
        point[i] = cps_point_default();
        point[i].name = NAME[2 + i];
        if (i < 2) memcpy(point[i].position, AT[i], sizeof AT[i]);
    }
    point[1].kind = CPS_POINT_KIND_FREE;
    point[1].weight = 20;
    point[1].inertia = 2;
    point[2].kind = CPS_POINT_KIND_ON_BODY;
    for (int i = 0; i < 2; i++) {
        line[i] = rope();
        line[i].name = NAME[i];
        line[i].length = i == 0 ? sqrt(10) : sqrt(8);
        line[i].element_count = 8;
        line[i].stiffness = 1e4;
        line[i].inertia = 1;
        line[i].quasi_static = i == 1;
        line[i].start = (CpsStart){.kind = CPS_START_STRAIGHT, .point_count = 2, .point = AT[i]};
        for (int end = 0; end < 2; end++) {
            line[i].end[end].kind = CPS_END_KIND_POINT;
            line[i].end_point[end] = i + end;
        }
    }
    CpsScene s = cps_scene_default();
    s.line_count = 2;
    s.line = line;
    s.point_count = 3;
    s.point = point;
    s.current = &water;
    s.has_water_surface = true;
    s.water_surface = 1.3;
    s.body_count = s.stage_count = 1;
    s.body = &body;
    s.stage = &swing;
    CpsEvolution *evolution;
    CpsError err;
    if (cps_evolution_create(&s, &evolution, &err)) fail_msg("%s", err.message);
    const int before = allocations;
    while (cps_evolution_remaining_count(evolution) > 0) {
        assert_int_equal(cps_evolution_step(evolution, NULL), CPS_OK);
        assert_true(cps_outcome_is_certified(cps_evolution_report(evolution).outcome));
    }
    CHECK_INT(allocations, before);
    cps_evolution_destroy(evolution);
}

static void stepping_allocates_nothing(void **unused) {
    (void)unused;
    step_all(10);
    step_all(INFINITY);
}

/* Moves: only the first one takes memory, for the state before it. */
static void moving_allocates_once(void **unused) {
    (void)unused;
    const CpsLine line = rope();
    const CpsObstacle bed = rough();
    CpsScene s = scene(&bed, &line);
    s.stage_count = 0;
    CpsStage move = cps_stage_default();
    move.change_count = 1;
    move.change = &pull;
    CpsEvolution *evolution;
    assert_int_equal(cps_evolution_create(&s, &evolution, NULL), CPS_OK);
    fail_at = allocations;
    CHECK_INT(cps_evolution_move(evolution, &move, NULL), CPS_ERR_MEMORY);
    fail_at = -1;
    CHECK_INT(cps_evolution_report(evolution).step_count, 0);
    assert_int_equal(cps_evolution_move(evolution, &move, NULL), CPS_OK);
    const int before = allocations;
    for (int i = 0; i < 3; i++) {
        assert_int_equal(cps_evolution_move(evolution, &move, NULL), CPS_OK);
        assert_int_equal(cps_evolution_report(evolution).outcome, CPS_OUTCOME_SOLVED);
        if (i == 1) assert_int_equal(cps_evolution_take_back(evolution, NULL), CPS_OK);
    }
    CpsGraspChange grip = {.node = 2, .kind = CPS_END_KIND_HELD, .stays = true};
    CpsStage grasp = cps_stage_default();
    grasp.grasp_change_count = 1;
    grasp.grasp_change = &grip;
    for (int i = 0; i < 2; i++) {
        assert_int_equal(cps_evolution_move(evolution, &grasp, NULL), CPS_OK);
        assert_int_equal(cps_evolution_report(evolution).outcome, CPS_OUTCOME_SOLVED);
        grip = (CpsGraspChange){.node = 2, .kind = CPS_END_KIND_FREE};
    }
    CHECK_INT(allocations, before);
    cps_evolution_destroy(evolution);
}

static void every_failing_allocation_is_survived(void **unused) {
    (void)unused;
    const CpsLine line = rope();
    const CpsObstacle bed = rough();
    const CpsScene s = scene(&bed, &line);
    const int live_before = live;
    for (int k = 0;; k++) {
        CpsEvolution *evolution = (CpsEvolution *)&stage; /* anything: must come back NULL */
        CpsError err;
        allocations = 0;
        fail_at = k;
        const CpsStatus status = cps_evolution_create(&s, &evolution, &err);
        fail_at = -1;
        if (status == CPS_OK) {
            cps_evolution_destroy(evolution);
            assert_true(k > 0); /* at least one allocation was made to fail */
            break;
        }
        assert_int_equal(status, CPS_ERR_MEMORY);
        assert_int_equal(err.status, CPS_ERR_MEMORY);
        assert_null(evolution);
    }
    CHECK_INT(live, live_before);
}

/* A disc cut by a strip, whose support needs a conic program. */
static CpsSet *grooves(void) {
    CpsSet *disc = NULL, *strip = NULL, *set = NULL;
    const double normal[] = {1, 1};
    assert_int_equal(cps_set_ball(2, NULL, 0.3, &disc, NULL), CPS_OK);
    assert_int_equal(cps_set_strip(2, normal, -0.2, 0.1, &strip, NULL), CPS_OK);
    const CpsSet *parts[] = {disc, strip};
    assert_int_equal(cps_set_intersection(2, parts, &set, NULL), CPS_OK);
    cps_set_release(disc);
    cps_set_release(strip);
    return set;
}

static void friction_sets_and_zones_take_no_more(void **unused) {
    (void)unused;
    const int live_before = live;
    CpsSet *set = grooves();
    CpsLine line = rope();
    const CpsFrictionZone zone = {.from = 1, .to = 3, .factor = 2};
    line.zone_count = 1;
    line.zone = &zone;
    CpsObstacle bed = rough();
    bed.friction_set = set;
    bed.grain[0] = 1;
    const CpsScene s = scene(&bed, &line);
    for (int k = 0;; k++) {
        CpsEvolution *evolution = (CpsEvolution *)&stage;
        CpsError err;
        allocations = 0;
        fail_at = k;
        const CpsStatus status = cps_evolution_create(&s, &evolution, &err);
        fail_at = -1;
        if (status != CPS_OK) {
            assert_int_equal(status, CPS_ERR_MEMORY);
            assert_null(evolution);
            continue;
        }
        assert_true(k > 5);
        /* the set may go: the evolution has what it needs of it */
        cps_set_release(set);
        const int before = allocations;
        while (cps_evolution_remaining_count(evolution) > 0) {
            assert_int_equal(cps_evolution_step(evolution, NULL), CPS_OK);
            assert_int_equal(cps_evolution_report(evolution).outcome, CPS_OUTCOME_SOLVED);
        }
        CHECK_INT(allocations, before);
        cps_evolution_destroy(evolution);
        break;
    }
    CHECK_INT(live, live_before);
}

/* A ball cut by a half-space, in which an end is; the end's set may go, and steps take no memory.
 */
static void an_end_in_a_set_takes_no_more(void **unused) {
    (void)unused;
    const int live_before = live;
    CpsSet *ball = NULL, *half = NULL, *set = NULL;
    assert_int_equal(cps_set_ball(3, (const double[3]){6.28, 0, 0}, 0.3, &ball, NULL), CPS_OK);
    assert_int_equal(cps_set_half_space(3, (const double[3]){1, 0.5, 0.2}, 6.4, &half, NULL),
                     CPS_OK);
    assert_int_equal(cps_set_intersection(2, (const CpsSet *[]){ball, half}, &set, NULL), CPS_OK);
    cps_set_release(ball);
    cps_set_release(half);
    CpsLine line = rope();
    line.constraint[CPS_END_B] = (CpsConstraint){.kind = CPS_CONSTRAINT_KIND_SET, .set = set};
    const CpsObstacle bed = rough();
    const CpsScene s = scene(&bed, &line);
    for (int k = 0;; k++) {
        CpsEvolution *evolution = (CpsEvolution *)&stage;
        CpsError err;
        allocations = 0;
        fail_at = k;
        const CpsStatus status = cps_evolution_create(&s, &evolution, &err);
        fail_at = -1;
        if (status != CPS_OK) {
            assert_int_equal(status, CPS_ERR_MEMORY);
            assert_null(evolution);
            continue;
        }
        assert_true(k > 5);
        cps_set_release(set);
        const int before = allocations;
        while (cps_evolution_remaining_count(evolution) > 0) {
            assert_int_equal(cps_evolution_step(evolution, NULL), CPS_OK);
            assert_int_equal(cps_evolution_report(evolution).outcome, CPS_OUTCOME_SOLVED);
        }
        assert_true(cps_evolution_constraint_report(evolution, 0, CPS_END_B).is_active);
        CHECK_INT(allocations, before);
        cps_evolution_destroy(evolution);
        break;
    }
    CHECK_INT(live, live_before);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stepping_allocates_nothing),
        cmocka_unit_test(motion_allocates_nothing),
        cmocka_unit_test(moving_allocates_once),
        cmocka_unit_test(every_failing_allocation_is_survived),
        cmocka_unit_test(friction_sets_and_zones_take_no_more),
        cmocka_unit_test(an_end_in_a_set_takes_no_more),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
