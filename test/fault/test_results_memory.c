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

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_allocation_may_fail)};
    /* of an earlier run of this test */
    if (system("rm -rf memory-out") != 0) return 1;
    return cmocka_run_group_tests_name("results without memory", tests, NULL, NULL);
}
