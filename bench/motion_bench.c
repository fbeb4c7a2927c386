/* SPDX-License-Identifier: BSD-3-Clause */
/* A history in time, without files: motion_bench SCENE.yaml NODE
 *
 * Prints as CSV, after each step, the time, the force on the first line at its end B and the height
 * across (y) of a node; then the processor time of all steps and how many were not certified. */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "capstan/evolve.h"
#include "capstan/io.h"

int main(int argc, char **argv) {
    CpsSceneFile *file = NULL;
    CpsEvolution *evolution = NULL;
    CpsError err;
    if (argc != 3) {
        fprintf(stderr, "usage: motion_bench SCENE.yaml NODE\n");
        return 2;
    }
    const int node = atoi(argv[2]);
    if (cps_scene_read(argv[1], NULL, &file, &err) != CPS_OK ||
        cps_evolution_create(cps_scene_file_scene(file), &evolution, &err) != CPS_OK) {
        fprintf(stderr, "motion_bench: %s\n", err.message);
        return 1;
    }
    int uncertified = 0, iterations = 0;
    clock_t spent = 0;
    printf("time,fx,fy,fz,y\n");
    while (cps_evolution_remaining_count(evolution) > 0) {
        const clock_t start = clock();
        if (cps_evolution_step(evolution, &err) != CPS_OK) break;
        const CpsLineReport line = cps_evolution_line_report(evolution, 0);
        if (cps_evolution_time(evolution) > 0) {
            spent += clock() - start; /* not that of the static start */
            iterations += line.iteration_count;
        }
        uncertified += !cps_outcome_is_certified(line.outcome);
        const CpsLineView view = cps_evolution_line_view(evolution, 0);
        const double *force = line.end[CPS_END_B].force;
        printf("%.9g,%.9g,%.9g,%.9g,%.9g\n", cps_evolution_time(evolution), force[0], force[1],
               force[2], node <= view.element_count ? view.position[3 * node + 1] : 0);
    }
    printf("processor_s %.4f uncertified %d iterations %d\n", (double)spent / CLOCKS_PER_SEC,
           uncertified, iterations);
    cps_evolution_destroy(evolution);
    cps_scene_file_destroy(file);
    return 0;
}
