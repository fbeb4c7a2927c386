/* SPDX-License-Identifier: BSD-3-Clause */
/* Parts of the writers of results by themselves: a netCDF file after a failure, a name that does
 * not fit, regularised runs of which some steps have not converged, long lines in pictures. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "capstan/results.h"
#include "io/results/netcdf/netcdf_file.h"
#include "straight_rope.h"

/* The library of this file has no functions: each call of one would end the test. */
static void nothing_after_a_failure(void **state) {
    (void)state;
    CpsiNetcdfFile file = {.status = 7};
    const size_t at[] = {0};
    const double number = 1;
    const int whole = 1;
    const unsigned char byte = 1;
    assert_int_equal(cpsi_netcdf_dimension(&file, "x", 1), -1);
    assert_int_equal(cpsi_netcdf_variable(&file, "a", "b", NC_INT, 0, NULL, "c", "m"), -1);
    cpsi_netcdf_text(&file, 0, "a", "b");
    cpsi_netcdf_numbers(&file, "a", 1, &number);
    cpsi_netcdf_flags(&file, 0, NC_INT, 1, &whole, "a");
    cpsi_netcdf_may_miss(&file, 0);
    cpsi_netcdf_doubles(&file, 0, at, at, &number);
    cpsi_netcdf_ints(&file, 0, at, at, &whole);
    cpsi_netcdf_bytes(&file, 0, at, at, &byte);
    cpsi_netcdf_int(&file, 0, at, 1);
    cpsi_netcdf_keep(&file, 8);
    assert_int_equal(file.status, 7);
}

static void names_that_do_not_fit(void **state) {
    (void)state;
    char name[NC_MAX_NAME + 2];
    memset(name, 'n', sizeof name - 1);
    name[sizeof name - 1] = '\0';
    CpsiNetcdfFile file = {.status = NC_NOERR};
    assert_int_equal(cpsi_netcdf_variable(&file, "", name, NC_INT, 0, NULL, "c", NULL), -1);
    assert_int_equal(file.status, NC_EMAXNAME);
    name[NC_MAX_NAME - 2] = '\0'; /* "ab_" and this are one too long */
    file.status = NC_NOERR;
    assert_int_equal(cpsi_netcdf_variable(&file, "ab", name, NC_INT, 0, NULL, "c", NULL), -1);
    assert_int_equal(file.status, NC_EMAXNAME);
}

enum { LINES = 2, STEPS = 3, POINTS = 2, TEXT = 20000 };

/* The summary of a run of two lines in two steps. */
static char *summary_of(const CpsRegularizedReport report[LINES][STEPS], bool complete) {
    static const char *const NAME[STEPS] = {"start", "there", "back"};
    static const double POSITION[STEPS * POINTS * 3];
    static const CpsRegularizedParameters PARAMETERS[STEPS];
    static char text[TEXT];
    CpsRegularizedLine line[LINES];
    for (int i = 0; i < LINES; i++)
        line[i] = (CpsRegularizedLine){.name = i ? "second" : "first",
                                       .point_count = POINTS,
                                       .position = POSITION,
                                       .parameters = PARAMETERS,
                                       .report = report[i]};
    const CpsRegularizedRun run = {.cookie = cps_regularized_run_default().cookie,
                                   .title = "some have not converged",
                                   .step_count = STEPS,
                                   .line_count = LINES,
                                   .step_name = NAME,
                                   .line = line,
                                   .complete = complete};
    CpsError err = {0};
    memset(text, 0, sizeof text);
    FILE *out = fmemopen(text, sizeof text - 1, "w");
    assert_non_null(out);
    assert_int_equal(cps_regularized_summary(&run, out, &err), CPS_OK);
    assert_int_equal(fclose(out), 0);
    return text;
}

static int count_of(const char *text, const char *what) {
    int count = 0;
    for (const char *at = text; (at = strstr(at, what)) != NULL; at++) count++;
    return count;
}

/* A run has converged where each line has in each step; each step of each line says so itself. */
static void steps_that_have_not_converged(void **state) {
    (void)state;
    for (int which = 0; which <= LINES * (STEPS - 1); which++) { /* the last: all have converged */
        CpsRegularizedReport report[LINES][STEPS] = {0};
        for (int i = 0; i < LINES; i++)
            for (int s = 1; s < STEPS; s++)
                report[i][s].converged = i * (STEPS - 1) + s - 1 != which;
        const bool all = which == LINES * (STEPS - 1);
        const char *text = summary_of((const CpsRegularizedReport(*)[STEPS])report, all);
        assert_int_equal(count_of(text, "\"converged\": false, \"iterations\""), !all);
        assert_int_equal(count_of(text, "\"converged\": true, \"iterations\""), 4 - !all);
        assert_int_equal(count_of(text, "\"converged\": false,\n  \"complete\": false"), !all);
        assert_int_equal(count_of(text, "\"converged\": true,\n  \"complete\": true"), all);
    }
}

/* Largest number of points of a curve in a picture. */
static int most_points(const char *path) {
    FILE *in = fopen(path, "r");
    assert_non_null(in);
    int most = 0, count = 0;
    for (int c; (c = fgetc(in)) != EOF;) {
        if (c == '\n' || c == '"') count = 0;
        count += c == ' ';
        if (count > most) most = count;
    }
    fclose(in);
    return most;
}

/* A picture has at most 2000 points of a line, and shows the friction of nodes in the air: the line
 * lies on a bed, and is then lifted aside with the friction of its reference. */
static void long_lines(void **state) {
    (void)state;
    enum { ELEMENTS = 2500, MOST = 2000 };
    const double point[] = {0, 0, 0, 25, 0, 0};
    const CpsChange change = {.line = 0,
                              .end = CPS_END_B,
                              .to = {CPS_END_KIND_HELD, {25, 0, 0.01}}};
    CpsStage stage = cps_stage_default();
    stage.name = "lift";
    stage.step_count = 1;
    stage.change_count = 1;
    stage.change = &change;
    CpsObstacle bed = cps_obstacle_default();
    bed.name = "bed";
    bed.friction = 0.3;
    const CpsLine line = straight_rope(point, 25, ELEMENTS, 10, 1e5);
    CpsScene scene = cps_scene_default();
    scene.title = "long";
    scene.friction_policy = CPS_FRICTION_POLICY_FROZEN;
    scene.obstacle_count = 1;
    scene.obstacle = &bed;
    scene.line_count = 1;
    scene.line = &line;
    scene.stage_count = 1;
    scene.stage = &stage;
    CpsError err = {0};
    CpsEvolution *evolution = NULL;
    CpsResults *results = NULL;
    assert_int_equal(system("rm -rf results-parts"), 0);
    assert_int_equal(cps_evolution_create(&scene, &evolution, &err), CPS_OK);
    assert_int_equal(cps_results_open("results-parts", &scene, evolution, NULL, &results, &err),
                     CPS_OK);
    assert_int_equal(cps_evolution_step(evolution, &err), CPS_OK);
    assert_int_equal(cps_evolution_report(evolution).outcome, CPS_OUTCOME_SOLVED);
    assert_int_equal(cps_results_append(results, evolution, &err), CPS_OK);
    assert_int_equal(cps_results_finish(results, 0, &err), CPS_OK);
    cps_results_destroy(results);
    cps_evolution_destroy(evolution);
    assert_in_range(most_points("results-parts/elevation.svg"), MOST - 1, MOST + 1);
    assert_in_range(most_points("results-parts/tension.svg"), MOST - 1, MOST + 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(nothing_after_a_failure),
                                       cmocka_unit_test(names_that_do_not_fit),
                                       cmocka_unit_test(steps_that_have_not_converged),
                                       cmocka_unit_test(long_lines)};
    return cmocka_run_group_tests_name("parts of results", tests, NULL, NULL);
}
