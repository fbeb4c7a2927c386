/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan-checker FILE.nc [SCENE.yaml] [-v]: recompute every residual of a result file and report
 * whether its claims hold; with the scene, also whether the data that the file takes from the scene
 * are those of the scene. capstan-checker SUMMARY.json: whether the files beside it are those that
 * it lists. */
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "capstan/io.h"
#include "checker.h"
#include "given.h"
#include "whole.h"

/* Findings against the scene; -1: it cannot be read. */
static int against_scene(const char *file, const char *path) {
    CpsSceneFile *scene = NULL;
    CpsError err;
    if (cps_scene_read(path, NULL, &scene, &err) != CPS_OK) {
        fprintf(stderr, "%s\n", err.message);
        return -1;
    }
    const int findings = given_file(file, cps_scene_file_scene(scene), stderr);
    cps_scene_file_destroy(scene);
    return findings;
}

int main(int argc, char **argv) {
    const bool verbose = argc > 2 && strcmp(argv[argc - 1], "-v") == 0;
    const int operands = argc - 1 - verbose;
    const char *dot = operands == 1 ? strrchr(argv[1], '.') : NULL;
    if (dot && strcmp(dot, ".json") == 0) return whole_set(argv[1], stderr) != 0;
    if (operands < 1 || operands > 2 || argv[1][0] == '-') {
        fprintf(stderr, "usage: capstan-checker FILE.nc [SCENE.yaml] [-v], or SUMMARY.json\n");
        return 2;
    }
    CheckerReport report;
    int result = checker_file(argv[1], &report, stderr);
    const int findings = operands > 1 && result != 2 ? against_scene(argv[1], argv[2]) : 0;
    const int foreign = whole_file(argv[1], stderr);
    if (verbose || result != 0 || findings != 0) {
        printf("records %d, certified %d, not certified %d, refuted %d, not finite %d\n",
               report.records, report.certified, report.uncertified, report.refuted,
               report.not_finite);
        printf("worst gap / scale %.3g, imbalance / largest force %.3g, stretch %.3g, depth / "
               "length %.3g\n",
               report.gap, report.force, report.stretch, report.penetration);
        if (operands > 1) printf("against the scene: %d findings\n", findings);
    }
    return result == 0 && findings == 0 && foreign == 0 ? 0 : 1;
}
