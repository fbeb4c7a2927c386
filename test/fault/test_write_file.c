/* SPDX-License-Identifier: BSD-3-Clause */
/* One file that is written completely or not at all: each call that it takes fails, alone and with
 * all behind it, with a reason and without one. The earlier file stays as it is, nothing is left
 * under a temporary name, and the message says why. The calls are replaced (linked with --wrap). */
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "capstan/io.h"

/* The call that fails, counted from 0, whether all behind it do, and how; 0: streams give no
 * reason, calls of the system say EIO. */
static long calls, fails_at = -1;
static bool on;
static int why;

static bool fails(bool stream) {
    const long k = calls++;
    if (fails_at < 0 || k < fails_at || (k > fails_at && !on)) return false;
    errno = why || stream ? why : EIO;
    return true;
}

#define CALL(type, name, failure, parameters, arguments) \
    type __real_##name parameters;                       \
    type __wrap_##name parameters;                       \
    type __wrap_##name parameters { return fails(false) ? (failure) : __real_##name arguments; }
CALL(void *, malloc, NULL, (size_t size), (size))
CALL(FILE *, fdopen, NULL, (int file, const char *how), (file, how))
CALL(int, fsync, -1, (int file), (file))
CALL(int, rename, -1, (const char *from, const char *to), (from, to))

int __real_open(const char *path, int how, ...);
int __wrap_open(const char *path, int how, ...);
int __wrap_open(const char *path, int how, ...) {
    return fails(false) ? -1 : __real_open(path, how, 0666);
}

int __real_fflush(FILE *file);
int __wrap_fflush(FILE *file);
int __wrap_fflush(FILE *file) { return fails(true) ? EOF : __real_fflush(file); }

/* The stream is closed even so. */
int __real_fclose(FILE *file);
int __wrap_fclose(FILE *file);
int __wrap_fclose(FILE *file) {
    const int code = __real_fclose(file);
    return fails(true) ? EOF : code;
}

static const char FOLDER[] = "write-file", FILE_NAME[] = "write-file/one";

/* What is written: a text; a long one, whose first failure is forgotten; a text that its writer
 * gives up. */
static CpsStatus write_text(void *user, FILE *out, CpsError *err) {
    (void)err;
    fputs(user, out);
    return CPS_OK;
}
static CpsStatus write_much(void *user, FILE *out, CpsError *err) {
    (void)err;
    for (int i = 0; i < 100000; i++) fputs("a line of this file\n", out);
    if (user) errno = *(const int *)user;
    return CPS_OK;
}
static CpsStatus give_up(void *user, FILE *out, CpsError *err) {
    (void)user;
    fputs("half", out);
    *err = (CpsError){.status = CPS_ERR_LIMIT, .message = "given up"};
    return CPS_ERR_LIMIT;
}

static int files_there(void) {
    DIR *listing = opendir(FOLDER);
    assert_non_null(listing);
    int count = 0;
    while (readdir(listing)) count++;
    closedir(listing);
    return count - 2; /* . and .. */
}

static void assert_text(const char *text) {
    char found[64] = {0};
    FILE *file = fopen(FILE_NAME, "r");
    assert_non_null(file);
    assert_true(fread(found, 1, sizeof found - 1, file) > 0);
    fclose(file);
    assert_string_equal(found, text);
}

static int start(void **state) {
    (void)state;
    fails_at = -1;
    if (system("rm -rf write-file") != 0 || mkdir(FOLDER, 0777) != 0) return 1;
    CpsError err;
    return cps_write_file(FILE_NAME, write_text, (void *)(uintptr_t) "old", &err) != CPS_OK;
}

/* true: there are so many calls */
static bool refuse_call(const char *path, long k, bool all_behind, int reason) {
    CpsError err = {0};
    assert_int_equal(start(NULL), 0);
    calls = 0;
    on = all_behind;
    why = reason;
    fails_at = k;
    const CpsStatus status = cps_write_file(path, write_text, (void *)(uintptr_t) "new", &err);
    const bool reached = calls > k;
    fails_at = -1;
    if (!reached) {
        assert_int_equal(status, CPS_OK);
        return false;
    }
    if (status != CPS_ERR_IO && status != CPS_ERR_MEMORY)
        fail_msg("call %ld: %s", k, cps_status_name(status));
    if (status == CPS_ERR_IO && !strstr(err.message, strerror(reason ? reason : EIO)))
        fail_msg("call %ld: '%s' gives no reason", k, err.message);
    assert_text("old");
    assert_int_equal(files_there(), 1);
    return true;
}

static void each_call_fails(void **state) {
    (void)state;
    static const int REASON[] = {EIO, ENOSPC, 0};
    for (int i = 0; i < 6; i++) {
        long k = 0;
        while (refuse_call(FILE_NAME, k, i % 2, REASON[i / 2])) k++;
        if (k == 0) skip();          /* built as shared libraries they cannot be reached */
        assert_in_range(k, 7, 1000); /* memory, open, stream, flush, sync, close, rename */
    }
    for (long k = 0; refuse_call("/dev/null", k, false, EIO);) k++;
}

static void writers_that_fail(void **state) {
    (void)state;
    CpsError err;
    assert_int_equal(cps_write_file(FILE_NAME, give_up, NULL, &err), CPS_ERR_LIMIT);
    assert_string_equal(err.message, "given up");
    assert_text("old");
    assert_int_equal(files_there(), 1);
    assert_int_equal(cps_write_file("/dev/null", give_up, NULL, &err), CPS_ERR_LIMIT);
    /* a device that is full, with the reason of the write that failed, and with none */
    const int none = 0;
    assert_int_equal(cps_write_file("/dev/full", write_much, NULL, &err), CPS_ERR_IO);
    assert_non_null(strstr(err.message, strerror(ENOSPC)));
    assert_int_equal(cps_write_file("/dev/full", write_much, (void *)(uintptr_t)&none, &err),
                     CPS_ERR_IO);
    assert_non_null(strstr(err.message, strerror(EIO)));
}

static void impossible_places(void **state) {
    (void)state;
    CpsError err;
    assert_int_equal(cps_write_file(NULL, write_text, NULL, &err), CPS_ERR_ARGUMENT);
    assert_int_equal(cps_write_file(FILE_NAME, NULL, NULL, &err), CPS_ERR_ARGUMENT);
    assert_int_equal(cps_write_file(FOLDER, write_text, NULL, &err), CPS_ERR_IO);
    assert_non_null(strstr(err.message, strerror(EISDIR)));
    /* beside the running program, by a name without a folder */
    assert_int_equal(cps_write_file("write-file-here", write_text, (void *)(uintptr_t) "x", &err),
                     CPS_OK);
    assert_int_equal(remove("write-file-here"), 0);
}

/* What is open as standard output is written to and goes on behind what has been printed; a link to
 * any other file is replaced, on whatever device the file is, and with standard output closed. */
static void links(void **state) {
    (void)state;
    static const char LINK[] = "write-file/link", OUTPUT[] = "write-file/output";
    void *text = (void *)(uintptr_t) "new";
    CpsError err;
    struct stat about;
    char far[] = "/dev/shm/write-file-XXXXXX";
    const int file = mkstemp(far), before = dup(STDOUT_FILENO);
    assert_true(file >= 0 && before >= 0);
    fflush(stdout);
    const int output = __real_open(OUTPUT, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    assert_true(output >= 0);
    for (int k = 0; k < 4; k++) {
        const char *to[] = {"output", "one", far, "one"};
        assert_int_equal(symlink(to[k], LINK), 0);
        if (k < 3) assert_true(dup2(output, STDOUT_FILENO) >= 0);
        if (k == 3) close(STDOUT_FILENO);
        const CpsStatus status = cps_write_file(LINK, write_text, text, &err);
        const bool linked = lstat(LINK, &about) == 0 && S_ISLNK(about.st_mode);
        dup2(before, STDOUT_FILENO);
        assert_int_equal(status, CPS_OK);
        assert_int_equal(linked, k == 0);
        assert_int_equal(remove(LINK), 0);
    }
    assert_int_equal(fstat(output, &about), 0);
    assert_int_equal(about.st_size, strlen(text));
    assert_text("old");
    close(output);
    close(before);
    close(file);
    assert_int_equal(remove(far), 0);
}

static int clear(void **state) {
    (void)state;
    return system("rm -rf write-file");
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test_setup(each_call_fails, start),
                                       cmocka_unit_test_setup(writers_that_fail, start),
                                       cmocka_unit_test_setup(impossible_places, start),
                                       cmocka_unit_test_setup(links, start)};
    return cmocka_run_group_tests_name("one file that cannot be written", tests, NULL, clear);
}
