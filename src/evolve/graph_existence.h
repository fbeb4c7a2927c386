/* SPDX-License-Identifier: BSD-3-Clause */
/* Proofs that lines which meet at free points or bodies have no equilibrium (docs/theory.md 5a). */
#ifndef CAPSTAN_SRC_EVOLVE_GRAPH_EXISTENCE_H
#define CAPSTAN_SRC_EVOLVE_GRAPH_EXISTENCE_H

#include "evolve/trial.h"

/* Does nothing hold the group, and do its loads fall along a translation that neither reactions nor
 * friction stop? Then its lines, points and bodies are where they were before the step, with the
 * outcome unbounded and the proof in the report of each of its lines. Otherwise they are as before,
 * but for what a step imposes on them. */
bool cpsi_group_falls(CpsiBalance *balance);

/* Does a given moment turn a body of the group in whatever pose it is? Reported likewise, with the
 * proof in the report of the body and none in those of the lines. */
bool cpsi_group_turns(CpsiBalance *balance);

/* Are the inextensible lines of the group too short to be laid between what holds it? Reported
 * likewise, as infeasible. */
bool cpsi_group_is_too_short(CpsiBalance *balance);

/* Bring bodies from where the step began to poses within reach of their inextensible lines, as far
 * as these reach. */
void cpsi_bring_bodies_within_reach(CpsiBalance *balance);

/* Where the last trial has left a line with a proof of its own, which would depend on the places
 * tried, leave all where it was before the step, not certified; else false. */
bool cpsi_group_is_left(CpsiBalance *balance);

/* Does anything hold a line of the group: an end, a grasp, or a point or body that does not move?
 */
bool cpsi_group_is_held(const CpsiBalance *balance);

#endif
