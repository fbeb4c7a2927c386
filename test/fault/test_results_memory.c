/* SPDX-License-Identifier: BSD-3-Clause */
/* Memory runs out at the k-th allocation of a run, for every k: the call says so, nothing is left
 * behind, nothing leaks (the sanitizers look). Allocations are counted by wrapping them at link
 * time, which reaches the static libraries; built as shared libraries they cannot be reached, and
 * the test is skipped. */
#include <locale.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "small_run.h"

static long allowed = -1; /* allocations until the one that fails; negative: none fails */

static int refuse(void) { return allowed >= 0 && allowed-- == 0; }

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *block, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
char *__real_strdup(const char *text);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *block, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
char *__wrap_strdup(const char *text);

void *__wrap_malloc(size_t size) { return refuse() ? NULL : __real_malloc(size); }
void *__wrap_calloc(size_t count, size_t size) {
    return refuse() ? NULL : __real_calloc(count, size);
}
void *__wrap_realloc(void *block, size_t size) {
    return refuse() ? NULL : __real_realloc(block, size);
}
void *__wrap_aligned_alloc(size_t alignment, size_t size) {
    return refuse() ? NULL : __real_aligned_alloc(alignment, size);
}
char *__wrap_strdup(const char *text) { return refuse() ? NULL : __real_strdup(text); }

locale_t __real_newlocale(int mask, const char *name, locale_t base);
locale_t __wrap_newlocale(int mask, const char *name, locale_t base);
locale_t __wrap_newlocale(int mask, const char *name, locale_t base) {
    return refuse() ? (locale_t)0 : __real_newlocale(mask, name, base);
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    CpsError err;
    long k = 0;
    for (;; k++) {
        allowed = k;
        const CpsStatus status = small_run("memory-out", 8, &err);
        const int reached = allowed < 0;
        allowed = -1;
        if (!reached) {
            assert_int_equal(status, CPS_OK);
            break;
        }
        if (status != CPS_ERR_MEMORY)
            fail_msg("allocation %ld: %s: %s", k, cps_status_name(status), err.message);
        if (access("memory-out", F_OK) == 0)
            fail_msg("allocation %ld failed and left something behind", k);
    }
    if (k == 0) skip();
    print_message("%ld allocations, each refused once\n", k);
    /* an opened run, its rows, shapes and names take this many at the very least */
    assert_in_range(k, 20, 100000);
}

/* A directory in which a run was killed lists unfinished files, whose names take memory. */
static void a_list_without_memory(void **state) {
    (void)state;
    CpsError err;
    assert_int_equal(system("rm -rf memory-list && mkdir memory-list"), 0);
    assert_int_equal(system("printf 'capstan directory 1\n' > memory-list/.capstan"), 0);
    assert_int_equal(system("printf 'capstan directory 1\np result.nc\np history.csv\n' > "
                            "memory-list/.capstan.run"),
                     0);
    long k = 0;
    for (;; k++) {
        allowed = k;
        const CpsStatus status =
            cps_results_prepare("memory-list", CPS_RESULTS_KIND_RUN, 0, false, &err);
        const int reached = allowed < 0;
        allowed = -1;
        if (!reached) {
            assert_int_equal(status, CPS_OK);
            break;
        }
        assert_int_equal(status, CPS_ERR_MEMORY);
    }
    assert_int_equal(system("rm -r memory-list"), 0);
    if (k == 0) skip();
    assert_in_range(k, 3, 1000); /* the directory, its list, a name */
}

/* The same of a journal that is opened: it says so, and there is none. */
static void a_journal_without_memory(void **state) {
    (void)state;
    const double point[6] = {0, 0, 0, 6, 0, 0};
    const CpsLine line = small_rope(8, point);
    CpsScene scene = cps_scene_default();
    scene.line_count = 1;
    scene.line = &line;
    CpsError err;
    CpsEvolution *evolution = NULL;
    assert_int_equal(system("mkdir -p memory-journal"), 0);
    assert_int_equal(cps_evolution_create(&scene, &evolution, &err), CPS_OK);
    long k = 0;
    for (;; k++) {
        CpsJournal *journal = NULL;
        allowed = k;
        const CpsStatus status =
            cps_journal_open("memory-journal", evolution, CPS_JOURNAL_NEW, &journal, &err);
        const int reached = allowed < 0;
        allowed = -1;
        if (!reached) {
            assert_int_equal(status, CPS_OK);
            cps_journal_destroy(journal);
            break;
        }
        assert_int_equal(status, CPS_ERR_MEMORY);
        assert_null(journal);
        assert_int_not_equal(access("memory-journal/.journal", F_OK), 0);
    }
    cps_evolution_destroy(evolution);
    assert_int_equal(rmdir("memory-journal"), 0);
    if (k == 0) skip();
    assert_int_equal(k, 3); /* the journal, its directory, its state */
}

/* Numbers are written in the locale C, which takes memory. */
static void a_summary_without_a_locale(void **state) {
    (void)state;
    static const double POSITION[6];
    static const char *const NAME[] = {"start"};
    const CpsRegularizedParameters parameters = {0};
    const CpsRegularizedReport report = {0};
    const CpsRegularizedLine line = {.name = "rope",
                                     .point_count = 2,
                                     .position = POSITION,
                                     .parameters = &parameters,
                                     .report = &report};
    const CpsRegularizedRun run = {.cookie = cps_regularized_run_default().cookie,
                                   .title = "",
                                   .step_count = 1,
                                   .line_count = 1,
                                   .step_name = NAME,
                                   .line = &line};
    char text[1000] = "";
    CpsError err;
    FILE *out = fmemopen(text, sizeof text - 1, "w");
    assert_non_null(out);
    allowed = 0;
    const CpsStatus status = cps_regularized_summary(&run, out, &err);
    const int reached = allowed < 0;
    allowed = -1;
    fclose(out);
    if (!reached) skip();
    assert_int_equal(status, CPS_ERR_MEMORY);
    assert_string_equal(text, "");
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_allocation_may_fail),
                                       cmocka_unit_test(a_list_without_memory),
                                       cmocka_unit_test(a_journal_without_memory),
                                       cmocka_unit_test(a_summary_without_a_locale)};
    /* of an earlier run of this test */
    if (system("rm -rf memory-out memory-journal") != 0) return 1;
    return cmocka_run_group_tests_name("results without memory", tests, NULL, NULL);
}
