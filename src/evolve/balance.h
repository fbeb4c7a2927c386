/* SPDX-License-Identifier: BSD-3-Clause */
/* The places of free points in a load step: where the forces of the lines on them, their loads and
 * the obstacles' balance (docs/theory.md 6d). */
#ifndef CAPSTAN_SRC_EVOLVE_BALANCE_H
#define CAPSTAN_SRC_EVOLVE_BALANCE_H

#include "evolve/state.h"

/* The reactions of obstacles on free points where lines start on a shape. */
void cpsi_balance_start(CpsEvolution *evolution);

/* Take the planned step of all lines by `step` (base/workers.h: the item is a line), those at free
 * points as often as it needs, and report on the points. Where no place is found the lines at free
 * points are not certified. */
void cpsi_balance_step(CpsEvolution *evolution, CpsiTask step);

#endif
