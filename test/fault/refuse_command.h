/* SPDX-License-Identifier: BSD-3-Clause */
/* A whole command of cli/ with each of its allocations refused in turn: it ends in the exit code of
 * memory or makes the failure good, loses no block, and leaves a picture only where it ends well.
 * For one file of a test program that links the command without main.c. */
#ifndef CAPSTAN_TEST_FAULT_REFUSE_COMMAND_H
#define CAPSTAN_TEST_FAULT_REFUSE_COMMAND_H

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
#include "refuse.h"

typedef int Command(int argc, char **argv);

static CpsError reported;

/* as main.c, but the error is kept instead of printed */
int cli_report(const CpsError *err) {
    reported = *err;
    return err->status == CPS_ERR_MEMORY ? EXIT_LIMIT : EXIT_INPUT;
}

static void write_file(const char *path, const char *text) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0 && fclose(file) == 0);
}

/* The command with its k-th allocation refused; what it prints goes nowhere. *reached: there are so
 * many. */
static int command(Command *run, long k, int argc, const char *const *argv, bool *reached) {
    reported = (CpsError){.status = CPS_OK};
    fflush(NULL);
    const int out = dup(STDOUT_FILENO), err = dup(STDERR_FILENO),
              nowhere = open("/dev/null", O_WRONLY);
    assert_true(out >= 0 && err >= 0 && nowhere >= 0);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    allowed = k;
    const int code = run(argc, (char **)(uintptr_t)argv);
    *reached = allowed < 0;
    allowed = -1;
    fflush(NULL);
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    close(nowhere);
    close(out);
    close(err);
    return code;
}

/* Which allocations are refused, by the word after the program's name: `all`; `many`: the first
 * 3000, and one in 100 of those behind; without a word the first from each place in the program
 * that has not had its turn before. */
static const char *which = "";

/* Is the k-th one of them? `fresh`: from a new place. */
static bool is_chosen(long k, bool fresh) {
    if (which[0] == '\0') return fresh;
    return strcmp(which, "all") == 0 || k < 3000 || k % 100 == 0;
}

/* How a command with its k-th allocation refused has ended, which had `before` blocks; `there`: its
 * picture. A closed form without memory for its scratch hands over to the solver, so a failure may
 * be made good. NULL, or what is wrong. */
static const char *judge(int code, long before, bool draws, bool there) {
    if (live != before) return "blocks are lost";
    if (code != EXIT_OK && code != EXIT_LIMIT) return "the exit code is another";
    if (reported.status != CPS_OK && reported.status != CPS_ERR_MEMORY)
        return "the error is another";
    return there == (draws && code == EXIT_OK) ? NULL : "a picture is there or missing";
}

#endif
