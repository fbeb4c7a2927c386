/* SPDX-License-Identifier: BSD-3-Clause */
/* Rounds: a step on curved obstacles, or with friction along the line, is a sequence of programs,
 * each on the tangent planes and in the axes of the place where the last one ended. They come to
 * rest where the equilibrium is stable (docs/theory.md 2.4). */
#ifndef CAPSTAN_SRC_CABLE_ROUNDS_H
#define CAPSTAN_SRC_CABLE_ROUNDS_H

#include "cable/line.h"
#include "cable/step_options.h"
#include "cable/step_program.h"
#include "cable/strategy.h"

/* Rounds from the reference. Coupled bounds depend on the reactions within each round; once the
 * loop cannot solve such a round, they become trial bounds, which go from no friction towards mu R.
 * Ends with the certificate of the place reached. */
void cpsi_tangent_plane_rounds(CpsiLine *line, CpsiChainProgram *program,
                               const CpsiStepOptions *options, const CpsiStrategy *strategy,
                               CpsiBounds bounds);

/* Rounds from the reference with a drag where they go to and fro, however far they go. */
void cpsi_dragged_rounds(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                         const CpsiStrategy *strategy, CpsiBounds bounds);

/* The line laid onto the surfaces from its base, and seen anew there; forces of touching nodes are
 * kept in their axes while these turn, by at most `turned` [rad]. False where an obstacle lets the
 * line go only a part of its way. `sides`: it is to pass none. */
bool cpsi_rounds_refresh_axes(CpsiLine *line, bool sides, double *turned);

/* The bounds mu R, and no friction beyond them. */
void cpsi_rounds_couple_bounds(CpsiLine *line);

#endif
