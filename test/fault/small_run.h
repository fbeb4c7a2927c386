/* SPDX-License-Identifier: BSD-3-Clause */
/* The run that the fault tests disturb: a rope on a bed, pulled by its tip and let go. */
#ifndef CAPSTAN_TEST_FAULT_SMALL_RUN_H
#define CAPSTAN_TEST_FAULT_SMALL_RUN_H

#include "capstan/results.h"
#include "straight_rope.h"

/* A rope of 6 m, straight between two points. */
static inline CpsLine small_rope(int elements, const double point[6]) {
    return straight_rope(point, 6, elements, 10, 1e4);
}

/* Write the results of that run with `elements` elements into `directory`; whatever fails is
 * cleaned up as a program would do it. */
static inline CpsStatus small_run(const char *directory, int elements, CpsError *err) {
    const double point[6] = {0, 0, 0, 6, 0, 0};
    const CpsChange change[2] = {
        {.line = 0, .end = CPS_END_B, .to = {CPS_END_KIND_HELD, {5.9, 0.2, 0}}},
        {.line = 0, .end = CPS_END_B, .to = {CPS_END_KIND_HELD, {6, 0, 0}}}};
    const CpsStage stage[2] = {{.cookie = cps_stage_default().cookie,
                                .name = "there",
                                .step_count = 2,
                                .change_count = 1,
                                .change = &change[0]},
                               {.cookie = cps_stage_default().cookie,
                                .name = "back",
                                .step_count = 2,
                                .change_count = 1,
                                .change = &change[1]}};
    CpsObstacle bed = cps_obstacle_default();
    bed.name = "bed";
    bed.friction = 0.3;
    const CpsLine line = small_rope(elements, point);
    CpsScene scene = cps_scene_default();
    scene.title = "a run that something happens to";
    scene.obstacle_count = 1;
    scene.obstacle = &bed;
    scene.line_count = 1;
    scene.line = &line;
    scene.stage_count = 2;
    scene.stage = stage;

    CpsEvolution *evolution = NULL;
    CpsResults *results = NULL;
    CpsStatus status = cps_evolution_create(&scene, &evolution, err);
    if (!status) status = cps_results_open(directory, &scene, evolution, NULL, &results, err);
    while (!status && cps_evolution_remaining_count(evolution) > 0) {
        status = cps_evolution_step(evolution, err);
        if (!status) status = cps_results_append(results, evolution, err);
    }
    if (!status) status = cps_results_finish(results, 1, err);
    cps_results_destroy(results);
    cps_evolution_destroy(evolution);
    return status;
}

#endif
