/* SPDX-License-Identifier: BSD-3-Clause */
/* Signals (signals.h). */
#include "signals.h"

#include <signal.h>
#include <stdatomic.h>
#include <string.h>
#include <unistd.h>

/* Read by all threads that solve; without a lock on all machines, as a handler needs it. */
static atomic_int stop_signal;
_Static_assert(ATOMIC_INT_LOCK_FREE == 2, "a signal handler may not wait for a lock");

static void on_signal(int signal_number) {
    if (stop_signal) _exit(128 + signal_number);
    stop_signal = signal_number;
}

void cli_catch_signals(void) {
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

int cli_interrupted(void) { return stop_signal; }

static bool is_stopped(void *user) {
    (void)user;
    return stop_signal != 0;
}

CpsStatus cli_evolution_create(const CpsScene *scene, CpsEvolution **out, CpsError *err) {
    CpsStatus status = cps_evolution_create(scene, out, err);
    if (status == CPS_OK) status = cps_evolution_interrupt(*out, is_stopped, NULL, err);
    if (status == CPS_OK) return CPS_OK;
    cps_evolution_destroy(*out);
    *out = NULL;
    return status;
}
