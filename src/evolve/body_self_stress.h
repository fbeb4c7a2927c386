/* SPDX-License-Identifier: BSD-3-Clause */
/* Whether inextensible lines that meet at free bodies are too short to be laid between what holds
 * them, whatever the poses of the bodies (docs/theory.md 5a); without bodies: cable/self_stress.h.
 */
#ifndef CAPSTAN_SRC_EVOLVE_BODY_SELF_STRESS_H
#define CAPSTAN_SRC_EVOLVE_BODY_SELF_STRESS_H

#include "evolve/trial.h"

/* Is there such a proof for the group, the ends of whose lines are set as for a guess? Then
 * balance->guess.pull has the forces: [6 k] (3) that of line k on what is at its end A towards its
 * end B, the largest of which is 1, [6 k + 3] the opposite; and *missing [m] is what (6j) says. The
 * points and bodies of the trial are moved, and the matrix is overwritten. */
bool cpsi_bodies_are_out_of_reach(CpsiBalance *balance, double *missing);

#endif
