/* SPDX-License-Identifier: BSD-3-Clause */
/* Memory runs out at the k-th allocation of a run with a friction set and friction zones, for every
 * k: from reading the scene to the finished results. The call reports it and no file is left
 * behind; the address sanitizer finds memory that is not freed. */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "capstan/io.h"
#include "capstan/results.h"
#include "check.h"
#include "hull_set.h"
#include "refuse.h"

static const char SCENE[] = "memory-grooves.yaml", RESULTS[] = "memory-grooves-out";
static const char TEXT[] =
    "capstan: 1\n"
    "obstacles:\n"
    "  bed: {plane: {}, friction: {set: " HULL_SET ", grain: [1, 1, 0]}}\n"
    "  wall: {plane: {point: [9, 0, 0], normal: [-1, 0, 0]}, friction: {set: {box: [0.2, 0]}}}\n"
    "lines:\n"
    "  rope:\n"
    "    {length: 6, elements: 4, weight: 10, stiffness: 1e4, ends: {A: held, B: free},\n"
    "     start: {straight: {from: [0, 0, 0], to: [6, 0, 0]}}, friction_zones: [{from: 1, to: 2, "
    "factor: 2}]}\n"
    "history: [{rope.B: {force: [9, 2, 0]}}]\n";

static CpsStatus run(CpsError *err) {
    CpsSceneFile *file = NULL;
    CpsEvolution *evolution = NULL;
    CpsResults *results = NULL;
    CpsStatus status = cps_scene_read(SCENE, NULL, &file, err);
    if (!status) status = cps_evolution_create(cps_scene_file_scene(file), &evolution, err);
    if (!status)
        status =
            cps_results_open(RESULTS, cps_scene_file_scene(file), evolution, NULL, &results, err);
    if (!status) status = cps_evolution_step(evolution, err);
    if (!status) status = cps_results_append(results, evolution, err);
    if (!status) status = cps_results_finish(results, 0, err);
    cps_results_destroy(results);
    cps_evolution_destroy(evolution);
    cps_scene_file_destroy(file);
    return status;
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    CpsError err = {0};
    long k = 0;
    for (;; k++) {
        allowed = k;
        const CpsStatus status = run(&err);
        const bool reached = allowed < 0;
        allowed = -1;
        if (!reached) {
            CHECK_INT(status, CPS_OK);
            break;
        }
        if (status != CPS_ERR_MEMORY)
            fail_msg("allocation %ld: %s: %s", k, cps_status_name(status), err.message);
        if (access(RESULTS, F_OK) == 0)
            fail_msg("allocation %ld failed and left something behind", k);
    }
    if (k == 0) skip(); /* shared libraries, which the wrapping does not reach */
    print_message("%ld allocations, each refused once\n", k);
    CHECK_GREATER((double)k,
                  100); /* two sets, their conic forms and a run take this many at the very least */
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_allocation_may_fail)};
    FILE *out = fopen(SCENE, "w");
    if (!out || fputs(TEXT, out) < 0 || fclose(out) != 0 ||
        system("rm -rf memory-grooves-out") != 0)
        return 1;
    const int failed = cmocka_run_group_tests_name("grooves without memory", tests, NULL, NULL);
    remove(SCENE);
    return system("rm -rf memory-grooves-out") != 0 || failed;
}
