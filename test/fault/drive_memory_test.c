/* SPDX-License-Identifier: BSD-3-Clause */
/* Memory runs out at the k-th allocation of `capstan drive`, for every k: reading each kind of file, answering it,
 * drawing it. The command ends with EXIT_LIMIT and says why, everything allocated is given back, and no part of a
 * picture stays. Allocations are counted by wrapping them at link time. */
#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "commands.h"

static long allowed = -1, live; /* allocations until the one that fails (negative: none fails); blocks held */
static CpsError reported;

static void *counted(void *block) { return live += block != NULL, block; }
static int refuse(void) { return allowed >= 0 && allowed-- == 0; }

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *block, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void __real_free(void *block);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *block, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
void __wrap_free(void *block);

void *__wrap_malloc(size_t size) { return refuse() ? NULL : counted(__real_malloc(size)); }
void *__wrap_calloc(size_t count, size_t size) { return refuse() ? NULL : counted(__real_calloc(count, size)); }
void *__wrap_realloc(void *block, size_t size) {
    if (refuse()) return NULL;
    return block ? __real_realloc(block, size) : counted(__real_realloc(block, size));
}
void *__wrap_aligned_alloc(size_t alignment, size_t size) {
    return refuse() ? NULL : counted(__real_aligned_alloc(alignment, size));
}
void __wrap_free(void *block) {
    live -= block != NULL;
    __real_free(block);
}

/* as main.c, but the error is kept instead of printed */
int cli_report(const CpsError *err) {
    reported = *err;
    return err->status == CPS_ERR_MEMORY ? EXIT_LIMIT : EXIT_INPUT;
}

/* One small file of each kind. */
static const char FILE_NAME[] = "memory-drive.yaml", PICTURE[] = "memory-drive.svg";
static const char SYSTEM[] =
    "capstan: 1\ntitle: Wheel\nsystem:\n  parameters: [spin, side, roll]\n  laws:\n"
    "    - {name: brake, on: [spin], law: {interval: 60}}\n    - {on: [side, roll], law: {disc: 500}}\n"
    "  drive: [side, {roll: 1, spin: -0.3}]\n  load: {side: 3}\n  velocity: [[1, 1]]\n";
static const char GREASE[] = "capstan: 1\nsystem:\n  parameters: [a, b]\n  laws: [{on: [a, b], resistance: [{dry: "
                             "{disc: 3}}, {viscous: [[2, 0], "
                             "[0, 2]]}]}]\n  constraints: [{a: 1, b: -2}]\n  drive: [a]\n  velocity: [[1]]\n";
static const char BODY[] =
    "capstan: 1\nbody:\n  patches:\n    - {rod: {half_length: 1, friction: 1, load: 1}}\n"
    "    - {point: {law: {ellipse: [1, 2]}}}\n    - {wheel: {radius: 1, friction: 1, load: 1, brake: 0.2}}\n"
    "  push: [{at: [1, 0], velocity: [0, 1]}]\n  tow: {hitch: [1, 0], path: [[2, 0]], steps: 3}\n";
static const char ROPE[] =
    "capstan: 1\nrope:\n  shape: {straight: {from: [0, 0], to: [1, 0]}}\n  elements: 4\n  friction: 0.5\n  weight: 2\n"
    "  ends: {B: [1, 1]}\n  path: [[1.1, 0.1]]\n  steps: 2\n";
static const char METER[] =
    "capstan: 1\nplanimeter: {pole: [0, 0], pole_arm: 1, tracer_arm: 1.3, wheel: 0.4, friction: 0.2, load: 1,\n"
    "  curve: {circle: {center: [1, 0], radius: 0.2, points: 9}}}\n";
static const char SWEEP[] = "capstan: 1\nsweep: {law: {disc: 1}, stiffness: 1, path: [[2, 0]], steps: 4}\n";

static void write_file(const char *path, const char *text) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0 && fclose(file) == 0);
}

/* `capstan drive` with its k-th allocation refused; what it prints goes nowhere. *reached: there are so many. */
static int command(long k, int argc, const char *const *argv, bool *reached) {
    reported = (CpsError){.status = CPS_OK};
    fflush(NULL);
    const int out = dup(STDOUT_FILENO), err = dup(STDERR_FILENO), nowhere = open("/dev/null", O_WRONLY);
    assert_true(out >= 0 && err >= 0 && nowhere >= 0);
    dup2(nowhere, STDOUT_FILENO), dup2(nowhere, STDERR_FILENO);
    allowed = k;
    const int code = cmd_drive(argc, (char **)(uintptr_t)argv);
    *reached = allowed < 0;
    allowed = -1;
    fflush(NULL);
    dup2(out, STDOUT_FILENO), dup2(err, STDERR_FILENO);
    close(nowhere), close(out), close(err);
    return code;
}

/* Refuse each allocation in turn: all of the first 300; of those behind, which repeat the same questions, ever fewer.
 */
static void refuse_each(int argc, const char *const *argv, bool draws) {
    bool reached = true;
    long k = 0, tried = 0;
    for (; reached; k += k < 300 ? 1 : k / 10, tried++) {
        const long before = live;
        remove(PICTURE);
        const int code = command(k, argc, argv, &reached);
        if (live != before) fail_msg("allocation %ld: %ld blocks lost", k, live - before);
        /* a closed form without room for its scratch hands over to the solver, so a failure may be made good */
        if (code != EXIT_OK && !(reached && code == EXIT_LIMIT))
            fail_msg("allocation %ld: exit %d: %s", k, code, reported.message);
        if (reported.status != CPS_OK && reported.status != CPS_ERR_MEMORY)
            fail_msg("allocation %ld: %s: %s", k, cps_status_name(reported.status), reported.message);
        if ((access(PICTURE, F_OK) == 0) != (draws && code == EXIT_OK))
            fail_msg("allocation %ld: exit %d, and the picture is %s", k, code, draws ? "not there" : "there");
    }
    remove(PICTURE);
    print_message("%ld allocations, %ld refused\n", k, tried - 1);
    /* built as shared libraries they cannot be reached */
    if (tried == 1) skip();
    /* a read file and its answer take this many at the very least */
    assert_in_range(k, 5, 1000000);
}

/* answered as JSON, and drawn */
static void every_way(const char *text) {
    static const char *const ASK[] = {"drive", FILE_NAME, "--json", "--quiet"};
    static const char *const DRAW[] = {"drive", FILE_NAME, "--quiet", "--plot", PICTURE};
    write_file(FILE_NAME, text);
    refuse_each((int)(sizeof ASK / sizeof *ASK), ASK, false);
    refuse_each((int)(sizeof DRAW / sizeof *DRAW), DRAW, true);
    remove(FILE_NAME);
}

static void system_maps(void **state) {
    (void)state;
    static const char *const REDUCED[] = {"drive", FILE_NAME, "-e", "-v", "1,1", "-f", "0,200", "-p", PICTURE};
    every_way(SYSTEM);
    write_file(FILE_NAME, SYSTEM);
    refuse_each((int)(sizeof REDUCED / sizeof *REDUCED), REDUCED, true);
    remove(FILE_NAME);
}

static void system_resistance(void **state) {
    (void)state;
    static const char *const ASK[] = {"drive", FILE_NAME, "--json"};
    write_file(FILE_NAME, GREASE);
    refuse_each((int)(sizeof ASK / sizeof *ASK), ASK, false);
    remove(FILE_NAME);
}

static void body(void **state) {
    (void)state;
    every_way(BODY);
}

static void rope(void **state) {
    (void)state;
    every_way(ROPE);
}

static void planimeter(void **state) {
    (void)state;
    every_way(METER);
}

static void sweep(void **state) {
    (void)state;
    every_way(SWEEP);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(system_maps), cmocka_unit_test(system_resistance),
                                       cmocka_unit_test(body),        cmocka_unit_test(rope),
                                       cmocka_unit_test(planimeter),  cmocka_unit_test(sweep)};
    return cmocka_run_group_tests_name("driven systems without memory", tests, NULL, NULL);
}
