/* SPDX-License-Identifier: BSD-3-Clause */
/* Warnings about a step even if it is solved and certified: with frozen friction or contact of the
 * reference the effects of S90 annex 6; where most of a line is slack; where the forces do not
 * determine the positions; energy created or released; coordinates with too few digits; meshes too
 * coarse for the bends; tensions above a breaking load; buoys within lines that rise out
 * of the water; anchors beyond their limits. And, whatever
 * the outcome, where a line penetrates an obstacle. */
#ifndef CAPSTAN_CLI_RUN_WARNINGS_H
#define CAPSTAN_CLI_RUN_WARNINGS_H

#include "capstan/evolve.h"

enum {
    WARNING_BOUND,
    WARNING_LIFTED,
    WARNING_SUNK,
    WARNING_SLACK,
    WARNING_PLACES,
    WARNING_JUMPED,
    WARNING_MADE,
    WARNING_FREED,
    WARNING_ROUNDED,
    WARNING_PIERCED,
    WARNING_BEND,
    WARNING_BROKEN,
    WARNING_EMERGED,
    WARNING_DRY,
    WARNING_DRAGGED, /* and the two below: of a point */
    WARNING_CAPACITY,
    WARNING_UPLIFT,
    WARNINGS
};

typedef struct WorstCase {
    int steps;        /* number of steps in which it occurred */
    double value, of; /* the value, and the value that it is a share of, or its arc length */
    char step[96], line[96], obstacle[96]; /* line: or point */
    bool in_time;                          /* of energies: in a step in time */
} WorstCase;

/* The worst case of each kind. */
typedef struct Warnings {
    WorstCase kind[WARNINGS];
    WorstCase utilisation; /* the largest of the breaking load, which may be below 1 */
    CpsBend bend;          /* the worst */
} Warnings;

/* Examine the step that has just been solved. */
void warnings_note_step(Warnings *warnings, const CpsScene *scene, const CpsEvolution *evolution);

/* Print a line on standard error for each kind that occurred, with its figures and what to do. */
void warnings_print(const Warnings *warnings);

/* Print a bend round the obstacle, in brackets, on standard error: the tension ratio of the mesh,
 * and the mesh that would be fine enough. */
void warnings_print_bend(const CpsBend *bend, const char *obstacle);

#endif
