/* SPDX-License-Identifier: BSD-3-Clause */
/* A scene from its file to its results (run_scene.h). */
#include "run_scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "capstan/evolve.h"
#include "capstan/io.h"
#include "capstan/results.h"
#include "check.h"

static char directory[] = "capstan-scene-XXXXXX";
char scene_path[64], scene_result[64];

int make_scene_directory(void **state) {
    (void)state;
    if (!mkdtemp(directory)) return -1;
    snprintf(scene_path, sizeof scene_path, "%s/scene.yaml", directory);
    snprintf(scene_result, sizeof scene_result, "%s/result.nc", directory);
    return 0;
}

int remove_scene_directory(void **state) {
    (void)state;
    char command[80];
    snprintf(command, sizeof command, "rm -r '%s'", directory);
    return system(command);
}

CpsLineReport run_scene(void) {
    CpsSceneFile *scene = NULL;
    CpsError err = {0};
    CpsEvolution *evolution = NULL;
    CpsResults *results = NULL;
    CpsStatus status = cps_scene_read(scene_path, NULL, &scene, &err);
    if (!status) status = cps_evolution_create(cps_scene_file_scene(scene), &evolution, &err);
    if (!status) status = cps_results_prepare(directory, CPS_RESULTS_KIND_RUN, 0, true, &err);
    if (!status)
        status = cps_results_open(directory, cps_scene_file_scene(scene), evolution, NULL, &results,
                                  &err);
    while (!status && cps_evolution_remaining_count(evolution) > 0) {
        status = cps_evolution_step(evolution, &err);
        if (!status) status = cps_results_append(results, evolution, &err);
    }
    if (!status) status = cps_results_finish(results, 0, &err);
    if (status) print_error("%s\n", err.message);
    assert_int_equal(status, CPS_OK);
    const CpsLineReport report = cps_evolution_line_report(evolution, 0);
    cps_results_destroy(results);
    cps_evolution_destroy(evolution);
    cps_scene_file_destroy(scene);
    return report;
}
