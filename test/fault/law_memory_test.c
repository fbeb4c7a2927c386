/* SPDX-License-Identifier: BSD-3-Clause */
/* Memory runs out at the k-th allocation of `capstan law`, for every k: reading a law, asking it in all ways, drawing
 * it. The command ends with EXIT_LIMIT and says why, everything allocated is given back, and no part of a picture
 * stays. Allocations are counted by wrapping them at link time. */
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

/* Two files: a wheel on an ellipse, which needs the solver, and a body with every kind of list; and a resistance law.
 */
static const char WHEEL[] = "memory-wheel.yaml", BODY[] = "memory-body.yaml", GREASE[] = "memory-grease.yaml",
                  PICTURE[] = "memory-law.svg";
static const char WHEEL_TEXT[] =
    "capstan: 1\ntitle: Wheel\nload: [1, 0]\n"
    "law: {preimage: {map: [[0, -0.3], [1, 0], [0, 1]], of: {product: [{interval: 60}, {ellipse: [500, 400]}]}}}\n";
static const char BODY_TEXT[] =
    "capstan: 1\nlaw:\n  contacts:\n"
    "    - {map: [[1, 0, 0], [0, 1, 1]], of: {unit_load: {load: 50, of: {ball: {radius: 0.4, dimension: 2}}}}}\n"
    "    - {map: [[1, 0, 0], [0, 1, -1]], of: {polytope: [[1, 0], [0, 1], [-1, -1]]}}\n"
    "    - {map: [[0, 0, 1]], of: {translate: {by: [0.5], of: {box: [[-1, 2]]}}}}\n";
static const char GREASE_TEXT[] = "capstan: 1\nresistance:\n  - {dry: {disc: 3}}\n  - {viscous: [[2, 0], [0, 2]]}\n";

static void write_file(const char *path, const char *text) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0 && fclose(file) == 0);
}

/* `capstan law` with its k-th allocation refused; what it prints goes nowhere. *reached: there are so many. */
static int command(long k, int argc, const char *const *argv, bool *reached) {
    reported = (CpsError){.status = CPS_OK};
    fflush(NULL);
    const int out = dup(STDOUT_FILENO), err = dup(STDERR_FILENO), nowhere = open("/dev/null", O_WRONLY);
    assert_true(out >= 0 && err >= 0 && nowhere >= 0);
    dup2(nowhere, STDOUT_FILENO), dup2(nowhere, STDERR_FILENO);
    allowed = k;
    const int code = cmd_law(argc, (char **)(uintptr_t)argv);
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
    /* a read file, its sets and answers take this many at the very least */
    assert_in_range(k, 50, 1000000);
}
#define REFUSE_EACH(argv, draws) refuse_each((int)(sizeof(argv) / sizeof *(argv)), argv, draws)

static void planar_law(void **state) {
    (void)state;
    write_file(WHEEL, WHEEL_TEXT);
    static const char *const ASK[] = {"law", WHEEL,     "--json",  "--velocity", "1,1", "--velocity",
                                      "0,1", "--force", "400,200", "--force",    "1,0"};
    static const char *const DRAW[] = {"law", WHEEL, "--velocity", "0,1", "--force", "1,0", "--plot", PICTURE};
    REFUSE_EACH(ASK, false);
    REFUSE_EACH(DRAW, true);
    remove(WHEEL);
}

static void law_in_space(void **state) {
    (void)state;
    write_file(BODY, BODY_TEXT);
    static const char *const ASK[] = {"law",        BODY,    "--velocity", "1,1,0",
                                      "--velocity", "0,0,0", "--force",    "0.1,0.2,0.3"};
    static const char *const DRAW[] = {"law", BODY, "--velocity", "0,0,1", "--plot", PICTURE, "--axes", "1,3"};
    REFUSE_EACH(ASK, false);
    REFUSE_EACH(DRAW, true);
    remove(BODY);
}

static void resistance_law(void **state) {
    (void)state;
    write_file(GREASE, GREASE_TEXT);
    static const char *const ASK[] = {"law", GREASE, "--json", "--velocity", "1,1", "--force", "0,-5"};
    REFUSE_EACH(ASK, false);
    remove(GREASE);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(planar_law), cmocka_unit_test(law_in_space),
                                       cmocka_unit_test(resistance_law)};
    return cmocka_run_group_tests_name("laws without memory", tests, NULL, NULL);
}
