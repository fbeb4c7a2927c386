/* SPDX-License-Identifier: BSD-3-Clause */
/* The least and the greatest tensions, loads and lengths of each line, and places, angles and
 * forces of each body, over the steps of a run. */
#ifndef CAPSTAN_CLI_RUN_EXTREMES_H
#define CAPSTAN_CLI_RUN_EXTREMES_H

#include <stdio.h>

#include "capstan/evolve.h"

/* Of a body: x, y, z, roll, pitch, yaw and heel [degrees], and the lines' force along x, y, z. */
enum { EXTREMES_OF_BODY = 10 };

typedef struct Extremes {
    int line_count, step_count, capacity;
    CpsExtremes *line;     /* (line_count) */
    CpsExtreme *body;      /* (bodies, EXTREMES_OF_BODY) */
    char (*step_name)[96]; /* (step_count) */
} Extremes;

/* Add the step that has just been solved. False: out of memory. */
bool extremes_note_step(Extremes *extremes, const CpsEvolution *evolution);

/* Print the tables, unless fewer than two steps were added. */
void extremes_print(const Extremes *extremes, const CpsScene *scene, const CpsEvolution *evolution,
                    FILE *out);

void extremes_free(Extremes *extremes);

#endif
