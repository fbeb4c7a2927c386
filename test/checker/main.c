/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan-checker FILE.nc [SCENE.yaml] [-v]: recompute every residual of a result file and report
 * whether its claims hold; with the scene, also whether the data that the file takes from the scene
 * are those of the scene. capstan-checker SUMMARY.json: whether the files beside it are those that
 * it lists. */
#define _POSIX_C_SOURCE 200809L /* open_memstream */
#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/io.h"
#include "checker.h"
#include "given.h"
#include "printable.h"
#include "whole.h"

/* Findings against the scene; -1: it cannot be read. */
static int against_scene(const char *file, const char *path, FILE *log) {
    CpsSceneFile *scene = NULL;
    CpsError err;
    if (cps_scene_read(path, NULL, &scene, &err) != CPS_OK) {
        fprintf(log, "%s\n", err.message);
        return -1;
    }
    const int findings = given_file(file, cps_scene_file_scene(scene), log);
    cps_scene_file_destroy(scene);
    return findings;
}

/* A result file, with its scene where that is not NULL; the exit code. */
static int check(const char *file, const char *scene, bool verbose, FILE *log) {
    CheckerReport report;
    const int result = checker_file(file, &report, log);
    const int findings = scene && result != 2 ? against_scene(file, scene, log) : 0;
    const int foreign = whole_file(file, log);
    if (verbose || result != 0 || findings != 0) {
        printf("records %d, certified %d, not certified %d, refuted %d, not finite %d\n",
               report.records, report.certified, report.uncertified, report.refuted,
               report.not_finite);
        printf("worst gap / scale %.3g, imbalance / largest force %.3g, stretch %.3g, depth / "
               "length %.3g\n",
               report.gap, report.force, report.stretch, report.penetration);
        if (report.events.steps > 0)
            printf(
                "in time: %d steps, landed %d, changed %d, snatched %d, imbalance %.3g of %.3g J\n",
                report.events.steps, report.events.landed, report.events.changed,
                report.events.snatched, report.events.imbalance, report.events.turnover);
        if (scene) printf("against the scene: %d findings\n", findings);
    }
    return result == 0 && findings == 0 && foreign == 0 ? 0 : 1;
}

/* Names of files, and those in files, may contain what controls a terminal. */
static void print_lines(char *text) {
    for (char *line = text, *end; *line; line = end) {
        end = line + strcspn(line, "\n");
        const bool more = *end == '\n';
        *end = '\0';
        cli_print_text(stderr, line, INT_MAX, false);
        if (more) {
            fputc('\n', stderr);
            end++;
        }
    }
}

int main(int argc, char **argv) {
    const bool verbose = argc > 2 && strcmp(argv[argc - 1], "-v") == 0;
    const int operands = argc - 1 - verbose;
    if (operands < 1 || operands > 2 || argv[1][0] == '-') {
        fprintf(stderr, "usage: capstan-checker FILE.nc [SCENE.yaml] [-v], or SUMMARY.json\n");
        return 2;
    }
    char *text = NULL;
    size_t size = 0;
    FILE *log = open_memstream(&text, &size);
    if (!log) {
        fprintf(stderr, "out of memory\n");
        return 1;
    }
    const char *dot = operands == 1 ? strrchr(argv[1], '.') : NULL;
    const int code = dot && strcmp(dot, ".json") == 0
                         ? whole_set(argv[1], log) != 0
                         : check(argv[1], operands > 1 ? argv[2] : NULL, verbose, log);
    const bool whole = fclose(log) == 0;
    if (text) print_lines(text);
    free(text);
    return whole ? code : 1;
}
