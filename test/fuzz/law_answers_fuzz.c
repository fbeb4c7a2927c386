/* SPDX-License-Identifier: BSD-3-Clause */
/* Fuzzing the law reader: any bytes give a law that answers what it is asked, or an error with a
 * sentence; and every number of an answer is one.
 *
 *   cmake --preset dev -B build/fuzz -DCMAKE_C_COMPILER=clang -DCAPSTAN_FUZZ=ON \
 *     -DCAPSTAN_SANITIZE=address,undefined -DCMAKE_C_FLAGS=-fsanitize=fuzzer-no-link
 *   cmake --build build/fuzz --target fuzz_law_answers
 *   mkdir corpus bad && python3 test/cli/bad_laws.py --write bad
 *   ASAN_OPTIONS=detect_leaks=0 build/fuzz/test/fuzz/fuzz_law_answers -timeout=60 \
 *     -max_total_time=300 -max_len=1500 -dict=test/fuzz/law.dict corpus examples/laws bad
 *
 * New inputs go to the first folder. libfyaml leaks on some broken keys, hence the option. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "capstan/io.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Questions are asked of laws with few components: of more, each may take seconds. */
enum { MOST_ASKED = 4 };

/* only what is said to be answered must be finite */
static void expect_number(const CpsSetAnswer *answer) {
    if (answer->outcome == CPS_SET_OUTCOME_ANSWERED &&
        (!isfinite(answer->value) || isnan(answer->gap)))
        abort();
}

static void ask_friction(const CpsSet *set) {
    const double velocity[MOST_ASKED] = {1, -0.5, 0.25, 0}, zero[MOST_ASKED] = {0};
    CpsSet *forces = NULL, *velocities = NULL;
    CpsSetAnswer answer;
    char text[200];
    CpsStatus status = cps_set_forces(set, velocity, 0, &forces, &answer, NULL);
    if (status == CPS_OK) expect_number(&answer);
    if (status == CPS_OK) status = cps_set_velocities(set, zero, 0, &velocities, &answer, NULL);
    if (forces) cps_set_text(forces, text, sizeof text);
    if (velocities) cps_set_text(velocities, text, sizeof text);
    /* too large for the solver is an answer as well; an argument cannot be wrong */
    if (status == CPS_ERR_ARGUMENT || status == CPS_ERR_INPUT) abort();
    cps_set_release(forces);
    cps_set_release(velocities);
}

static void ask_resistance(const CpsResistance *law) {
    const double velocity[MOST_ASKED] = {1, -0.5, 0.25, 0};
    double found[MOST_ASKED];
    CpsResistanceValue value;
    CpsSetAnswer answer;
    CpsStatus status = cps_resistance_value(law, velocity, &value, NULL, NULL);
    if (status == CPS_OK && value.outcome == CPS_SET_OUTCOME_ANSWERED &&
        (isnan(value.potential) || isnan(value.power)))
        abort();
    if (status == CPS_OK) status = cps_resistance_conjugate(law, velocity, found, &answer, NULL);
    if (status == CPS_OK && answer.outcome == CPS_SET_OUTCOME_ANSWERED && isnan(answer.value))
        abort();
    if (status == CPS_ERR_ARGUMENT || status == CPS_ERR_INPUT) abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char path[] = "/tmp/law_answers_XXXXXX";
    const int file = mkstemp(path);
    if (file < 0 || write(file, data, size) != (ssize_t)size) abort();
    close(file);
    CpsLawFile *law = NULL;
    CpsError err;
    const CpsStatus status = cps_law_read(path, NULL, &law, &err);
    if (status != CPS_OK && (law || err.status != status || !err.message[0])) abort();
    if (law && cps_law_file_space(law) <= MOST_ASKED) {
        if (cps_law_file_set(law)) ask_friction(cps_law_file_set(law));
        if (cps_law_file_resistance(law)) ask_resistance(cps_law_file_resistance(law));
    }
    cps_law_file_destroy(law);
    unlink(path);
    return 0;
}
