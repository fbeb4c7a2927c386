/* SPDX-License-Identifier: BSD-3-Clause */
/* The matrix of the points and bodies of a scene: a block for each point that is not on a body, two
 * for each body, and pairs of blocks where a line joins them. Held ones have theirs as well, as a
 * stage may let them go. */
#ifndef CAPSTAN_SRC_EVOLVE_JOINT_SYSTEM_H
#define CAPSTAN_SRC_EVOLVE_JOINT_SYSTEM_H

#include "evolve/points.h"
#include "linalg/graph_matrix.h"

/* Point k has block k, body k the two blocks from points + 2 k on. NULL where memory does not
 * suffice. */
CpsiGraphMatrix *cpsi_joint_system(const CpsiPoints *points, const CpsiBodies *bodies, int lines);

#endif
