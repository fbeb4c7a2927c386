/* SPDX-License-Identifier: BSD-3-Clause */
/* A scene and its result file: the file is sound and the scene's, copies with a number changed are
 * refused, and so is the file beside a scene that differs. For test programs with one scene, which
 * these run before the tests and remove after them (run_scene.h). */
#ifndef CAPSTAN_CHECKER_FALSIFIED_H
#define CAPSTAN_CHECKER_FALSIFIED_H

#include <stddef.h>

/* A number of the file that is replaced (sample_poke), and words of what the checker finds; NULL:
 * what is found beside the scene. */
typedef struct FalseNumber {
    const char *variable;
    size_t index;
    double value;
    const char *finding;
} FalseNumber;

/* Another scene: every `from` in its text becomes `to`. */
typedef struct OtherScene {
    const char *from, *to;
} OtherScene;

/* A file beside the scene. */
typedef struct DataFile {
    const char *name, *text;
} DataFile;

/* All that is tried of a scene. */
typedef struct Falsified {
    const char *scene;    /* its text */
    int records;          /* of its result file, all of which are certified */
    const DataFile *file; /* (files) that it names */
    size_t files;
    const FalseNumber *number;
    size_t numbers;
    const OtherScene *other;
    size_t others;
} Falsified;

/* A table and the number of its rows, for a member of Falsified and the one after it. */
#define FALSIFIED_ROWS(table) table, sizeof(table) / sizeof *(table)

/* Try it, as the main function of a program does; returns the number of tests that failed. */
int falsified_main(const Falsified *given);

#endif
