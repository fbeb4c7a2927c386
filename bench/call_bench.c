/* SPDX-License-Identifier: BSD-3-Clause */
/* What calls cost in C, beside which compare_python.py puts those from Python.
 *
 *   call_bench SCENE LINE COUNT   moves of end B of a line, to and fro between two places, with one
 *                                 target that is used again; nothing is read
 *   call_bench --support COUNT    supports of a disc and a segment, summed, in many directions
 *
 * Prints seconds of processor per call. The places are those of compare_python.py: where the end is
 * held, and 0.001 m from there along x. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "capstan/evolve.h"
#include "capstan/io.h"

static double now(void) {
    struct timespec t = {0};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static CpsStatus move(const char *path, int line, int count, CpsError *err) {
    CpsSceneFile *file = NULL;
    CpsEvolution *evolution = NULL;
    CpsStatus status = cps_scene_read(path, NULL, &file, err);
    if (!status) status = cps_evolution_create(cps_scene_file_scene(file), &evolution, err);
    while (!status && cps_evolution_remaining_count(evolution) > 0)
        status = cps_evolution_step(evolution, err);
    CpsChange change = {.line = line, .end = CPS_END_B, .to = {.kind = CPS_END_KIND_HELD}};
    CpsStage stage = cps_stage_default();
    stage.change_count = 1;
    stage.change = &change;
    const CpsLineReport report = cps_evolution_line_report(evolution, line);
    memcpy(change.to.value, report.end[CPS_END_B].position, sizeof change.to.value);
    const double x = change.to.value[0], begun = now();
    for (int i = 0; i < count && !status; ++i) {
        change.to.value[0] = x + (i % 2 ? 0 : 1e-3);
        status = cps_evolution_move(evolution, &stage, err);
    }
    if (!status) printf("%.9g\n", (now() - begun) / count);
    cps_evolution_destroy(evolution);
    cps_scene_file_destroy(file);
    return status;
}

static void fill_directions(int count, double *w) {
    for (int i = 0; i < count; ++i) {
        w[2 * (size_t)i] = cos(0.001 * i);
        w[2 * (size_t)i + 1] = sin(0.001 * i);
    }
}

static CpsStatus support(int count, CpsError *err) {
    CpsSet *disc = NULL, *segment = NULL, *sum = NULL;
    CpsStatus status = cps_set_ball(2, NULL, 2, &disc, err);
    if (!status) status = cps_set_segment(2, (double[]){0, -1}, (double[]){0.5, 1}, &segment, err);
    if (!status) status = cps_set_sum(2, (const CpsSet *const[]){disc, segment}, &sum, err);
    double *w = malloc(2 * (size_t)count * sizeof *w), *value = malloc((size_t)count * sizeof *w);
    if (!w || !value) status = CPS_ERR_MEMORY;
    if (!status) fill_directions(count, w);
    const double begun = now();
    for (int i = 0; i < count && !status; ++i) {
        CpsSetAnswer answer;
        status = cps_set_support(sum, w + 2 * (size_t)i, NULL, &answer, err);
        value[i] = answer.value;
    }
    if (!status) printf("%.9g\n", (now() - begun) / count);
    free(w);
    free(value);
    cps_set_release(sum);
    cps_set_release(segment);
    cps_set_release(disc);
    return status;
}

int main(int argc, char **argv) {
    CpsError err = {.message = ""};
    CpsStatus status = CPS_ERR_ARGUMENT;
    if (argc == 3 && strcmp(argv[1], "--support") == 0)
        status = support(atoi(argv[2]), &err);
    else if (argc == 4)
        status = move(argv[1], atoi(argv[2]), atoi(argv[3]), &err);
    else
        snprintf(err.message, sizeof err.message, "expected SCENE LINE COUNT or --support COUNT");
    if (status) fprintf(stderr, "call_bench: %s\n", err.message);
    return status != CPS_OK;
}
