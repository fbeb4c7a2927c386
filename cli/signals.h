/* SPDX-License-Identifier: BSD-3-Clause */
/* Interruption by signals: the first SIGINT or SIGTERM is recorded and interrupts the present load
 * step; the second ends the program at once. */
#ifndef CAPSTAN_CLI_SIGNALS_H
#define CAPSTAN_CLI_SIGNALS_H

#include "capstan/evolve.h"

/* Catch signals from here on. A file that exceeds the size limit then gives a write error, after
 * which its files are removed as usual. */
void cli_catch_signals(void);

/* The signal received, 0: none. The exit code is 128 more. */
int cli_interrupted(void);

/* As cps_evolution_create; steps are interrupted after a signal. */
CpsStatus cli_evolution_create(const CpsScene *scene, CpsEvolution **out, CpsError *err);

#endif
