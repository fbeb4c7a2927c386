/* SPDX-License-Identifier: BSD-3-Clause */
/* Fuzzing the scene reader: any bytes give a scene that passed its check, or an error with a sentence.
 *
 *   cmake --preset dev -B build/fuzz -DCMAKE_C_COMPILER=clang -DCAPSTAN_FUZZ=ON \
 *     -DCMAKE_C_FLAGS=-fsanitize=fuzzer-no-link
 *   cmake --build build/fuzz --target scene_fuzz
 *   mkdir corpus && ASAN_OPTIONS=detect_leaks=0 build/fuzz/test/fuzz/scene_fuzz -max_total_time=60 corpus examples
 *
 * New inputs go to the first folder. libfyaml leaks on some broken keys, hence the option. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "capstan/io.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char path[] = "/tmp/scene_fuzz_XXXXXX";
    const int file = mkstemp(path);
    if (file < 0 || write(file, data, size) != (ssize_t)size) abort();
    close(file);
    CpsSceneFile *scene = NULL;
    CpsError err;
    const CpsStatus status = cps_scene_read(path, NULL, &scene, &err);
    if (status == CPS_OK && cps_scene_check(cps_scene_file_scene(scene), NULL) != CPS_OK) abort();
    if (status != CPS_OK && (scene || err.status != status || !err.message[0])) abort();
    cps_scene_file_destroy(scene);
    unlink(path);
    return 0;
}
