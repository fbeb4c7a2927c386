/* SPDX-License-Identifier: BSD-3-Clause */
/* Results of runs that lack something: steps, obstacles, a solution, a place near 0, space for the
 * summary. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "capstan/results.h"

static const char SCENE[] = "results-few.yaml", OUT[] = "results-few";

/* A rope of 1 m between (x, y, z) and 1 m beside it, which is pulled by 0.1 m. */
#define ROPE(stiffness, place)                                                            \
    "capstan: 1\nlines: {rope: {length: 1, elements: 4, weight: 1, stiffness: " stiffness \
    ", start: {straight: {from: [" place ", 0], to: [" place                              \
    ", 1]}}, ends: {A: held, B: held}}}\n"
#define PULL "history:\n  - {rope.B: {move: [0, 0, 0.1]}, steps: 2}\n"

static CpsStatus take_steps(CpsEvolution *evolution, CpsResults *results, CpsError *err) {
    CpsStatus status = CPS_OK;
    while (!status && cps_evolution_remaining_count(evolution) > 0) {
        status = cps_evolution_step(evolution, err);
        if (!status) status = cps_results_append(results, evolution, err);
    }
    return status;
}

/* Run `text`, all of its steps or none, into OUT. */
static CpsStatus run(const char *text, bool steps, CpsError *err) {
    FILE *out = fopen(SCENE, "w");
    assert_non_null(out);
    assert_true(fputs(text, out) >= 0 && fclose(out) == 0);
    assert_int_equal(system("rm -rf results-few"), 0);
    CpsSceneFile *file = NULL;
    CpsEvolution *evolution = NULL;
    CpsResults *results = NULL;
    CpsStatus status = cps_scene_read(SCENE, NULL, &file, err);
    if (!status) status = cps_evolution_create(cps_scene_file_scene(file), &evolution, err);
    if (!status)
        status = cps_results_open(OUT, cps_scene_file_scene(file), evolution, NULL, &results, err);
    if (!status && steps) status = take_steps(evolution, results, err);
    FILE *full = fopen("/dev/full", "w");
    assert_non_null(full);
    if (!status) assert_int_equal(cps_results_write_summary(results, 0, full, err), CPS_ERR_IO);
    fclose(full);
    full = fopen("/dev/full", "w");
    assert_non_null(full);
    setvbuf(full, NULL, _IONBF, 0);
    if (!status) assert_int_equal(cps_results_write_summary(results, 0, full, err), CPS_ERR_IO);
    fclose(full);
    if (!status) status = cps_results_finish(results, 0, err);
    cps_results_destroy(results);
    cps_evolution_destroy(evolution);
    cps_scene_file_destroy(file);
    remove(SCENE);
    return status;
}

static void assert_summary(const char *text, bool steps, const char *has, const char *has_not) {
    CpsError err = {0};
    if (run(text, steps, &err) != CPS_OK) fail_msg("%s", err.message);
    static char summary[100000];
    FILE *in = fopen("results-few/summary.json", "r");
    assert_non_null(in);
    summary[fread(summary, 1, sizeof summary - 1, in)] = '\0';
    fclose(in);
    if (!strstr(summary, has)) fail_msg("'%s' is not in %s", has, summary);
    if (has_not && strstr(summary, has_not)) fail_msg("'%s' is in %s", has_not, summary);
}

static void no_steps(void **state) {
    (void)state;
    assert_summary(ROPE("100", "0, 0"), true, "\"name\": \"equilibrium\"", NULL);
    assert_summary(ROPE("100", "0, 0") PULL, false, "\"steps\": []", NULL);
    assert_summary(ROPE("100", "0, 0") "obstacles: {bed: {plane: {point: [0, 0, -1]}}}\n" PULL,
                   false, "\"steps\": []", NULL);
}

static void no_obstacles(void **state) {
    (void)state;
    assert_summary(ROPE("100", "0, 0") PULL, true, "\"outcome\": \"solved\"", "origin_m");
    assert_int_not_equal(access("results-few/obstacles.vtp", F_OK), 0);
    assert_int_equal(access("results-few/result.pvd", F_OK), 0);
}

/* Coordinates are counted from an origin of their own where they are large, in each direction. */
static void far_away(void **state) {
    (void)state;
    assert_summary(ROPE("100", "3e6, 0") PULL, true, "\"origin_m\": [3000000, 0, 0]", NULL);
    assert_summary(ROPE("100", "0, 3e6") PULL, true, "\"origin_m\": [0, 3000000, 0]", NULL);
    assert_summary("capstan: 1\nlines: {rope: {length: 1, elements: 4, weight: 1, stiffness: 100, "
                   "start: {straight: {from: [0, 0, 3e6], to: [1, 0, 3e6]}}, ends: {A: held, "
                   "B: held}}}\n" PULL,
                   true, "\"origin_m\": [0, 0, 3000000]", NULL);
}

/* The ends of a line that cannot stretch are too far apart, alone and round an obstacle. */
static void no_configuration(void **state) {
    (void)state;
    assert_summary(ROPE(".inf", "0, 0") PULL, true, "\"excess_m\"", "\"obstacle\"");
    assert_summary("capstan: 1\nobstacles: {drum: {cylinder: {axis: [0, 1, 0], radius: 1}}}\n"
                   "lines: {rope: {length: 6, elements: 24, weight: 1, stiffness: .inf, start: "
                   "{straight: {from: [-3, 0, 1.01], to: [3, 0, 1.01]}}, ends: {A: held, B: "
                   "held}}}\nhistory:\n  - {rope.A: {position: [-3, 0, 0]}, rope.B: {position: "
                   "[3, 0, 0]}}\n",
                   true, "\"obstacle\": 0, \"excess_m\"", NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_steps), cmocka_unit_test(no_obstacles),
                                       cmocka_unit_test(far_away),
                                       cmocka_unit_test(no_configuration)};
    return cmocka_run_group_tests_name("results of few", tests, NULL, NULL);
}
