/* SPDX-License-Identifier: BSD-3-Clause */
/* The cost of a move beside that of a step of the history: move_bench [ELEMENTS] [REPEAT]
 *
 * A rope on a rough bed, its end drawn to and fro in 200 steps: as a history, as moves, and as
 * moves while a node is held, in turns. Prints the fastest of REPEAT runs (default 5) as CSV:
 * elements, seconds of processor per step of the history, per move, and per move with a held node,
 * and the last two over the first. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "capstan/evolve.h"

enum { STEPS = 200 };
typedef enum Way { HISTORY, MOVES, GRASPED, WAYS } Way;

static CpsChange target(int k) {
    const double pull = 0.5 * sin(0.1 * k);
    return (CpsChange){.end = CPS_END_B, .to = {CPS_END_KIND_FREE, {pull, 0.3 * pull, 0}}};
}

/* Seconds of processor per step. */
static double run(const CpsScene *scene, Way way) {
    CpsScene own = *scene;
    if (way != HISTORY) own.stage_count = 0;
    CpsEvolution *evolution = NULL;
    CpsError err;
    if (cps_evolution_create(&own, &evolution, &err) != CPS_OK) exit(1);
    const CpsGraspChange grip = {.node = scene->line[0].element_count / 2,
                                 .kind = CPS_END_KIND_HELD,
                                 .stays = true};
    CpsStage move = cps_stage_default();
    const clock_t start = clock();
    for (int k = 0; k < STEPS; k++) {
        const CpsChange change = target(k);
        move.change_count = 1;
        move.change = &change;
        move.grasp_change_count = way == GRASPED && k == 0;
        move.grasp_change = &grip;
        const CpsStatus status = way == HISTORY ? cps_evolution_step(evolution, &err)
                                                : cps_evolution_move(evolution, &move, &err);
        if (status != CPS_OK ||
            !cps_outcome_is_certified(cps_evolution_report(evolution).outcome)) {
            fprintf(stderr, "move_bench: step %d\n", k);
            exit(1);
        }
    }
    const double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    cps_evolution_destroy(evolution);
    return seconds / STEPS;
}

int main(int argc, char **argv) {
    const int elements = argc > 1 ? atoi(argv[1]) : 400, repeat = argc > 2 ? atoi(argv[2]) : 5;
    const double ends[] = {0, 0, 0, 6.28, 0, 0};
    if (elements < 2 || repeat < 1) return 2;
    CpsObstacle bed = cps_obstacle_default();
    bed.name = "bed";
    bed.friction = 0.25 / 9.81;
    CpsLine rope = cps_line_default();
    rope.name = "rope";
    rope.length = 6.28;
    rope.element_count = elements;
    rope.weight = 9.81;
    rope.stiffness = 10;
    rope.start = (CpsStart){.kind = CPS_START_STRAIGHT, .point_count = 2, .point = ends};
    static CpsStage stage[STEPS];
    static CpsChange change[STEPS];
    for (int k = 0; k < STEPS; k++) {
        change[k] = target(k);
        stage[k] = cps_stage_default();
        stage[k].name = "pull";
        stage[k].change_count = 1;
        stage[k].change = &change[k];
    }
    CpsScene scene = cps_scene_default();
    scene.obstacle_count = scene.line_count = 1;
    scene.obstacle = &bed;
    scene.line = &rope;
    scene.stage_count = STEPS;
    scene.stage = stage;
    double best[WAYS] = {INFINITY, INFINITY, INFINITY};
    for (int i = 0; i < repeat; i++)
        for (int way = 0; way < WAYS; way++) best[way] = fmin(best[way], run(&scene, (Way)way));
    printf("elements,history_s,move_s,grasped_s,move_over_history,grasped_over_history\n");
    printf("%d,%.3g,%.3g,%.3g,%.3f,%.3f\n", elements, best[HISTORY], best[MOVES], best[GRASPED],
           best[MOVES] / best[HISTORY], best[GRASPED] / best[HISTORY]);
    return 0;
}
