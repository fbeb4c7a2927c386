/* SPDX-License-Identifier: BSD-3-Clause */
/* The calls that a directory of results is made of fail, one after the other: an error with a
 * message or whole results, and the next run ends well there. The calls are replaced (linked with
 * --wrap); test/fault/calls.py refuses the same to the whole program and looks at what is left. */
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cmocka.h>

#include "refuse_files.h"
#include "small_run.h"

static const char OUT[] = "directory-calls";

static void write_text(const char *path, const char *text) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0 && fclose(file) == 0);
}

static bool is_there(const char *path) {
    struct stat about;
    return lstat(path, &about) == 0;
}

/* A run in which the k-th call fails, and one in which none does; false: there are not so many. */
static bool refuse_call(long k, bool earlier, bool forced) {
    CpsError err = {0};
    assert_int_equal(system("rm -rf directory-calls"), 0);
    if (earlier) assert_int_equal(small_run(OUT, 3, &err), CPS_OK);
    calls = 0;
    fails_at = k;
    CpsStatus status =
        forced ? cps_results_prepare(OUT, CPS_RESULTS_KIND_RUN, 0, true, &err) : CPS_OK;
    if (!status) status = small_run(OUT, 3, &err);
    const bool reached = calls > k;
    fails_at = -1;
    if (status && status != CPS_ERR_IO && status != CPS_ERR_MEMORY)
        fail_msg("call %ld: %s: %s", k, cps_status_name(status), err.message);
    if (status && !err.message[0]) fail_msg("call %ld: no message", k);
    if (!status && !is_there("directory-calls/summary.json"))
        fail_msg("call %ld: nothing is there, and nothing was said", k);
    if (small_run(OUT, 3, &err) != CPS_OK) fail_msg("call %ld: the next run: %s", k, err.message);
    assert_false(is_there("directory-calls/.capstan.run"));
    assert_false(is_there("directory-calls/.result.nc.part"));
    return reached;
}

/* Into a new directory, over an earlier run, and over one with --force. */
typedef enum Part { FRESH, OVER, FORCED } Part;

static void refuse_each(int error, Part part) {
    why = error;
    long k = 0;
    while (refuse_call(k, part != FRESH, part == FORCED)) k++;
    print_message("%ld calls, each refused\n", k);
    if (k == 0) skip();             /* built as shared libraries they cannot be reached */
    assert_in_range(k, 30, 100000); /* each of ten files is at least opened, synced, renamed */
}

static void broken_disk(void **state) {
    (void)state;
    refuse_each(EIO, FRESH);
    refuse_each(EIO, FORCED);
}
static void full_disk(void **state) {
    (void)state;
    refuse_each(ENOSPC, OVER);
}
/* What a signal interrupts, and a file system without locks, or that cannot sync a directory. */
static void interrupted(void **state) {
    (void)state;
    refuse_each(EINTR, FRESH);
}
static void not_supported(void **state) {
    (void)state;
    refuse_each(EINVAL, OVER);
}

/* A listing that fails is not an empty one: the directory is not taken for capstan's. */
static void listing_fails(void **state) {
    (void)state;
    CpsError err = {0};
    assert_int_equal(system("rm -rf directory-calls"), 0);
    assert_int_equal(mkdir(OUT, 0777), 0);
    write_text("directory-calls/notes.txt", "mine");
    assert_int_equal(small_run(OUT, 3, &err), CPS_ERR_IO);
    why = EIO;
    bool reached = true;
    for (long k = 0; reached; k++) {
        calls = 0;
        fails_at = k;
        const CpsStatus status = small_run(OUT, 3, &err);
        reached = calls > k;
        fails_at = -1;
        if (status == CPS_OK) fail_msg("call %ld: somebody else's directory is taken", k);
        assert_false(is_there("directory-calls/.capstan"));
        assert_true(is_there("directory-calls/notes.txt"));
    }
}

/* A list that capstan has not written so: it is believed about no other names than those of
 * results, and about no file elsewhere. */
static void strange_list(void **state) {
    (void)state;
    CpsError err = {0};
    static const char *const KEPT[] = {"notes.txt",      "line-x.svg", "line-1.txt",  "step-12.svg",
                                       "step-00001.txt", "loop-",      "stepping.svg"};
    char text[4000] = "capstan directory 1\n\nw\nw \nwx.svg\nx  \nw ../directory-calls-mine\nw "
                      "line-1.svg\nw line-1.svg\nq loop-a.svg\np step-00001.vtp\nx history.csv\n",
         path[300];
    assert_int_equal(system("rm -rf directory-calls directory-calls-mine"), 0);
    assert_int_equal(mkdir(OUT, 0777), 0);
    write_text("directory-calls-mine", "mine");
    for (size_t i = 0; i < sizeof KEPT / sizeof *KEPT; i++) {
        snprintf(path, sizeof path, "w %s\n", KEPT[i]);
        strcat(text, path);
        snprintf(path, sizeof path, "%s/%s", OUT, KEPT[i]);
        write_text(path, "mine");
    }
    strcat(text, "w loop-");
    memset(text + strlen(text), 'l', 600); /* far beyond any name */
    strcat(text, ".svg\nw loop-");
    memset(text + strlen(text), 'l', 245);  /* just beyond, with what makes it temporary */
    strcat(text, ".svg\nw step-00002.svg"); /* cut off */
    write_text("directory-calls/.capstan", text);
    write_text("directory-calls/.capstan.run", text);
    assert_int_equal(small_run(OUT, 3, &err), CPS_OK);
    for (size_t i = 0; i < sizeof KEPT / sizeof *KEPT; i++) {
        snprintf(path, sizeof path, "%s/%s", OUT, KEPT[i]);
        if (!is_there(path)) fail_msg("%s is gone", KEPT[i]);
    }
    assert_true(is_there("directory-calls-mine"));
    assert_int_equal(remove("directory-calls-mine"), 0);
}

/* Lists that are something else: links, folders, devices, texts of others. */
static void no_list(void **state) {
    (void)state;
    static const char *const MAKE[] = {"ln -s nowhere directory-calls/.capstan",
                                       "mkdir directory-calls/.capstan",
                                       "mkfifo directory-calls/.capstan",
                                       "echo mine > directory-calls/.capstan",
                                       ": > directory-calls/.capstan",
                                       "ln -s nowhere directory-calls/.capstan.run",
                                       "mkdir directory-calls/.capstan.run",
                                       "mkfifo directory-calls/.capstan.run",
                                       "echo mine > directory-calls/.capstan.run"};
    CpsError err = {0};
    for (size_t i = 0; i < sizeof MAKE / sizeof *MAKE; i++) {
        assert_int_equal(system("rm -rf directory-calls"), 0);
        assert_int_equal(mkdir(OUT, 0777), 0);
        assert_int_equal(system(MAKE[i]), 0);
        if (small_run(OUT, 3, &err) != CPS_ERR_IO) fail_msg("%s: is accepted", MAKE[i]);
        assert_non_null(strstr(err.message, "no list of capstan's"));
    }
    /* a socket */
    assert_int_equal(system("rm -rf directory-calls"), 0);
    assert_int_equal(mkdir(OUT, 0777), 0);
    const struct sockaddr_un at = {.sun_family = AF_UNIX, .sun_path = "directory-calls/.capstan"};
    const int plug = socket(AF_UNIX, SOCK_STREAM, 0);
    assert_true(plug >= 0 && bind(plug, (const struct sockaddr *)&at, sizeof at) == 0);
    assert_int_equal(small_run(OUT, 3, &err), CPS_ERR_IO);
    assert_non_null(strstr(err.message, "no list of capstan's"));
    close(plug);
    /* of a run that was killed in its first moment */
    assert_int_equal(system("rm -rf directory-calls"), 0);
    assert_int_equal(mkdir(OUT, 0777), 0);
    write_text("directory-calls/.capstan.run", "");
    assert_int_equal(small_run(OUT, 3, &err), CPS_OK);
}

static int clear(void **state) {
    (void)state;
    return system("rm -rf directory-calls");
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(broken_disk),
                                       cmocka_unit_test(full_disk),
                                       cmocka_unit_test(interrupted),
                                       cmocka_unit_test(not_supported),
                                       cmocka_unit_test(listing_fails),
                                       cmocka_unit_test(strange_list),
                                       cmocka_unit_test(no_list)};
    return cmocka_run_group_tests_name("directories that fail", tests, NULL, clear);
}
