/* SPDX-License-Identifier: BSD-3-Clause */
/* Stopping at a good place: the first SIGINT or SIGTERM is remembered, and the load step under way
 * is given up; the second ends the program at once. */
#ifndef CAPSTAN_CLI_SIGNALS_H
#define CAPSTAN_CLI_SIGNALS_H

#include "capstan/evolve.h"

/* From here on. A file over the size limit then shows as a write error, and is cleaned up like
 * one. */
void cli_catch_signals(void);

/* The signal that asked to stop, 0: none. 128 more is the exit code. */
int cli_interrupted(void);

/* As cps_evolution_create; its steps are given up once a signal asked to stop. */
CpsStatus cli_evolution_create(const CpsScene *scene, CpsEvolution **out, CpsError *err);

#endif
