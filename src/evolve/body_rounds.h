/* SPDX-License-Identifier: BSD-3-Clause */
/* The poses of free bodies, and the places of the points and lines of their group, by rounds of the
 * program of the first guess, each about the poses to which the one before has led. Lines that are
 * inextensible have no tangent for the search (balance.h); the program has their forces. */
#ifndef CAPSTAN_SRC_EVOLVE_BODY_ROUNDS_H
#define CAPSTAN_SRC_EVOLVE_BODY_ROUNDS_H

#include "evolve/first_guess.h"

typedef struct CpsiBodyRounds {
    bool several;    /* the planes on which points lie turn as well */
    bool has_turned; /* balance->turned has the rotations by the last round */
    bool may_return; /* a round has been solved from balance->rigid_from */
    int tried, done; /* all, and those since points were where the step began */
    double back;     /* share of their stiffness by which bodies are held back */
    double left;     /* [N] in the last round */
    CpsiTurned turned;
} CpsiBodyRounds;

CpsiBodyRounds cpsi_body_rounds(const CpsiBalance *balance);

/* The next round, from the poses of the trial; false where there is none. `near`: it has turned the
 * bodies by so little that its solution may be the answer; then the lines are as before the step.
 * Bodies are held back by more where more is left than in the round before, or where the next one
 * has no solution, as when lines that are hardly long enough have turned them too far. */
bool cpsi_body_round(CpsiBalance *balance, CpsiBodyRounds *rounds, bool *near);

#endif
