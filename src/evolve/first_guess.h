/* SPDX-License-Identifier: BSD-3-Clause */
/* Where the search for the places of free points and bodies begins (balance.h). */
#ifndef CAPSTAN_SRC_EVOLVE_FIRST_GUESS_H
#define CAPSTAN_SRC_EVOLVE_FIRST_GUESS_H

#include "evolve/trial.h"

/* Planes turn no more until a round turns them by no more than CPSI_NEAR [rad], bodies until one
 * turns them by no more than CPSI_SETTLED; none turns a body farther than CPSI_FARTHEST_TURN.
 * Rounding turns them by no more than CPSI_TURNS_BY_ROUNDING. */
#define CPSI_NEAR              1e-2
#define CPSI_SETTLED           1e-3
#define CPSI_FARTHEST_TURN     0.3
#define CPSI_TURNS_BY_ROUNDING 2e-9

/* How far a round has turned bodies and the normals of points and of the lines' nodes [rad]. */
typedef struct CpsiTurned {
    double bodies, points;
} CpsiTurned;

/* What is asked of a guess; `several`: the plane on which a point may lie depends on where it is;
 * `exact`: to the limit of the arithmetic, until no axes of points or lines turn any more. */
typedef struct CpsiRoundAim {
    bool several, refined, exact;
    double back; /* bodies are held back by this share of their stiffness */
} CpsiRoundAim;

/* A round, after which points and bodies are where it leads. */
bool cpsi_guess_round(CpsiBalance *balance, const CpsiStepOptions *options, int round,
                      const CpsiRoundAim *guess, CpsiTurned *turned);
/* Where the points and bodies go on the tangent planes of the reference, the bodies in rounds about
 * the poses of the round before; false where that has no solution. What is to touch is on the
 * surface, and what is to stick where it was. `refined`: to the last digits. */
bool cpsi_guess_places(CpsiBalance *balance, bool refined);
/* The same program, for lines longer by a factor, solved to the limit of the arithmetic; lines with
 * axes of their own in rounds, until these turn no more, and no longer. balance->guess,
 * balance->joint and balance->network.joined have the solution, as far as it was found; false where
 * there is none, or the rounds do not end. */
bool cpsi_solve_places(CpsiBalance *balance, double longer);
/* Where the last step of the same stage leads. */
void cpsi_extrapolate_places(CpsiBalance *balance);

/* The joints of a program of the group: free points where the step began, in later rounds where the
 * last one led, then the points on free bodies where these are in the trial. Returns how many. */
int cpsi_place_joints(CpsiBalance *balance, bool first);
/* Let line `item` of the group begin and end the step as planned, its ends at joints where these
 * are. */
void cpsi_impose_plan(CpsiBalance *balance, int item);
/* Both, for all its lines, as the part of a network. */
CpsiNetworkPart cpsi_network_part(CpsiBalance *balance, bool first);

#endif
