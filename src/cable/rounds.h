/* SPDX-License-Identifier: BSD-3-Clause */
/* Rounds: a step on curved obstacles, or with friction along the line, is a sequence of programs,
 * each on the tangent planes and in the axes of the place where the last one ended. They come to
 * rest where the equilibrium is stable (docs/theory.md 2.4). */
#ifndef CAPSTAN_SRC_CABLE_ROUNDS_H
#define CAPSTAN_SRC_CABLE_ROUNDS_H

#include "cable/line.h"
#include "cable/step_options.h"
#include "cable/step_program.h"

/* Rounds from the reference, looking ahead or slowly. The bounds follow the reactions within each
 * round; once the loop cannot make them, they are tried: from no friction towards mu R. Ends with
 * the certificate of the place reached. */
void cpsi_tangent_plane_rounds(CpsiLine *line, CpsiChainProgram *program,
                               const CpsiStepOptions *options, CpsiBounds bounds);

/* Rounds that a drag holds back where they turn to and fro, from the reference, however far they
 * go. */
void cpsi_dragged_rounds(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                         CpsiBounds bounds);

/* The line laid onto the surfaces from its base, and seen anew there; forces of touching nodes are
 * kept in their axes while these turn, by at most `turned` [rad]. False where an obstacle lets the
 * line go only a part of its way. `sides`: it is to pass none. */
bool cpsi_rounds_refresh_axes(CpsiLine *line, bool sides, double *turned);

/* The bounds mu R, and no friction beyond them. */
void cpsi_rounds_couple_bounds(CpsiLine *line);

#endif
