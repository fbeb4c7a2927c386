/* SPDX-License-Identifier: BSD-3-Clause */
/* Time of a whole history, without files: history_bench SCENE.yaml [REPEAT]
 *
 * Prints the fastest of REPEAT runs (default 5) as CSV: steps, elements, iterations, seconds in all
 * and per step, what the worst certificate reached, steps not certified, the force across at end B
 * when the history ends, and the energy dissipated. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "capstan/evolve.h"
#include "capstan/io.h"

typedef struct Tally {
    int steps, iterations, uncertified, warm;
    double seconds, gap, friction, dissipated, force[3];
} Tally;

/* One run of the scene; exits with a message where there is none. */
static Tally run(const CpsScene *scene) {
    CpsError err;
    CpsEvolution *evolution = NULL;
    Tally tally = {0};
    if (cps_evolution_create(scene, &evolution, &err) != CPS_OK) {
        fprintf(stderr, "history_bench: %s\n", err.message);
        exit(1);
    }
    while (cps_evolution_remaining_count(evolution) > 0 &&
           cps_evolution_step(evolution, &err) == CPS_OK) {
        const CpsStepReport report = cps_evolution_report(evolution);
        tally.steps++;
        tally.iterations += report.iteration_count;
        tally.seconds += report.wall;
        tally.dissipated += report.dissipated;
        tally.warm += report.warm_count == report.substep_count;
        tally.uncertified += !cps_outcome_is_certified(report.outcome);
        tally.gap = fmax(tally.gap, report.certificate.gap / report.certificate.scale);
        tally.friction = fmax(tally.friction, report.certificate.friction_residual /
                                                  report.certificate.largest_force);
    }
    const CpsLineReport line = cps_evolution_line_report(evolution, 0);
    for (int a = 0; a < 3; a++) tally.force[a] = line.end[CPS_END_B].force[a];
    cps_evolution_destroy(evolution);
    return tally;
}

int main(int argc, char **argv) {
    const int repeat = argc > 2 ? atoi(argv[2]) : 5;
    CpsSceneFile *file = NULL;
    CpsError err;
    if (argc < 2 || repeat < 1) {
        fprintf(stderr, "usage: history_bench SCENE.yaml [REPEAT]\n");
        return 2;
    }
    if (cps_scene_read(argv[1], NULL, &file, &err) != CPS_OK) {
        fprintf(stderr, "history_bench: %s\n", err.message);
        return 1;
    }
    const CpsScene *scene = cps_scene_file_scene(file);
    Tally best = run(scene);
    for (int i = 1; i < repeat; i++) {
        const Tally next = run(scene);
        if (next.seconds < best.seconds) best = next;
    }
    printf("steps,elements,iterations,seconds,ms_per_step,worst_gap,worst_friction_residual,"
           "uncertified,last_lateral_N,dissipated_J,warm\n");
    printf("%d,%d,%d,%.4f,%.4f,%.1e,%.1e,%d,%.1f,%.1f,%d\n", best.steps,
           scene->line[0].element_count, best.iterations, best.seconds,
           1e3 * best.seconds / best.steps, best.gap, best.friction, best.uncertified,
           best.force[1], best.dissipated, best.warm);
    cps_scene_file_destroy(file);
    return 0;
}
