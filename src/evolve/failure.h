/* SPDX-License-Identifier: BSD-3-Clause */
/* Ends that are let go, and lines that part (capstan/failure.h). */
#ifndef CAPSTAN_SRC_EVOLVE_FAILURE_H
#define CAPSTAN_SRC_EVOLVE_FAILURE_H

#include "evolve/state.h"

/* Let an end go: it is at its point no more. What the step imposes on it is planned by the caller.
 */
void cpsi_release_end(CpsEvolution *evolution, int line, int end, CpsRelease by);

/* Set which ends are at points, after releases have changed. */
void cpsi_follow_releases(CpsEvolution *evolution);

/* What is imposed on an end now. One that was let go is free, also after a step without a certified
 * answer, which has left the line as it was before. */
CpsEnd cpsi_end_now(const CpsEvolution *evolution, int line, int end);

/* Does a change of a stage name an end that has parted, which it leaves alone? */
bool cpsi_change_is_lost(const CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                         const CpsChange *change);

/* The break that is due after the last step; is_break is false where none is. */
CpsBreak cpsi_break_due(const CpsEvolution *evolution);

#endif
