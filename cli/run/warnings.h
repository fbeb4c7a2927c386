/* SPDX-License-Identifier: BSD-3-Clause */
/* What a user must know of a step though it is solved and certified: with frozen friction or strict
 * contact what S90 annex 6 shows, where most of a line is slack, where its forces leave a choice of
 * places, energy that comes from nowhere or is set free, coordinates with too few digits, and where
 * the mesh is coarse for the bends in it; and, whatever the outcome, where a line goes through an
 * obstacle. */
#ifndef CAPSTAN_CLI_RUN_WARNINGS_H
#define CAPSTAN_CLI_RUN_WARNINGS_H

#include "capstan/evolve.h"

enum {
    CAUTION_BOUND,
    CAUTION_LIFTED,
    CAUTION_SUNK,
    CAUTION_SLACK,
    CAUTION_PLACES,
    CAUTION_JUMPED,
    CAUTION_MADE,
    CAUTION_FREED,
    CAUTION_ROUNDED,
    CAUTION_PIERCED,
    CAUTION_BEND,
    CAUTIONS
};

/* The worst case of each kind. */
typedef struct Cautions {
    struct {
        int steps;        /* in how many steps it was met */
        double value, of; /* the figure, and what it is a part of */
        char step[96], line[96], obstacle[96];
    } kind[CAUTIONS];
    CpsBend bend; /* the worst */
} Cautions;

/* Look at the step just taken. */
void cautions_step(Cautions *cautions, const CpsScene *scene, const CpsEvolution *evolution);

/* A line on standard error for each kind met, with its figures and what to do. */
void warnings_print(const Cautions *cautions);

/* A bend round the obstacle, in brackets, on standard error: what the mesh makes of it, and which
 * mesh would do. */
void warnings_print_bend(const CpsBend *bend, const char *obstacle);

#endif
