/* SPDX-License-Identifier: BSD-3-Clause */
/* A command is run from its beginning for each allocation that is refused. For one file of a test
 * program. */
#ifndef CAPSTAN_TEST_FAULT_REFUSE_AGAIN_H
#define CAPSTAN_TEST_FAULT_REFUSE_AGAIN_H

#include "refuse_command.h"

/* `least`: allocations that such a command makes at the very least */
static void refuse_again(Command *run, long least, int argc, const char *const *argv) {
    bool reached = true;
    long tried = 0, next = places;
    asked = 0;
    recording = true;
    assert_int_equal(command(run, -1, argc, argv, &reached), EXIT_OK);
    recording = false;
    reached = true;
    /* a later run may make more of them than the first one */
    for (long k = 0; reached && (which[0] || k < asked); k++) {
        const bool fresh = next < places && first[next] == k;
        next += fresh;
        if (!is_chosen(k, fresh)) continue;
        const long before = live;
        const int code = command(run, k, argc, argv, &reached);
        const char *wrong = judge(code, before, false, false);
        if (!reached && code != EXIT_OK) wrong = "nothing was refused";
        if (wrong)
            fail_msg("allocation %ld: %s: exit code %d: %s", k, wrong, code, reported.message);
        tried += reached;
    }
    print_message("%ld allocations, %ld refused\n", asked, tried);
    /* built as shared libraries they cannot be reached */
    if (asked == 0) skip();
    assert_in_range(asked, least, 1000000);
}

#endif
