/* SPDX-License-Identifier: BSD-3-Clause */
/* Points at the surface of the water: answers by hand, and what is refused. */
#include <math.h>
#include <string.h>

#include "cases.h"

/* A buoy on a weightless string of one element from an anchor straight below the surface at 0. It
 * weighs WEIGHT in air and displaces water of DISPLACED. */
static const double WEIGHT = 600, DISPLACED = 1500, LENGTH = 8, EA = 3e4;

typedef struct Buoy {
    CpsLine line;
    CpsPoint point[2];
    CpsObstacle beach;
    CpsScene scene;
} Buoy;

enum { ANCHOR, BUOY };

static void make(Buoy *b, double depth) {
    *b = (Buoy){.scene = cps_scene_default(), .beach = cps_obstacle_default()};
    for (int i = 0; i < 2; i++) b->point[i] = cps_point_default();
    b->point[ANCHOR].name = "anchor";
    b->point[ANCHOR].position[2] = -depth;
    b->point[BUOY].name = "buoy";
    b->point[BUOY].kind = CPS_POINT_KIND_FREE;
    b->point[BUOY].position[2] = LENGTH - depth;
    b->point[BUOY].weight = WEIGHT - DISPLACED;
    b->point[BUOY].displaced_weight = DISPLACED;
    b->line = cps_line_default();
    b->line.name = "string";
    b->line.length = LENGTH;
    b->line.element_count = 1;
    b->line.stiffness = EA;
    b->line.start.kind = CPS_START_STATIC;
    for (int end = 0; end < 2; end++) {
        b->line.end[end].kind = CPS_END_KIND_POINT;
        b->line.end_point[end] = end == CPS_END_A ? ANCHOR : BUOY;
    }
    b->scene.line_count = 1;
    b->scene.line = &b->line;
    b->scene.point_count = 2;
    b->scene.point = b->point;
    b->scene.has_water_surface = true;
}

static CpsEvolution *evolve(const Buoy *b) {
    CpsEvolution *evolution = NULL;
    CpsError err;
    if (cps_evolution_create(&b->scene, &evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    return evolution;
}

static CpsPointReport step(CpsEvolution *evolution) {
    CpsError err;
    if (cps_evolution_step(evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    assert_int_equal(cps_evolution_report(evolution).outcome, CPS_OUTCOME_SOLVED);
    return cps_evolution_point_report(evolution, BUOY);
}

/* The anchor goes down from a depth at which the string is slack. The buoy floats, with all of its
 * weight on the water; then the string pulls, T = EA (depth/l - 1); at T = D - W the buoy is just
 * awash, and deeper it follows the anchor. Then back. */
static void taut_and_slack(void **unused) {
    (void)unused;
    static const double DEPTH[] = {6, 7.9, 8.1, 8.2, 8.3, 12, 8.2, 7};
    enum { STEPS = sizeof DEPTH / sizeof *DEPTH };
    Buoy b;
    make(&b, DEPTH[0]);
    const double most = DISPLACED - WEIGHT, awash = LENGTH * (1 + most / EA);
    CpsStage stage[STEPS];
    CpsPointChange change[STEPS];
    for (int k = 1; k < STEPS; k++) {
        change[k] = (CpsPointChange){.point = ANCHOR, .value = {0, 0, -DEPTH[k]}};
        stage[k] = cps_stage_default();
        stage[k].name = "down";
        stage[k].point_change_count = 1;
        stage[k].point_change = &change[k];
    }
    b.scene.stage = &stage[1];
    b.scene.stage_count = STEPS - 1;
    CpsEvolution *evolution = evolve(&b);
    for (int k = 0; k < STEPS; k++) {
        const CpsPointReport buoy = step(evolution);
        const double tension = fmax(0, EA * (DEPTH[k] / LENGTH - 1));
        const bool floats = DEPTH[k] < awash;
        CHECK_NEAR(buoy.position[2], floats ? 0 : awash - DEPTH[k], floats ? 0 : 1e-9);
        CHECK_NEAR(buoy.buoyancy, floats ? WEIGHT + tension : DISPLACED, 1e-6);
        CHECK_NEAR(buoy.lines[2], floats ? -tension : -most, 1e-6);
        CHECK_NEAR(buoy.load[2], -WEIGHT, 1e-9);
        CHECK_NEAR(buoy.displaced, DISPLACED, 1e-9);
        assert_int_equal(buoy.water, floats ? CPS_POINT_WATER_FLOATING : CPS_POINT_WATER_SUBMERGED);
        if (!floats && DEPTH[k] < 9) continue;
        assert_int_equal(buoy.state, CPS_POINT_STATE_FREE);
    }
    cps_evolution_destroy(evolution);
}

/* Just awash: the string pulls with exactly what the water can give more than the weight. */
static void pulled_to_its_buoyancy(void **unused) {
    (void)unused;
    Buoy b;
    make(&b, 0);
    const double awash = LENGTH * (1 + (DISPLACED - WEIGHT) / EA);
    b.point[ANCHOR].position[2] = -awash;
    b.point[BUOY].position[2] = -1;
    CpsEvolution *evolution = evolve(&b);
    const CpsPointReport buoy = step(evolution);
    CHECK_NEAR(buoy.position[2], 0, 1e-9);
    CHECK_NEAR(buoy.buoyancy, DISPLACED, 1e-6);
    cps_evolution_destroy(evolution);
}

/* A force lifts it out of the water until the string holds it, pushes it down, and lets go. */
static void lifted_and_pushed(void **unused) {
    (void)unused;
    static const double FORCE[] = {WEIGHT + 300, -(DISPLACED - WEIGHT) - 100, WEIGHT, 0};
    enum { STEPS = sizeof FORCE / sizeof *FORCE };
    Buoy b;
    make(&b, 5);
    CpsStage stage[STEPS];
    CpsPointChange change[STEPS];
    for (int k = 0; k < STEPS; k++) {
        change[k] =
            (CpsPointChange){.point = BUOY, .kind = CPS_POINT_KIND_FREE, .value = {0, 0, FORCE[k]}};
        stage[k] = cps_stage_default();
        stage[k].name = "force";
        stage[k].point_change_count = 1;
        stage[k].point_change = &change[k];
    }
    b.scene.stage = stage;
    b.scene.stage_count = STEPS;
    CpsEvolution *evolution = evolve(&b);
    CHECK_NEAR(step(evolution).buoyancy, WEIGHT, 1e-6);
    const CpsPointReport up = step(evolution), down = step(evolution), level = step(evolution),
                         free = step(evolution);
    assert_int_equal(up.water, CPS_POINT_WATER_ABOVE);
    CHECK_NEAR(up.position[2], LENGTH * (1 + 300 / EA) - 5, 1e-9);
    CHECK_NEAR(up.buoyancy, 0, 0);
    assert_int_equal(down.water, CPS_POINT_WATER_SUBMERGED);
    CHECK_NEAR(hypot(hypot(down.position[0], down.position[1]), down.position[2] + 5),
               LENGTH * (1 + 100 / EA), 1e-7);
    CHECK_NEAR(down.buoyancy, DISPLACED, 0);
    /* at rest at any height out of the water that the string allows */
    assert_true(level.position[2] > -1e-8 && level.position[2] < LENGTH - 5 + 1e-8);
    CHECK_NEAR(free.position[2], 0, 0);
    CHECK_NEAR(free.buoyancy, WEIGHT, 1e-6);
    cps_evolution_destroy(evolution);
}

/* Gravity falls to a third: so do the weight and what the water can give, and the string, which
 * pulled the buoy under, lets it float. */
static void under_less_gravity(void **unused) {
    (void)unused;
    const double depth = LENGTH * (1 + 250 / EA);
    Buoy b;
    make(&b, depth);
    CpsStage stage = cps_stage_default();
    stage.name = "less";
    stage.gravity_changes = true;
    stage.gravity[2] = b.scene.gravity[2] / 3;
    b.scene.stage = &stage;
    b.scene.stage_count = 1;
    CpsEvolution *evolution = evolve(&b);
    CHECK_NEAR(step(evolution).buoyancy, WEIGHT + 250, 1e-6);
    const CpsPointReport less = step(evolution);
    CHECK_NEAR(less.displaced, DISPLACED / 3, 1e-9);
    CHECK_NEAR(less.buoyancy, WEIGHT / 3 + 250, 1e-6);
    CHECK_NEAR(less.load[2], -WEIGHT / 3, 1e-9);
    cps_evolution_destroy(evolution);
}

/* A buoy pressed by F against a smooth beach z = x at the waterline: its reaction F sqrt(2) carries
 * F of the weight, the water the rest. */
static void on_a_beach(void **unused) {
    (void)unused;
    static const double FORCE = 250;
    Buoy b;
    make(&b, 5);
    b.point[ANCHOR].position[0] = -5;
    b.point[BUOY].position[0] = -2;
    b.point[BUOY].position[2] = 0;
    b.point[BUOY].force[0] = FORCE;
    b.beach.name = "beach";
    b.beach.normal[0] = -1;
    b.scene.obstacle_count = 1;
    b.scene.obstacle = &b.beach;
    CpsEvolution *evolution = evolve(&b);
    const CpsPointReport buoy = step(evolution);
    const double at[3] = {0, 0, 0};
    CHECK_VECTOR(buoy.position, at, 1e-9);
    CHECK_NEAR(buoy.reaction, sqrt(2) * FORCE, 1e-6);
    CHECK_NEAR(buoy.buoyancy, WEIGHT - FORCE, 1e-6);
    cps_evolution_destroy(evolution);
}

/* A held point is let go with the force that held it, and stays. */
static void held_and_let_go(void **unused) {
    (void)unused;
    static const double HEIGHT[] = {-1, 0, 1};
    for (int k = 0; k < 3; k++) {
        Buoy b;
        make(&b, LENGTH + 0.1 - HEIGHT[k] - 1);
        b.point[BUOY].kind = CPS_POINT_KIND_HELD;
        b.point[BUOY].position[2] = HEIGHT[k];
        b.point[ANCHOR].position[2] = HEIGHT[k] - LENGTH - 0.1;
        const double tension = EA * 0.1 / LENGTH,
                     whole = WEIGHT - (HEIGHT[k] > 0 ? 0 : DISPLACED) + tension;
        CpsPointChange change = {.point = BUOY,
                                 .kind = CPS_POINT_KIND_FREE,
                                 .value = {0, 0, whole}};
        CpsStage stage = cps_stage_default();
        stage.name = "let go";
        stage.point_change_count = 1;
        stage.point_change = &change;
        stage.step_count = 2;
        b.scene.stage = &stage;
        b.scene.stage_count = 1;
        CpsEvolution *evolution = evolve(&b);
        assert_int_equal(step(evolution).water, CPS_POINT_WATER_NONE);
        for (int i = 0; i < 2; i++) CHECK_NEAR(step(evolution).position[2], HEIGHT[k], 1e-9);
        cps_evolution_destroy(evolution);
    }
}

/* Without a surface the displaced weight means nothing: the same bits. */
static void without_a_surface(void **unused) {
    (void)unused;
    Buoy b;
    make(&b, 5);
    b.scene.has_water_surface = false;
    CpsEvolution *evolution = evolve(&b);
    const CpsPointReport one = step(evolution);
    cps_evolution_destroy(evolution);
    b.point[BUOY].displaced_weight = 0;
    evolution = evolve(&b);
    const CpsPointReport two = step(evolution);
    assert_memory_equal(one.position, two.position, sizeof one.position);
    assert_memory_equal(one.load, two.load, sizeof one.load);
    CHECK_NEAR(one.buoyancy, 0, 0);
    assert_int_equal(one.water, CPS_POINT_WATER_NONE);
    CHECK_NEAR(one.position[2], LENGTH * (1 + (DISPLACED - WEIGHT) / EA) - 5, 1e-9);
    cps_evolution_destroy(evolution);
}

static void refused(const Buoy *b, const char *expected) {
    CpsEvolution *evolution = NULL;
    CpsError err;
    assert_int_equal(cps_evolution_create(&b->scene, &evolution, &err), CPS_ERR_ARGUMENT);
    if (!strstr(err.message, expected)) fail_msg("%s", err.message);
}

static void what_is_refused(void **unused) {
    (void)unused;
    Buoy b;
    make(&b, 5);
    b.scene.gravity[0] = 1;
    refused(&b, "gravity: (1, 0, -9.81) m/s2 in a scene with a water surface");
    make(&b, 5);
    b.scene.gravity[2] = 9.81;
    refused(&b, "expected (0, 0, -g)");
    make(&b, 5);
    b.scene.water_surface = NAN;
    refused(&b, "water_surface: is nan m");
    make(&b, 5);
    b.point[BUOY].displaced_weight = -1;
    refused(&b, "point 'buoy': it displaces water of -1 N");
    make(&b, 5);
    b.point[BUOY].displaced_weight = NAN;
    refused(&b, "point 'buoy': it displaces water of nan N");
    make(&b, 5);
    CpsStage stage = cps_stage_default();
    stage.name = "tilt";
    stage.gravity_changes = true;
    stage.gravity[1] = 0.1;
    b.scene.stage = &stage;
    b.scene.stage_count = 1;
    refused(&b, "(0, 0.1, 0) m/s2 in a scene with a water surface");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(taut_and_slack),    cmocka_unit_test(pulled_to_its_buoyancy),
        cmocka_unit_test(lifted_and_pushed), cmocka_unit_test(under_less_gravity),
        cmocka_unit_test(on_a_beach),        cmocka_unit_test(held_and_let_go),
        cmocka_unit_test(without_a_surface), cmocka_unit_test(what_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
