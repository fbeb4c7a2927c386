/* SPDX-License-Identifier: BSD-3-Clause */
/* A journal whose system calls fail, one after the other: the result is an error with a message or
 * the same steps, and no earlier step is lost. The calls are replaced (linked with --wrap). */
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

#include "io/results/writers.h"
#include "small_run.h"

ssize_t __real_pread(int file, void *to, size_t size, off_t at);
ssize_t __real_pwrite(int file, const void *from, size_t size, off_t at);
int __real_fstat(int file, struct stat *about);
int __real_fsync(int file);
int __real_fdatasync(int file);
int __real_ftruncate(int file, off_t size);
ssize_t __wrap_pread(int file, void *to, size_t size, off_t at);
ssize_t __wrap_pwrite(int file, const void *from, size_t size, off_t at);
int __wrap_fstat(int file, struct stat *about);
int __wrap_fsync(int file);
int __wrap_fdatasync(int file);
int __wrap_ftruncate(int file, off_t size);
int __real_unlinkat(int at, const char *path, int how);
int __wrap_unlinkat(int at, const char *path, int how);
int __real_openat(int at, const char *path, int how, ...);
int __wrap_openat(int at, const char *path, int how, ...);

/* The call that fails, counted from 0, and how; `most`: bytes that are read or written at once. */
static int calls, fails_at = -1, why;
static size_t most = SIZE_MAX;

static bool fails(void) {
    if (calls++ != fails_at) return false;
    errno = why;
    return true;
}

ssize_t __wrap_pread(int file, void *to, size_t size, off_t at) {
    return fails() ? -1 : __real_pread(file, to, size < most ? size : most, at);
}
ssize_t __wrap_pwrite(int file, const void *from, size_t size, off_t at) {
    return fails() ? -1 : __real_pwrite(file, from, size < most ? size : most, at);
}
static bool elsewhere; /* open files are said to be on another device than they are */
int __wrap_fstat(int file, struct stat *about) {
    const int status = fails() ? -1 : __real_fstat(file, about);
    if (status == 0 && elsewhere) about->st_dev++;
    return status;
}
int __wrap_fsync(int file) { return fails() ? -1 : __real_fsync(file); }
int __wrap_fdatasync(int file) { return fails() ? -1 : __real_fdatasync(file); }
int __wrap_ftruncate(int file, off_t size) { return fails() ? -1 : __real_ftruncate(file, size); }

int __wrap_unlinkat(int at, const char *path, int how) {
    return fails() ? -1 : __real_unlinkat(at, path, how);
}

int __wrap_openat(int at, const char *path, int how, ...) {
    return fails() ? -1 : __real_openat(at, path, how, 0666);
}

enum { STEPS = 4, FIRST = 2, ELEMENTS = 4, NUMBERS = 3 * (ELEMENTS + 1) };

static char folder[] = "journal-calls-XXXXXX";

static CpsEvolution *make_evolution(void) {
    const double point[6] = {0, 0, 0, 6, 0, 0};
    const CpsChange change = {.line = 0,
                              .end = CPS_END_B,
                              .to = {CPS_END_KIND_HELD, {5.9, 0.2, 0}}};
    const CpsStage stage = {.cookie = cps_stage_default().cookie,
                            .name = "there",
                            .step_count = STEPS,
                            .change_count = 1,
                            .change = &change};
    CpsLine line = small_rope(ELEMENTS, point);
    line.end[CPS_END_B] = (CpsEnd){CPS_END_KIND_HELD, {6, 0, 0}};
    CpsScene scene = cps_scene_default();
    scene.line_count = scene.stage_count = 1;
    scene.line = &line;
    scene.stage = &stage;
    CpsEvolution *evolution = NULL;
    assert_int_equal(cps_evolution_create(&scene, &evolution, NULL), CPS_OK);
    return evolution;
}

/* Places after each step, undisturbed. */
static double place[STEPS][NUMBERS];

static void expect_place(const CpsEvolution *evolution) {
    const int index = cps_evolution_report(evolution).step_count - 1;
    const CpsLineView view = cps_evolution_line_view(evolution, 0);
    assert_in_range(index, 0, STEPS - 1);
    assert_memory_equal(view.position, place[index], sizeof place[index]);
}

/* Go on to step `to`, from what the journal has; *had: so many steps it had. */
static CpsStatus go_on(CpsJournalMode mode, int to, int *had, bool late, CpsError *err) {
    CpsEvolution *evolution = make_evolution();
    CpsJournal *journal = NULL;
    CpsStatus status = cps_journal_open(folder, evolution, mode, &journal, err);
    assert_int_equal(status == CPS_OK, journal != NULL);
    if (!status && late) cps_journal_sync_late(journal);
    *had = 0;
    for (bool found = mode == CPS_JOURNAL_RESUME; !status && found;) {
        status = cps_journal_next(journal, evolution, &found, err);
        if (status || !found) break;
        expect_place(evolution);
        ++*had;
    }
    for (int k = *had; !status && k < to; k++) {
        assert_int_equal(cps_evolution_step(evolution, NULL), CPS_OK);
        expect_place(evolution);
        status = cps_journal_append(journal, evolution, err);
    }
    if (!status && late) status = cps_journal_sync(journal, err);
    if (!status && to == STEPS) status = cps_journal_remove(journal, err);
    cps_journal_destroy(journal);
    cps_evolution_destroy(evolution);
    return status;
}

/* The k-th call of a first part, or of one that goes on, fails; false: there are not so many. */
static bool refuse_call(int k, bool second, bool late) {
    CpsError err = {0};
    int had, before;
    assert_int_equal(go_on(CPS_JOURNAL_REPLACE, second ? FIRST : 0, &had, false, &err), CPS_OK);
    calls = 0;
    fails_at = k;
    const CpsStatus status = second ? go_on(CPS_JOURNAL_RESUME, STEPS, &before, late, &err)
                                    : go_on(CPS_JOURNAL_REPLACE, FIRST, &before, late, &err);
    const bool reached = calls > k;
    fails_at = -1;
    if (status) assert_true(status == CPS_ERR_IO && strstr(err.message, ".journal") != NULL);
    if (!reached) assert_int_equal(status, CPS_OK);
    assert_int_equal(go_on(CPS_JOURNAL_RESUME, STEPS, &had, false, &err), CPS_OK);
    if (second && status) assert_true(had >= FIRST); /* nothing that was there is lost */
    return reached;
}

static void refuse_each(int error, size_t at_once) {
    why = error;
    most = at_once;
    for (int part = 0; part < 2; part++)
        for (int late = 0; late < 2; late++) {
            int k = 0;
            while (refuse_call(k, part == 1, late == 1)) k++;
            assert_true(k >= 5); /* head, its two syncs, and each step at least one */
        }
    most = SIZE_MAX;
}

static void broken_disk(void **state) {
    (void)state;
    refuse_each(EIO, SIZE_MAX);
}

static void full_disk(void **state) {
    (void)state;
    refuse_each(ENOSPC, 64);
}

/* What a signal interrupts is done again. */
static void interrupted(void **state) {
    (void)state;
    refuse_each(EINTR, SIZE_MAX);
}

/* A file system that cannot sync a directory. */
static void no_sync(void **state) {
    (void)state;
    refuse_each(EINVAL, SIZE_MAX);
}

/* What is not there, and arguments that are none. */
static void nothing(void **state) {
    (void)state;
    CpsError err;
    CpsEvolution *evolution = make_evolution();
    CpsJournal *journal = NULL;
    bool found;
    assert_int_equal(cps_journal_open("no-such-folder", evolution, CPS_JOURNAL_NEW, &journal, &err),
                     CPS_ERR_IO);
    assert_null(journal);
    assert_int_equal(cps_journal_open(folder, evolution, CPS_JOURNAL_NEW, &journal, &err), CPS_OK);
    assert_int_equal(cps_journal_next(NULL, evolution, &found, &err), CPS_ERR_ARGUMENT);
    assert_int_equal(cps_journal_next(journal, NULL, &found, &err), CPS_ERR_ARGUMENT);
    assert_int_equal(cps_journal_next(journal, evolution, NULL, &err), CPS_ERR_ARGUMENT);
    assert_int_equal(cps_journal_sync(NULL, &err), CPS_ERR_ARGUMENT);
    assert_int_equal(cps_journal_remove(NULL, &err), CPS_ERR_ARGUMENT);
    cps_journal_destroy(NULL);
    cps_journal_destroy(journal);
    cps_evolution_destroy(evolution);
}

/* A file that took the journal's name meanwhile is another's, and stays. */
static void replaced(void **state) {
    (void)state;
    CpsEvolution *evolution = make_evolution();
    CpsJournal *journal = NULL;
    char path[64];
    snprintf(path, sizeof path, "%s/.journal", folder);
    assert_int_equal(cps_journal_open(folder, evolution, CPS_JOURNAL_NEW, &journal, NULL), CPS_OK);
    assert_int_equal(unlink(path), 0);
    /* nothing has its name */
    assert_int_equal(cps_journal_remove(journal, NULL), CPS_OK);
    const int file = open(path, O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    assert_true(file >= 0);
    close(file);
    cps_journal_remove(journal, NULL);
    assert_int_equal(access(path, F_OK), 0);
    cps_journal_destroy(journal);
    assert_int_equal(unlink(path), 0);
    /* as is one of the same number on another device */
    assert_int_equal(cps_journal_open(folder, evolution, CPS_JOURNAL_NEW, &journal, NULL), CPS_OK);
    elsewhere = true;
    cps_journal_remove(journal, NULL);
    elsewhere = false;
    assert_int_equal(access(path, F_OK), 0);
    cps_journal_destroy(journal);
    assert_int_not_equal(access(path, F_OK), 0);
    cps_evolution_destroy(evolution);
}

/* FNV-1a over 64-bit words, the last one filled with zeros. */
static uint64_t sum_of(uint64_t step, const unsigned char *state, size_t size) {
    uint64_t sum = (14695981039346656037u ^ step) * 1099511628211u;
    for (size_t at = 0; at < size; at += sizeof sum) {
        uint64_t word = 0;
        memcpy(&word, state + at, size - at < sizeof word ? size - at : sizeof word);
        sum = (sum ^ word) * 1099511628211u;
    }
    return sum;
}

/* A journal whose first record has the state of the second one, with the right checksum. */
static void another_order(void **state) {
    (void)state;
    CpsError err;
    int had;
    char path[64];
    CpsEvolution *evolution = make_evolution();
    const size_t size = cps_evolution_state_size(evolution);
    cps_evolution_destroy(evolution);
    unsigned char *bytes = malloc(size);
    assert_non_null(bytes);
    assert_int_equal(go_on(CPS_JOURNAL_REPLACE, FIRST, &had, false, &err), CPS_OK);
    snprintf(path, sizeof path, "%s/.journal", folder);
    const int file = open(path, O_RDWR | O_CLOEXEC);
    struct stat about;
    assert_true(file >= 0 && __real_fstat(file, &about) == 0);
    const off_t record = (off_t)(2 * sizeof(uint64_t) + size), first = about.st_size - 2 * record;
    const off_t state_at = first + (off_t)(2 * sizeof(uint64_t));
    assert_int_equal(__real_pread(file, bytes, size, state_at + record), size);
    const uint64_t sum = sum_of(0, bytes, size);
    assert_int_equal(__real_pwrite(file, &sum, sizeof sum, first + 8), sizeof sum);
    assert_int_equal(__real_pwrite(file, bytes, size, state_at), size);
    close(file);
    free(bytes);
    assert_int_equal(go_on(CPS_JOURNAL_RESUME, STEPS, &had, false, &err), CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "in another order"));
    assert_int_equal(unlink(path), 0);
}

/* What a run finds under the journal's name before it computes, when each call fails; and a run of
 * another kind, whose results the journal is not of, with and without the order to give it up. */
static void looked_at(void **state) {
    (void)state;
    CpsError err = {0};
    char path[64];
    int had;
    why = EIO;
    snprintf(path, sizeof path, "%s/.journal", folder);
    for (int order = 0; order < 4; order++) {
        const bool other = order & 1, force = order & 2;
        for (int k = 0; k < 5; k++) {
            assert_int_equal(go_on(CPS_JOURNAL_REPLACE, FIRST, &had, false, &err), CPS_OK);
            calls = 0;
            fails_at = k;
            const CpsStatus status = cpsi_journal_check(folder, other, force, &err);
            const bool reached = calls > k;
            fails_at = -1;
            if (status) assert_non_null(strstr(err.message, ".journal"));
            if (!reached && !other) assert_int_equal(status, CPS_OK);
            /* no steps are given up but by that order, and not by a run of the same kind */
            if (!other || !force || status) assert_int_equal(access(path, F_OK), 0);
            if (!reached && other && force) assert_int_not_equal(access(path, F_OK), 0);
        }
    }
    unlink(path);
    /* no journal, and a head without steps */
    assert_int_equal(cpsi_journal_check(folder, true, true, &err), CPS_OK);
    CpsEvolution *evolution = make_evolution();
    CpsJournal *journal = NULL;
    assert_int_equal(cps_journal_open(folder, evolution, CPS_JOURNAL_NEW, &journal, NULL), CPS_OK);
    assert_int_equal(cpsi_journal_check(folder, true, false, &err), CPS_OK);
    assert_int_equal(access(path, F_OK), 0);
    /* a journal that cannot be removed says so */
    for (int k = 0; k < 2; k++) {
        calls = 0;
        fails_at = k; /* fstat, unlinkat */
        assert_int_equal(cps_journal_remove(journal, &err), CPS_ERR_IO);
        assert_non_null(strstr(err.message, "remove"));
    }
    fails_at = -1;
    cps_journal_destroy(journal);
    cps_evolution_destroy(evolution);
}

static int begin(void **state) {
    (void)state;
    CpsEvolution *evolution = make_evolution();
    for (int k = 0; k < STEPS; k++) {
        if (cps_evolution_step(evolution, NULL) != CPS_OK) return -1;
        memcpy(place[k], cps_evolution_line_view(evolution, 0).position, sizeof place[k]);
    }
    cps_evolution_destroy(evolution);
    return mkdtemp(folder) ? 0 : -1;
}

static int end(void **state) {
    (void)state;
    return rmdir(folder);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(broken_disk),   cmocka_unit_test(full_disk), cmocka_unit_test(interrupted),
        cmocka_unit_test(no_sync),       cmocka_unit_test(nothing),   cmocka_unit_test(replaced),
        cmocka_unit_test(another_order), cmocka_unit_test(looked_at)};
    return cmocka_run_group_tests(tests, begin, end);
}
