/* SPDX-License-Identifier: BSD-3-Clause */
/* A command is run once; at each allocation that is to be refused the process is copied, and the
 * copy goes on without it to its end. What a copy has to do is little, for a command without memory
 * ends soon. For one file of a test program. */
#ifndef CAPSTAN_TEST_FAULT_REFUSE_IN_COPIES_H
#define CAPSTAN_TEST_FAULT_REFUSE_IN_COPIES_H

#include <sys/stat.h>
#include <sys/wait.h>

#include "refuse_command.h"

static char copies[] = "refuse-in-copies-XXXXXX"; /* the directory in which copies work */
static bool is_copy;
static long tried, wrong_ones;

/* A copy has the descriptors of the other's temporary files; it goes on in files of its own. */
static void own_temporary_files(void) {
    char link[64], path[4096];
    static char text[1 << 20];
    for (int fd = 3; fd < 64; fd++) {
        snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
        const ssize_t length = readlink(link, path, sizeof path - 1);
        if (length < 5 || memcmp(path + length - 5, ".part", 5) != 0) continue;
        path[length] = '\0';
        const int from = open(path, O_RDONLY);
        const int to = open(strrchr(path, '/') + 1, O_WRONLY | O_CREAT | O_TRUNC, 0666);
        const ssize_t size = from >= 0 ? read(from, text, sizeof text) : -1;
        if (size < 0 || size == sizeof text || to < 0 || write(to, text, (size_t)size) != size ||
            dup2(to, fd) != fd)
            abort();
        close(from);
        close(to);
    }
}

static bool refuse_in_copy(void) {
    static long known;
    const bool chosen = !is_copy && is_chosen(asked - 1, places > known);
    known = places;
    if (!chosen) return false;
    const pid_t child = fork();
    if (child < 0) abort();
    if (child == 0) {
        is_copy = true;
        if (chdir(copies) != 0) abort();
        own_temporary_files();
        return true;
    }
    int status;
    if (waitpid(child, &status, 0) != child) abort();
    tried++;
    wrong_ones += status != 0;
    return false;
}

/* The end of a copy. It leaves by exit, so that what a build counts is written. */
static _Noreturn void end_copy(int code, long before, const char *picture, bool draws) {
    const char *wrong = judge(code, before, draws, remove(picture) == 0);
    if (wrong)
        fprintf(stderr, "allocation %ld: %s: exit code %d: %s\n", asked, wrong, code,
                reported.message);
    exit(wrong != NULL);
}

/* `input`: what the command reads; `picture`: what it writes where it ends well, if it draws;
 * `least`: allocations that such a command makes at the very least. */
static void refuse_in_copies(Command *run, const char *input, const char *picture, bool draws,
                             long least, int argc, const char *const *argv) {
    char path[256];
    memset(strrchr(copies, '-') + 1, 'X', 6);
    assert_non_null(mkdtemp(copies));
    snprintf(path, sizeof path, "%s/%s", copies, input);
    remove(picture);
    assert_int_equal(link(input, path), 0);
    const long before = live;
    bool reached;
    asked = tried = wrong_ones = 0;
    recording = true;
    is_refused = refuse_in_copy;
    const int code = command(run, -1, argc, argv, &reached);
    is_refused = NULL;
    recording = false;
    if (is_copy) end_copy(code, before, picture, draws);
    assert_int_equal(code, EXIT_OK);
    assert_null(judge(code, before, draws, remove(picture) == 0));
    print_message("%ld allocations, %ld refused\n", asked, tried);
    assert_int_equal(wrong_ones, 0);
    assert_int_equal(remove(path), 0);
    assert_int_equal(remove(copies), 0); /* no copy has left anything */
    /* built as shared libraries they cannot be reached */
    if (asked == 0) skip();
    assert_in_range(asked, least, 1000000);
}

#endif
