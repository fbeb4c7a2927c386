/* SPDX-License-Identifier: BSD-3-Clause */
/* Given velocities of an end, a point and a body, from a scene of a program to the checker: the
 * file is sound and the scene's, copies with a number changed are refused, and so is the file
 * beside a scene with other velocities, whose places are the same. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/evolve.h"
#include "capstan/io.h"
#include "capstan/results.h"
#include "check.h"
#include "checker.h"
#include "given.h"
#include "run_scene.h"
#include "sample.h"

/* A rope whose end is led, and a line between a ring and an eye of a hull, both of which are led.
 */
static const char SCENE[] =
    "capstan: 1\ngravity: [0, 0, -9.81]\n"
    "obstacles: {bed: {plane: {point: [0, 0, -0.2]}, friction: 0.4}}\n"
    "bodies:\n"
    "  hull: {held: [9, 3, 1], mass: 300, moments_of_inertia: [50, 60, 80],"
    " centre_of_gravity: [0.1, 0, -0.2]}\n"
    "points:\n"
    "  eye: {body: hull, at: [-1, 0, 0.2]}\n"
    "  ring: {held: [2, 3, 1], mass: 20}\n"
    "lines:\n"
    "  a: {length: 6, elements: 8, mass: 3, stiffness: 1e4, start: static,"
    " ends: {A: {held: [0, 0, 0]}, B: {held: [5.5, 0, 1]}}}\n"
    "  b: {length: 6.2, elements: 6, mass: 2, stiffness: 1e4, start: static,"
    " ends: {A: {point: ring}, B: {point: eye}}}\n"
    "history:\n"
    "  - {name: 1, duration: 0.1, a.B: {position: [5.51, 0, 1.02]}, ring.point: {position: [2, "
    "3.02, 1]},"
    " hull.body: {position: [9, 3.01, 1], rotation: {roll_pitch_yaw: [0, 0, 1]}}}\n"
    "  - {name: 2, duration: 0.1, a.B: {position: [5.54, 0, 1.06]}, ring.point: {position: [2, "
    "3.06, 1]},"
    " hull.body: {position: [9, 3.04, 1], rotation: {roll_pitch_yaw: [0, 1, 3]}}}\n"
    "  - {name: 3, duration: 0.1, a.B: {position: [5.59, 0, 1.1]}, ring.point: {position: [2, "
    "3.12, 1]},"
    " hull.body: {position: [9, 3.09, 1], rotation: {roll_pitch_yaw: [0, 3, 6]}}}\n"
    "  - {name: 4, duration: 0.1, a.B: {position: [5.64, 0, 1.1]}, ring.point: {position: [2, "
    "3.18, 1]},"
    " hull.body: {position: [9, 3.14, 1], rotation: {roll_pitch_yaw: [0, 5, 9]}}}\n";
/* Step 0 is the static start, and stage k is step k + 1; the last stage gives no velocities. */
enum { STAGES = 4, LAST = STAGES, POINTS = 2, EYE = 0, RING = 1, NODES = 9, LINES = 2 };
static const double VELOCITY[STAGES][CPS_BODY_DIRECTIONS] = {{0.2, 0.1, 0.3, 0.05, 0.1, 0.35},
                                                             {0.4, 0.3, 0.4, 0.1, 0.2, 0.45},
                                                             {0.5, 0.6, 0.2, 0.2, 0.3, 0.6},
                                                             {0}};

/* The scene of the file with velocities. */
typedef struct Led {
    CpsSceneFile *file;
    CpsScene scene;
    CpsStage stage[STAGES];
    CpsChange end[STAGES];
    CpsPointChange point[STAGES];
    CpsBodyChange body[STAGES];
} Led;

static Led led;
static char copy[80];

static void read_scene(void) {
    CpsError err = {0};
    FILE *out = fopen(scene_path, "w");
    assert_true(out && fputs(SCENE, out) >= 0 && fclose(out) == 0);
    if (cps_scene_read(scene_path, NULL, &led.file, &err)) fail_msg("%s", err.message);
    led.scene = *cps_scene_file_scene(led.file);
    assert_int_equal(led.scene.stage_count, STAGES);
    for (int k = 0; k < STAGES; k++) {
        led.stage[k] = led.scene.stage[k];
        led.end[k] = led.stage[k].change[0];
        led.point[k] = led.stage[k].point_change[0];
        led.body[k] = led.stage[k].body_change[0];
        led.stage[k].change = &led.end[k];
        led.stage[k].point_change = &led.point[k];
        led.stage[k].body_change = &led.body[k];
        led.end[k].has_velocity = led.point[k].has_velocity = led.body[k].has_velocity =
            k + 1 < LAST;
        memcpy(led.end[k].velocity, VELOCITY[k], sizeof led.end[k].velocity);
        memcpy(led.point[k].velocity, VELOCITY[k], sizeof led.point[k].velocity);
        memcpy(led.body[k].velocity, VELOCITY[k], sizeof led.body[k].velocity);
    }
    led.scene.stage = led.stage;
}

static int begin(void **state) {
    CpsEvolution *evolution = NULL;
    CpsResults *results = NULL;
    CpsError err = {0};
    char folder[64];
    if (make_scene_directory(state) != 0) return -1;
    read_scene();
    snprintf(folder, sizeof folder, "%.*s", (int)(strrchr(scene_path, '/') - scene_path),
             scene_path);
    snprintf(copy, sizeof copy, "%s-copy", scene_result);
    CpsStatus status = cps_evolution_create(&led.scene, &evolution, &err);
    if (!status) status = cps_results_prepare(folder, CPS_RESULTS_KIND_RUN, 0, true, &err);
    if (!status) status = cps_results_open(folder, &led.scene, evolution, NULL, &results, &err);
    while (!status && cps_evolution_remaining_count(evolution) > 0) {
        status = cps_evolution_step(evolution, &err);
        if (!status) status = cps_results_append(results, evolution, &err);
    }
    if (!status) status = cps_results_finish(results, 0, &err);
    if (status) print_error("%s: %s\n", err.where, err.message);
    cps_results_destroy(results);
    cps_evolution_destroy(evolution);
    return status != CPS_OK;
}

static int end(void **state) {
    cps_scene_file_destroy(led.file);
    return remove_scene_directory(state);
}

static void sound_file_is_the_scenes(void **state) {
    (void)state;
    CheckerReport report;
    CHECK_INT(checker_file(scene_result, &report, stdout), 0);
    CHECK_INT(report.certified, LINES * (STAGES + 1));
    CHECK_INT(given_file(scene_result, &led.scene, stdout), 0);
}

/* Component a after a step: of end B of line a, of a point, of the body. */
#define END(step, a)          (3 * ((step)*NODES + NODES - 1) + (a))
#define POINT(step, point)    ((step)*POINTS + (point))
#define PLACE(step, point, a) (3 * POINT(step, point) + (a))
#define BODY(step, a)         (3 * (step) + (a))

/* A number that is changed, and words of what is found; NULL: beside the scene. */
static const struct {
    const char *variable;
    size_t index;
    double value;
    const char *finding;
} FALSE[] = {
    {"a_velocity", END(1, 0), 0.41, "line a: velocity off that of the positions"},
    {"a_reference", END(1, 0), 5.5, "line a: velocity off that of the positions"},
    {"a_velocity_given", 1, 0, "line a: reference off that of the scheme"},
    {"a_velocity_given", 1, 3, NULL},
    {"a_velocity_given", LAST, 2, NULL},
    {"a_velocity_given", 1, 4, "senseless velocity_given of line 'a'"},
    {"velocity_of_point", PLACE(1, RING, 1), 0.31, "point ring: velocity off that of the places"},
    {"reference_of_point", PLACE(1, RING, 1), 3, "point ring: velocity off that of the places"},
    {"velocity_given_of_point", POINT(1, RING), 0, "point ring: reference off that of the scheme"},
    {"velocity_given_of_point", POINT(LAST, RING), 1, NULL},
    {"velocity_given_of_point", POINT(1, EYE), 0, "point eye: reference off that of the scheme"},
    {"velocity_of_body", BODY(1, 1), 0.31,
     "velocity of the centre of gravity off that of the body"},
    {"turn_rate_of_body", BODY(1, 2), 0.46, "body hull: moment of inertia, off"},
    {"centre_velocity_of_body", BODY(1, 0), 0.41, "body hull: force of inertia, off"},
    {"velocity_given_of_body", 1, 0, "body hull: velocity off that of the places"},
    {"velocity_given_of_body", LAST, 1, NULL},
    {"velocity_given_of_body", 1, 2, "senseless motion: bodies"},
};

static void falsified_copies_are_refused(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof FALSE / sizeof *FALSE; i++) {
        char command[200], *text = NULL;
        size_t size = 0;
        snprintf(command, sizeof command, "cp '%s' '%s'", scene_result, copy);
        assert_int_equal(system(command), 0);
        CHECK_INT(sample_poke(copy, FALSE[i].variable, FALSE[i].index, FALSE[i].value), 0);
        FILE *log = open_memstream(&text, &size);
        const int found = checker_file(copy, NULL, log), given = given_file(copy, &led.scene, NULL);
        fclose(log);
        const bool is_refused =
            FALSE[i].finding ? found != 0 && strstr(text, FALSE[i].finding) : given >= 1;
        if (!is_refused)
            fail_msg("%s[%zu] = %g: expected \"%s\", got %d and %d:\n%s", FALSE[i].variable,
                     FALSE[i].index, FALSE[i].value,
                     FALSE[i].finding ? FALSE[i].finding : "not the scene's", found, given, text);
        free(text);
    }
    remove(copy);
}

static void other(const char *what) {
    if (given_file(scene_result, &led.scene, NULL) < 1)
        fail_msg("the file is accepted as that of a scene with another %s", what);
}

static void scenes_with_other_velocities_are_refused(void **state) {
    (void)state;
    double *const number[] = {&led.end[1].velocity[0], &led.point[1].velocity[1],
                              &led.body[1].velocity[2], &led.body[1].velocity[5]};
    bool *const flag[] = {&led.end[1].has_velocity,          &led.point[1].has_velocity,
                          &led.body[1].has_velocity,         &led.end[LAST - 1].has_velocity,
                          &led.point[LAST - 1].has_velocity, &led.body[LAST - 1].has_velocity};
    for (size_t i = 0; i < sizeof number / sizeof *number; i++) {
        const double was = *number[i];
        *number[i] += 1e-9;
        other("velocity");
        *number[i] = was;
    }
    for (size_t i = 0; i < sizeof flag / sizeof *flag; i++) {
        *flag[i] = !*flag[i];
        other("flag");
        *flag[i] = !*flag[i];
    }
    CHECK_INT(given_file(scene_result, &led.scene, stdout), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(sound_file_is_the_scenes),
                                       cmocka_unit_test(falsified_copies_are_refused),
                                       cmocka_unit_test(scenes_with_other_velocities_are_refused)};
    return cmocka_run_group_tests(tests, begin, end);
}
