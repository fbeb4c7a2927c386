/* SPDX-License-Identifier: BSD-3-Clause */
/* Velocities that are given with the places of ends, points and bodies: which are refused, and that
 * a saved state belongs to the velocities of the stages before it. (What they do:
 * test/analytic/test_led_motion.c.) */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/evolve.h"
#include "check.h"

enum { STAGES = 2 };
static const double WAY[6] = {0, 0, 0, 2, 0, 0}, AWAY[6] = {0, 3, 0, 2, 3, 0};

/* A line whose end is led, and a line between a point and a body, both of which are led. */
typedef struct Led {
    CpsLine line[2];
    CpsPoint point[2];
    CpsBody body;
    CpsChange end[STAGES];
    CpsPointChange ring[STAGES];
    CpsBodyChange hull[STAGES];
    CpsStage stage[STAGES];
    CpsScene scene;
} Led;

static void make_lines(Led *led) {
    static const char *const NAME[] = {"rope", "link"};
    for (int i = 0; i < 2; i++) {
        CpsLine *line = &led->line[i];
        *line = cps_line_default();
        line->name = NAME[i];
        line->length = 1.9;
        line->element_count = 4;
        line->inertia = 3;
        line->stiffness = 1e4;
        line->start =
            (CpsStart){.kind = CPS_START_STRAIGHT, .point_count = 2, .point = i ? AWAY : WAY};
        for (int end = 0; end < 2; end++) {
            line->end[end].kind = i ? CPS_END_KIND_POINT : CPS_END_KIND_AT_START;
            line->end_point[end] = i ? end : 0;
        }
    }
}

static void make(Led *led) {
    *led = (Led){.scene = cps_scene_default(), .body = cps_body_default()};
    make_lines(led);
    for (int i = 0; i < 2; i++) led->point[i] = cps_point_default();
    led->point[0].name = "ring";
    led->point[0].position[1] = 3;
    led->point[0].inertia = 5;
    led->point[1].name = "eye";
    led->point[1].kind = CPS_POINT_KIND_ON_BODY;
    led->body.name = "hull";
    led->body.mass = 40;
    led->body.inertia[0] = led->body.inertia[1] = led->body.inertia[2] = 7;
    led->body.position[0] = 2;
    led->body.position[1] = 3;
    for (int k = 0; k < STAGES; k++) {
        const double up = 0.01 * (k + 1);
        led->end[k] = (CpsChange){.end = CPS_END_B,
                                  .to = {CPS_END_KIND_HELD, {2, 0, up}},
                                  .has_velocity = true,
                                  .velocity = {0, 0.1, 0.2}};
        led->ring[k] = (CpsPointChange){.kind = CPS_POINT_KIND_HELD,
                                        .value = {0, 3, up},
                                        .has_velocity = true,
                                        .velocity = {0, 0.1, 0.2}};
        led->hull[k] = (CpsBodyChange){.kind = CPS_BODY_KIND_HELD,
                                       .position = {2, 3, up},
                                       .rotation = {1, 0, 0, 0},
                                       .has_velocity = true,
                                       .velocity = {0, 0.1, 0.2, 0.3, 0, 0.1}};
        led->stage[k] = cps_stage_default();
        led->stage[k].name = k ? "second" : "first";
        led->stage[k].duration = 0.1;
        led->stage[k].change = &led->end[k];
        led->stage[k].point_change = &led->ring[k];
        led->stage[k].body_change = &led->hull[k];
        led->stage[k].change_count = led->stage[k].point_change_count =
            led->stage[k].body_change_count = 1;
    }
    led->scene.line = led->line;
    led->scene.line_count = 2;
    led->scene.point = led->point;
    led->scene.point_count = 2;
    led->scene.body = &led->body;
    led->scene.body_count = 1;
    led->scene.stage = led->stage;
    led->scene.stage_count = STAGES;
}

static CpsEvolution *evolution_of(const Led *led) {
    CpsError err;
    CpsEvolution *evolution = NULL;
    if (cps_evolution_create(&led->scene, &evolution, &err)) fail_msg("%s", err.message);
    return evolution;
}

/* ---- what is refused ---- */

static Led bad;

/* The scene after a change is refused at a place with words, and so is the stage as a move, which
 * leaves everything as it was. */
static void expect_refused(const char *place, const char *words) {
    Led sound;
    CpsError err;
    CpsEvolution *none = NULL;
    CHECK_INT((int)cps_scene_check(&bad.scene, &err), (int)CPS_ERR_ARGUMENT);
    if (!strstr(err.where, place) || !strstr(err.message, words))
        fail_msg("'%s: %s' lacks '%s' or '%s'", err.where, err.message, place, words);
    CHECK_INT((int)cps_evolution_create(&bad.scene, &none, &err), (int)CPS_ERR_ARGUMENT);
    make(&sound);
    CpsEvolution *evolution = evolution_of(&sound);
    const size_t size = cps_evolution_state_size(evolution);
    unsigned char *before = malloc(size), *after = malloc(size);
    assert_true(before && after);
    cps_evolution_save(evolution, before);
    CHECK_INT((int)cps_evolution_move(evolution, &bad.stage[0], &err), (int)CPS_ERR_ARGUMENT);
    if (!strstr(err.message, words)) fail_msg("'%s' lacks '%s'", err.message, words);
    cps_evolution_save(evolution, after);
    assert_memory_equal(before, after, size);
    free(before);
    free(after);
    cps_evolution_destroy(evolution);
    make(&bad);
}

static void what_means_nothing_is_refused(void **state) {
    (void)state;
    static const double NO_NUMBER[] = {NAN, INFINITY, -INFINITY};
    make(&bad);
    assert_int_equal(cps_scene_check(&bad.scene, NULL), CPS_OK);
    for (size_t i = 0; i < sizeof NO_NUMBER / sizeof *NO_NUMBER; i++) {
        bad.end[0].velocity[i] = NO_NUMBER[i];
        expect_refused("rope.B", "expected finite numbers");
        bad.ring[0].velocity[i] = NO_NUMBER[i];
        expect_refused("ring.point", "expected finite numbers");
        bad.hull[0].velocity[i] = NO_NUMBER[i];
        expect_refused("hull.body", "m/s, expected finite numbers");
        bad.hull[0].velocity[3 + i] = NO_NUMBER[i];
        expect_refused("hull.body", "rad/s, expected finite numbers");
    }
    bad.end[0].to.kind = CPS_END_KIND_FREE;
    expect_refused("rope.B", "has a velocity but is not held");
    bad.end[0].to.kind = CPS_END_KIND_RELEASED;
    expect_refused("rope.B", "has a velocity but is not held");
    bad.ring[0].kind = CPS_POINT_KIND_FREE;
    expect_refused("ring.point", "has a velocity but is not held");
    bad.hull[0].kind = CPS_BODY_KIND_FREE;
    expect_refused("hull.body", "has a velocity but is not held");
}

static void steps_that_have_no_end_for_it_are_refused(void **state) {
    (void)state;
    make(&bad);
    for (int what = 0; what < 3; what++) {
        static const char *const PLACE[] = {"rope.B", "ring.point", "hull.body"};
        bad.end[0].has_velocity = what == 0;
        bad.ring[0].has_velocity = what == 1;
        bad.hull[0].has_velocity = what == 2;
        bad.stage[0].duration = 0;
        expect_refused(PLACE[what], "the step takes no time");
    }
    CpsError err;
    bad.stage[0].step_count = 2;
    CHECK_INT((int)cps_scene_check(&bad.scene, &err), (int)CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "expected steps 1 and error 0, found 2 and 0 m"));
    bad.stage[0].step_count = 1;
    bad.stage[0].error = 0.01;
    CHECK_INT((int)cps_scene_check(&bad.scene, &err), (int)CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "expected steps 1 and error 0, found 1 and 0.01 m"));
}

/* ---- states ---- */

/* Is the state after one stage taken by the scene with `led`'s velocities? */
static bool takes(const Led *led, const void *bytes, size_t size) {
    CpsError err;
    CpsEvolution *other = evolution_of(led);
    const bool is_taken = cps_evolution_load(other, bytes, size, &err) == CPS_OK;
    if (!is_taken) assert_non_null(strstr(err.message, "scene"));
    cps_evolution_destroy(other);
    return is_taken;
}

static void states_belong_to_their_velocities(void **state) {
    (void)state;
    Led led;
    make(&led);
    CpsError err;
    CpsEvolution *evolution = evolution_of(&led);
    if (cps_evolution_step(evolution, &err)) fail_msg("%s", err.message);
    CHECK_INT((int)cps_evolution_report(evolution).outcome, (int)CPS_OUTCOME_SOLVED);
    const CpsLineMotion line = cps_evolution_line_motion(evolution, 0),
                        link = cps_evolution_line_motion(evolution, 1);
    assert_true(!line.velocity_given[CPS_END_A] && line.velocity_given[CPS_END_B]);
    assert_true(link.velocity_given[CPS_END_A] && link.velocity_given[CPS_END_B]);
    for (int k = 0; k < 2; k++)
        assert_true(cps_evolution_point_motion(evolution, k).velocity_given);
    assert_true(cps_evolution_body_motion(evolution, 0).velocity_given);
    const size_t size = cps_evolution_state_size(evolution);
    void *bytes = malloc(size);
    assert_non_null(bytes);
    cps_evolution_save(evolution, bytes);
    cps_evolution_destroy(evolution);
    for (int k = 0; k < STAGES; k++) { /* the second stage is to come: it may be another */
        double *const number[] = {&led.end[k].velocity[1], &led.ring[k].velocity[2],
                                  &led.hull[k].velocity[0], &led.hull[k].velocity[5]};
        bool *const flag[] = {&led.end[k].has_velocity, &led.ring[k].has_velocity,
                              &led.hull[k].has_velocity};
        for (size_t i = 0; i < sizeof number / sizeof *number; i++) {
            const double was = *number[i];
            *number[i] = nextafter(was, 1);
            CHECK_INT(takes(&led, bytes, size), k > 0);
            *number[i] = was;
        }
        for (size_t i = 0; i < sizeof flag / sizeof *flag; i++) {
            *flag[i] = false;
            CHECK_INT(takes(&led, bytes, size), k > 0);
            *flag[i] = true;
        }
    }
    assert_true(takes(&led, bytes, size));
    free(bytes);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_means_nothing_is_refused),
        cmocka_unit_test(steps_that_have_no_end_for_it_are_refused),
        cmocka_unit_test(states_belong_to_their_velocities),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
