/* SPDX-License-Identifier: BSD-3-Clause */
/* Results that cannot be written: too little space for any one of the files, a full file system,
 * directories that cannot be made or written, a target that cannot be replaced. Each time the call
 * fails with CPS_ERR_IO and says why, no temporary file stays, and the results of an earlier run
 * are as they were. */
#define _GNU_SOURCE /* unshare, mount flags, seteuid */

#include <dirent.h>
#include <errno.h>
#include <sched.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "small_run.h"

enum { ELEMENTS = 40, MAX_FILES = 64 };

typedef struct Listing {
    int count;
    char name[MAX_FILES][256];
    struct timespec changed[MAX_FILES];
    off_t size[MAX_FILES];
} Listing;

static int by_name(const void *a, const void *b) { return strcmp(a, b); }

/* names in order, with sizes and times of change; a file written anew differs in its time */
static Listing list(const char *directory) {
    Listing found = {0};
    DIR *stream = opendir(directory);
    assert_non_null(stream);
    for (struct dirent *entry; (entry = readdir(stream)) != NULL;) {
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0) continue;
        assert_true(found.count < MAX_FILES);
        snprintf(found.name[found.count++], sizeof found.name[0], "%s", entry->d_name);
    }
    closedir(stream);
    qsort(found.name, (size_t)found.count, sizeof found.name[0], by_name);
    for (int i = 0; i < found.count; i++) {
        char path[512];
        struct stat status;
        snprintf(path, sizeof path, "%s/%s", directory, found.name[i]);
        assert_int_equal(stat(path, &status), 0);
        found.size[i] = status.st_size;
        found.changed[i] = status.st_mtim;
    }
    return found;
}

static void assert_unchanged(const char *directory, const Listing *before) {
    const Listing now = list(directory);
    for (int i = 0; i < now.count && i < before->count; i++)
        if (strcmp(now.name[i], before->name[i]) != 0 || now.size[i] != before->size[i] ||
            memcmp(&now.changed[i], &before->changed[i], sizeof now.changed[i]) != 0)
            fail_msg("%s/%s or %s is new or changed", directory, now.name[i], before->name[i]);
    assert_int_equal(now.count, before->count);
}

static void assert_io_error(const char *directory, const char *reason) {
    CpsError err = {0};
    const CpsStatus status = small_run(directory, ELEMENTS, &err);
    if (status != CPS_ERR_IO)
        fail_msg("%s: %s, expected CPS_ERR_IO: %s", directory, cps_status_name(status),
                 err.message);
    if (!strstr(err.message, reason)) fail_msg("'%s' does not say '%s'", err.message, reason);
}

static void fresh(const char *directory) {
    char command[256];
    snprintf(command, sizeof command, "rm -rf '%s'", directory);
    assert_int_equal(system(command), 0);
}

/* for every file of a good run: space for one byte less than it needs */
static void no_space_for_one_file(void **state) {
    (void)state;
    CpsError err;
    fresh("fault-space");
    assert_int_equal(small_run("fault-space", ELEMENTS, &err), CPS_OK);
    const Listing good = list("fault-space");
    assert_true(good.count > 10);
    off_t largest = 0;
    signal(SIGXFSZ, SIG_IGN);
    struct rlimit whole;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &whole), 0);
    for (int i = 0; i < good.count; i++) {
        const struct rlimit tight = {(rlim_t)good.size[i] - 1, whole.rlim_max};
        if (good.size[i] > largest) largest = good.size[i];
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &tight), 0);
        CpsError reason = {0};
        const CpsStatus over = small_run("fault-space", ELEMENTS, &reason);
        const CpsStatus first = small_run("fault-space-new", ELEMENTS, NULL);
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &whole), 0);
        if (over != CPS_ERR_IO || first != CPS_ERR_IO)
            fail_msg("space for %ld bytes was enough", (long)good.size[i] - 1);
        if (!strstr(reason.message, "File too large"))
            fail_msg("'%s' gives no reason", reason.message);
        assert_unchanged("fault-space", &good);
        assert_int_not_equal(access("fault-space-new", F_OK), 0);
    }
    /* and the limit itself is not what fails */
    const struct rlimit enough = {(rlim_t)largest + 100000, whole.rlim_max};
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &enough), 0);
    assert_int_equal(small_run("fault-space", ELEMENTS, &err), CPS_OK);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &whole), 0);
}

/* runs `elements` elements in a file system of 256 kB of its own; exit codes of the child */
enum {
    CHILD_OK = 0,
    CHILD_CANNOT = 77,
    CHILD_WRONG_STATUS = 1,
    CHILD_WRONG_MESSAGE = 2,
    CHILD_LEFTOVER = 3
};

static int in_small_file_system(void) {
    if (mkdir("fault-disk", 0777) != 0 && errno != EEXIST) return CHILD_CANNOT;
    if (unshare(CLONE_NEWNS) != 0) return CHILD_CANNOT;
    if (mount(NULL, "/", NULL, MS_REC | MS_PRIVATE, NULL) != 0) return CHILD_CANNOT;
    if (mount("tmpfs", "fault-disk", "tmpfs", 0, "size=256k") != 0) return CHILD_CANNOT;
    CpsError err = {0};
    if (small_run("fault-disk/results", 4000, &err) != CPS_ERR_IO) return CHILD_WRONG_STATUS;
    if (!strstr(err.message, "No space left")) return CHILD_WRONG_MESSAGE;
    return access("fault-disk/results", F_OK) == 0 ? CHILD_LEFTOVER : CHILD_OK;
}

static void full_disk(void **state) {
    (void)state;
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) _exit(in_small_file_system());
    int status = 0;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    if (WEXITSTATUS(status) == CHILD_CANNOT) {
        print_message("mounting a small file system is not permitted here: skipped\n");
        skip();
    }
    assert_int_equal(WEXITSTATUS(status), CHILD_OK);
}

static void impossible_directories(void **state) {
    (void)state;
    FILE *file = fopen("fault-file", "w");
    assert_non_null(file);
    fclose(file);
    assert_io_error("fault-file", "Not a directory");
    assert_io_error("fault-file/below", "Not a directory");
    assert_io_error("fault-missing/below", "No such file");
    /* the kernel's own files: no one may make a file there, not even root */
    assert_io_error("/proc/self/fault", "cannot use");
    assert_io_error("/proc/self", "not written by capstan");
    char name[400];
    memset(name, 'n', sizeof name - 1);
    name[sizeof name - 1] = '\0';
    assert_io_error(name, "File name too long");
}

/* root may write everywhere, so it becomes someone else for a while */
static void read_only_directory(void **state) {
    (void)state;
    const uid_t me = geteuid();
    fresh("fault-read-only");
    assert_int_equal(mkdir("fault-read-only", 0555), 0);
    assert_int_equal(seteuid(me == 0 ? 65534 : me), 0);
    CpsError err = {0};
    const CpsStatus inside = small_run("fault-read-only", ELEMENTS, &err);
    const CpsStatus below = small_run("fault-read-only/below", ELEMENTS, NULL);
    assert_int_equal(seteuid(me), 0);
    assert_int_equal(inside, CPS_ERR_IO);
    assert_int_equal(below, CPS_ERR_IO);
    assert_non_null(strstr(err.message, "Permission denied"));
}

/* a directory where a file should go: found before the first earlier file is replaced */
static void target_cannot_be_replaced(void **state) {
    (void)state;
    CpsError err;
    fresh("fault-target");
    assert_int_equal(small_run("fault-target", ELEMENTS, &err), CPS_OK);
    assert_int_equal(unlink("fault-target/history.csv"), 0);
    assert_int_equal(mkdir("fault-target/history.csv", 0777), 0);
    const Listing before = list("fault-target");
    assert_io_error("fault-target", "Is a directory");
    assert_unchanged("fault-target", &before);
}

/* a symbolic link under a temporary name is not followed */
static void planted_link_is_not_followed(void **state) {
    (void)state;
    CpsError err;
    fresh("fault-link");
    fresh("fault-victim");
    assert_int_equal(mkdir("fault-link", 0777), 0);
    FILE *victim = fopen("fault-victim", "w");
    assert_non_null(victim);
    fputs("mine", victim);
    fclose(victim);
    assert_int_equal(symlink("../fault-victim", "fault-link/.result.nc.part"), 0);
    assert_int_equal(symlink("../fault-victim", "fault-link/.history.csv.part"), 0);
    assert_int_equal(symlink("../fault-victim", "fault-link/summary.json"), 0);
    assert_io_error("fault-link", "not written by capstan");
    assert_int_equal(cps_results_prepare("fault-link", CPS_RESULTS_KIND_RUN, 0, true, &err),
                     CPS_OK);
    assert_int_equal(small_run("fault-link", ELEMENTS, &err), CPS_OK);
    struct stat found;
    assert_int_equal(stat("fault-victim", &found), 0);
    assert_int_equal(found.st_size, 4);
    assert_int_equal(lstat("fault-link/summary.json", &found), 0);
    assert_true(S_ISREG(found.st_mode));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_space_for_one_file),     cmocka_unit_test(full_disk),
        cmocka_unit_test(impossible_directories),    cmocka_unit_test(read_only_directory),
        cmocka_unit_test(target_cannot_be_replaced), cmocka_unit_test(planted_link_is_not_followed),
    };
    return cmocka_run_group_tests_name("results that cannot be written", tests, NULL, NULL);
}
