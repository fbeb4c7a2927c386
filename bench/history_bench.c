/* SPDX-License-Identifier: BSD-3-Clause */
/* Time of a whole history, without files: history_bench SCENE.yaml [REPEAT]
 *
 * Runs the history REPEAT times (default 5) as it is, and as often cold, in turns. Prints the
 * fastest run as CSV: steps, elements, iterations, seconds in all and per step, what the worst
 * certificate reached, steps not certified, the force across at end B when the history ends, the
 * energy dissipated, steps that were warm; seconds of processor, and those of the fastest cold run
 * over them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "capstan/evolve.h"
#include "capstan/io.h"

typedef struct Tally {
    int steps, iterations, uncertified, warm;
    double seconds, processor, gap, friction, dissipated, force[3];
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
    const clock_t start = clock();
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
    tally.processor = (double)(clock() - start) / CLOCKS_PER_SEC;
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
    CpsScene scene = *cps_scene_file_scene(file);
    const bool is_cold = scene.solver.cold;
    Tally best = {.seconds = INFINITY};
    double processor[2] = {INFINITY, INFINITY};
    for (int i = 0; i < 2 * repeat; i++) {
        scene.solver.cold = i % 2 || is_cold;
        const Tally next = run(&scene);
        processor[i % 2] = fmin(processor[i % 2], next.processor);
        if (i % 2 == 0 && next.seconds < best.seconds) best = next;
    }
    printf("steps,elements,iterations,seconds,ms_per_step,worst_gap,worst_friction_residual,"
           "uncertified,last_lateral_N,dissipated_J,warm,processor_s,cold_over_warm\n");
    printf("%d,%d,%d,%.4f,%.4f,%.1e,%.1e,%d,%.1f,%.1f,%d,%.4f,%.2f\n", best.steps,
           scene.line[0].element_count, best.iterations, best.seconds,
           1e3 * best.seconds / best.steps, best.gap, best.friction, best.uncertified,
           best.force[1], best.dissipated, best.warm, processor[0], processor[1] / processor[0]);
    cps_scene_file_destroy(file);
    return 0;
}
