/* SPDX-License-Identifier: BSD-3-Clause */
/* The parts of a directory of results by themselves: its list, files that are displaced, files that
 * are synced at the end, sets of files; each of their calls fails, one after the other. */
#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "capstan/results.h"
#include "io/base/directory/directory_marker.h"
#include "io/base/directory/file_set.h"
#include "io/base/directory/write_directory.h"
#include "refuse_files.h"

static const char OUT[] = "directory-parts";

static bool is_there(const char *name) {
    char path[300];
    struct stat about;
    snprintf(path, sizeof path, "%s/%s", OUT, name);
    return lstat(path, &about) == 0;
}

static int start(void **state) {
    (void)state;
    fails_at = -1;
    return system("rm -rf directory-parts");
}

static void names_in_order(void **state) {
    (void)state;
    CpsiNames names = {0};
    assert_false(cpsi_names_have(&names, "b"));
    static const char *const ADDED[] = {"d", "b", "f", "b"};
    for (size_t i = 0; i < 4; i++) assert_int_equal(cpsi_names_add(&names, ADDED[i], NULL), CPS_OK);
    assert_int_equal(names.count, 3);
    static const char *const OTHERS[] = {"a", "c", "e", "g"};
    for (size_t i = 0; i < 4; i++) {
        assert_false(cpsi_names_have(&names, OTHERS[i]));
        cpsi_names_drop(&names, OTHERS[i]);
    }
    assert_int_equal(names.count, 3);
    cpsi_names_drop(&names, "d");
    assert_true(names.count == 2 && !cpsi_names_have(&names, "d") && cpsi_names_have(&names, "f"));
    cpsi_names_free(&names);
}

/* loop-NAME.svg of the names in `loops`, and a summary, `late`: synced at the end */
static bool is_loop(const char *name) { return strncmp(name, "loop-", 5) == 0; }
static CpsStatus put(const char *loops, bool late, CpsError *err) {
    CpsiDirectory *directory = NULL;
    CpsStatus status = cpsi_directory_open(OUT, &directory, err);
    if (late && !status) cpsi_directory_sync_late(directory);
    for (const char *c = loops; *c && !status; c++) {
        const char name[] = {'l', 'o', 'o', 'p', '-', *c, '.', 's', 'v', 'g', 0};
        assert_false(cpsi_directory_has(directory, name));
        FILE *out = NULL;
        status = cpsi_directory_create(directory, name, &out, err);
        if (!status) status = cpsi_directory_close_file(directory, out, err);
        if (!status) assert_true(cpsi_directory_has(directory, name));
    }
    FILE *out = NULL;
    if (!status) status = cpsi_directory_create(directory, "summary.json", &out, err);
    if (!status) status = cpsi_directory_close_file(directory, out, err);
    if (!status) status = cpsi_directory_commit(directory, is_loop, err);
    cpsi_directory_destroy(directory);
    return status;
}

/* true: there are so many calls */
static bool refuse_call(long k, bool late) {
    CpsError err = {0};
    assert_int_equal(start(NULL), 0);
    assert_int_equal(put("abc", false, &err), CPS_OK);
    calls = 0;
    fails_at = k;
    const CpsStatus status = put("bd", late, &err);
    const bool reached = calls > k;
    fails_at = -1;
    if (status && status != CPS_ERR_IO && status != CPS_ERR_MEMORY)
        fail_msg("call %ld: %s: %s", k, cps_status_name(status), err.message);
    if (!status && !(is_there("loop-d.svg") && is_there("summary.json")))
        fail_msg("call %ld: nothing is there, and nothing was said", k);
    if (put("be", false, &err) != CPS_OK) fail_msg("call %ld: the next: %s", k, err.message);
    if (is_there("loop-a.svg") || is_there("loop-c.svg") || is_there("loop-d.svg"))
        fail_msg("call %ld, %s: files of an earlier set are left", k, strerror(why));
    assert_true(is_there("loop-b.svg") && is_there("loop-e.svg"));
    return reached;
}

static void files_are_displaced(void **state) {
    (void)state;
    static const int REASON[] = {EIO, ENOSPC, EINTR, EINVAL, EWOULDBLOCK, NOTHING_WRITTEN};
    for (size_t i = 0; i < 2 * sizeof REASON / sizeof *REASON; i++) {
        why = REASON[i / 2];
        long k = 0;
        while (refuse_call(k, i % 2)) k++;
        if (k == 0) skip();           /* built as shared libraries they cannot be reached */
        assert_in_range(k, 20, 1000); /* three files are at least opened, synced, renamed */
    }
}

/* A folder that has taken a name since the directory was opened: nothing is replaced. */
static void name_is_taken(void **state) {
    (void)state;
    CpsError err = {0};
    CpsiDirectory *directory = NULL;
    FILE *out = NULL;
    assert_int_equal(put("ab", false, &err), CPS_OK);
    assert_int_equal(cpsi_directory_open(OUT, &directory, &err), CPS_OK);
    assert_int_equal(cpsi_directory_create(directory, "loop-a.svg", &out, &err), CPS_OK);
    assert_int_equal(cpsi_directory_close_file(directory, out, &err), CPS_OK);
    assert_int_equal(unlink("directory-parts/loop-a.svg"), 0);
    assert_int_equal(mkdir("directory-parts/loop-a.svg", 0777), 0);
    assert_int_equal(cpsi_directory_commit(directory, is_loop, &err), CPS_ERR_IO);
    assert_non_null(strstr(err.message, strerror(EISDIR)));
    cpsi_directory_destroy(directory);
    assert_true(is_there("loop-b.svg") && is_there("summary.json"));
    assert_int_equal(rmdir("directory-parts/loop-a.svg"), 0);
}

/* A file that somebody has removed is no longer in the list. */
static void files_are_gone(void **state) {
    (void)state;
    CpsError err = {0};
    assert_int_equal(put("abc", false, &err), CPS_OK);
    assert_int_equal(unlink("directory-parts/loop-a.svg"), 0);
    assert_int_equal(put("b", false, &err), CPS_OK);
    FILE *own = fopen("directory-parts/loop-a.svg", "w"); /* now somebody else's */
    assert_true(own && fclose(own) == 0);
    assert_int_equal(put("c", false, &err), CPS_OK);
    assert_true(is_there("loop-a.svg") && !is_there("loop-b.svg"));
}

static void put_text(const void *text, FILE *out) { fputs(text, out); }

static void sets_of_files(void **state) {
    (void)state;
    const CpsiFile file[] = {{"study.csv", put_text, "1\n"}, {"study.svg", put_text, "2\n"}},
                   summary = {"study.json", cpsi_file_set_title, "a set"};
    CpsError err = {0};
    bool reached = true;
    why = EIO;
    for (long k = 0; reached; k++) {
        assert_int_equal(start(NULL), 0);
        calls = 0;
        fails_at = k;
        const CpsStatus status = cpsi_file_set_write(OUT, file, 2, &summary, NULL, &err);
        reached = calls > k;
        fails_at = -1;
        if (status && status != CPS_ERR_IO && status != CPS_ERR_MEMORY)
            fail_msg("call %ld: %s", k, cps_status_name(status));
        if (!status && !is_there("study.json")) fail_msg("call %ld: nothing is there", k);
        if (cpsi_file_set_write(OUT, file, 2, &summary, NULL, &err) != CPS_OK)
            fail_msg("call %ld: the next: %s", k, err.message);
    }
}

static void what_is_refused(void **state) {
    (void)state;
    CpsError err = {0};
    CpsiDirectory *directory = NULL;
    FILE *out = NULL;
    char missing[CPS_RESULT_NAME];
    assert_int_equal(cpsi_directory_open(OUT, &directory, &err), CPS_OK);
    assert_int_equal(cpsi_directory_create(directory, "notes.txt", &out, &err), CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "no name of a file of results"));
    /* an unfinished file that somebody else has put there since: it stays */
    char *path = NULL;
    static const char *const MINE[] = {"directory-parts/.loop-a.svg.part",
                                       "directory-parts/.result.nc.part"};
    for (size_t i = 0; i < 2; i++) {
        FILE *mine = fopen(MINE[i], "w");
        assert_true(mine && fclose(mine) == 0);
        assert_int_equal(i == 0 ? cpsi_directory_create(directory, "loop-a.svg", &out, &err)
                                : cpsi_directory_reserve(directory, "result.nc", &path, &err),
                         CPS_ERR_IO);
        assert_non_null(strstr(err.message, MINE[i]));
        assert_null(i == 0 ? (void *)out : (void *)path);
    }
    assert_int_equal(cpsi_directory_commit(directory, is_loop, &err), CPS_OK); /* of nothing */
    cpsi_directory_destroy(directory);
    for (size_t i = 0; i < 2; i++) assert_int_equal(unlink(MINE[i]), 0);
    /* an unfinished file that somebody has removed meanwhile */
    CpsiNames parts = {0};
    assert_int_equal(cpsi_names_add(&parts, ".loop-z.svg.part", &err), CPS_OK);
    const int folder = open(OUT, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    assert_true(folder >= 0);
    assert_int_equal(cpsi_marker_remove_parts(folder, OUT, &parts, &err), CPS_OK);
    close(folder);
    cpsi_names_free(&parts);
    /* a list that waits for a file, which is there: the disk had not confirmed its name */
    assert_int_equal(put("a", false, &err), CPS_OK);
    FILE *list = fopen("directory-parts/.capstan", "a");
    assert_true(list && fputs("x summary.json\n", list) >= 0 && fclose(list) == 0);
    assert_int_equal(cps_results_missing(OUT, missing, &err), CPS_OK);
    assert_string_equal(missing, "");
    assert_int_equal(unlink("directory-parts/summary.json"), 0);
    /* no directory at all has nothing missing, nor has what is none */
    assert_int_equal(cps_results_missing("directory-parts/none", missing, &err), CPS_OK);
    assert_int_equal(cps_results_missing("directory-parts/loop-a.svg", missing, &err), CPS_OK);
    /* what cannot be opened for another reason is an error */
    char endless[6000];
    memset(endless, 'x', sizeof endless - 1);
    endless[sizeof endless - 1] = 0;
    assert_int_equal(cps_results_missing(endless, missing, &err), CPS_ERR_IO);
    assert_int_equal(cps_results_missing(OUT, missing, &err), CPS_OK);
    assert_string_equal(missing, "summary.json");
    /* a list far longer than any */
    assert_int_equal(truncate("directory-parts/.capstan", ((off_t)256 << 20) + 1), 0);
    assert_int_equal(put("a", false, &err), CPS_ERR_IO);
    assert_non_null(strstr(err.message, "no list of capstan's"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_in_order),
        cmocka_unit_test_setup_teardown(files_are_displaced, start, start),
        cmocka_unit_test_setup_teardown(name_is_taken, start, start),
        cmocka_unit_test_setup_teardown(files_are_gone, start, start),
        cmocka_unit_test_setup_teardown(sets_of_files, start, start),
        cmocka_unit_test_setup_teardown(what_is_refused, start, start)};
    return cmocka_run_group_tests_name("parts of a directory of results", tests, NULL, NULL);
}
