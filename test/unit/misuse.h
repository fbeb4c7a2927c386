/* SPDX-License-Identifier: BSD-3-Clause */
/* Calls that must be refused, each separately, so that the crash of one does not hide others. For
 * one file of a test program. */
#ifndef CAPSTAN_TEST_UNIT_MISUSE_H
#define CAPSTAN_TEST_UNIT_MISUSE_H

#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "capstan/base.h"

static sigjmp_buf back;
static volatile int faults;

static void crashed(int number) {
    (void)number;
    siglongjmp(back, 1);
}

static void fault(int line, const char *call, const char *what) {
    print_error("line %d: %s: %s\n", line, what, call);
    ++faults;
}

/* Run the statement; what it does to memory ends here. */
#define GUARDED(text, ...)                    \
    do {                                      \
        signal(SIGSEGV, crashed);             \
        signal(SIGFPE, crashed);              \
        if (sigsetjmp(back, 1) == 0) {        \
            __VA_ARGS__;                      \
        } else {                              \
            fault(__LINE__, text, "crashes"); \
        }                                     \
    } while (0)

/* A call that may do nothing. */
#define RUNS(call) GUARDED(#call, call)
/* Something that holds of what is given for nothing. */
#define GIVES(holds) GUARDED(#holds, if (!(holds)) fault(__LINE__, #holds, "does not hold"))
/* A call that returns a status other than CPS_OK, and says why. `err` is the file's. */
#define REFUSED(call)                                                       \
    GUARDED(#call, err.message[0] = '\0'; const CpsStatus status_ = (call); \
            if (status_ != CPS_ERR_ARGUMENT && status_ != CPS_ERR_LIMIT)    \
                fault(__LINE__, #call, "is not refused");                   \
            else if (!err.message[0] || err.status != status_)              \
                fault(__LINE__, #call, "does not say why"))
/* A call that has to work for the others to mean something. */
#define SOUND(call) assert_int_equal(call, CPS_OK)

static void all_were_refused(void) { assert_int_equal(faults, 0); }

#endif
