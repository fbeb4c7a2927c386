/* SPDX-License-Identifier: BSD-3-Clause */
/* The view of a line after a step: all its arrays, also those that the solver does without. */
#ifndef CAPSTAN_SRC_EVOLVE_VIEW_H
#define CAPSTAN_SRC_EVOLVE_VIEW_H

#include "evolve/state.h"

/* Place the arrays for lines of up to n nodes in the arena; then write their entries. */
void cpsi_view_layout(CpsiViewFill *fill, CpsiArena *arena, int n);
void cpsi_view_fill(CpsiViewFill *fill, int n);

/* Compute the slip of a line on one plane in the step made, which the solver has as the tangential
 * part of the displacement only. Does nothing for other lines. */
void cpsi_view_update(CpsiLine *line);

#endif
