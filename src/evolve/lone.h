/* SPDX-License-Identifier: BSD-3-Clause */
/* Free points at which no line ends any more. */
#ifndef CAPSTAN_SRC_EVOLVE_LONE_H
#define CAPSTAN_SRC_EVOLVE_LONE_H

#include "evolve/trial.h"

/* Find the place of the one point of a group without lines: where it is, if the forces on it
 * balance there; otherwise it goes along what is left, to the first obstacle or the surface of the
 * water. Solved, or stalled where it would go on from there, or unbounded where nothing stops it.
 */
CpsOutcome cpsi_lone_point(CpsiBalance *balance);

#endif
