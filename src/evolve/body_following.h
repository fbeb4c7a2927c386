/* SPDX-License-Identifier: BSD-3-Clause */
/* The free points of a group as they follow its bodies (docs/theory.md 6e). */
#ifndef CAPSTAN_SRC_EVOLVE_BODY_FOLLOWING_H
#define CAPSTAN_SRC_EVOLVE_BODY_FOLLOWING_H

#include "evolve/trial.h"

/* Add to the reported stiffness of each body what it loses as the free points follow the body, all
 * other bodies in their poses, and set balance->coupling to what each loses by the motions of the
 * others. The matrix is that of cpsi_fill_matrix, of which nothing is kept; points and bodies are
 * reported on. */
void cpsi_add_followers(CpsiBalance *balance);

#endif
