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

/* The text of the scene, which stays the caller's, and perhaps files that it names. */
int falsified_begin(const char *scene, void **state);
int falsified_begin_beside(const char *scene, const DataFile *file, size_t count, void **state);
int falsified_end(void **state);

/* The checker finds nothing and certifies so many records. */
void falsified_check_sound(int records);
void falsified_check_numbers(const FalseNumber *number, size_t count);
void falsified_check_scenes(const OtherScene *other, size_t count);

#endif
