/* SPDX-License-Identifier: BSD-3-Clause */
/* Rounds: a step on curved obstacles, or with friction that depends on the direction of the line,
 * is a sequence of programs, each on the tangent planes and in the axes of the position where the
 * last one ended. Rounds converge where the equilibrium is stable (docs/theory.md 2.4). */
#ifndef CAPSTAN_SRC_CABLE_ROUNDS_H
#define CAPSTAN_SRC_CABLE_ROUNDS_H

#include "cable/line.h"
#include "cable/step_options.h"
#include "cable/step_program.h"
#include "cable/strategy.h"

/* Rounds from the reference. Coupled bounds depend on the reactions within each round; once the
 * loop cannot solve such a round, they become trial bounds, which go from no friction towards mu R.
 * Ends with the certificate at the position reached. Returns whether the axes were scattered: in
 * no round did they turn by less than half a radian. */
bool cpsi_tangent_plane_rounds(CpsiLine *line, CpsiChainProgram *program,
                               const CpsiStepOptions *options, const CpsiStrategy *strategy,
                               CpsiBounds bounds);

/* Rounds from the reference with a drag where they go to and fro, however far they go; `drag` is
 * that of the first rounds. */
void cpsi_dragged_rounds(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                         const CpsiStrategy *strategy, CpsiBounds bounds, double drag);

/* Move the base to the position, with touching nodes moved onto the surfaces, and update the
 * contacts there. Friction forces keep their components while the axes turn, by at most `turned`
 * [rad]. `sides`: the line must not pass an obstacle. False where the displacement had to be
 * shortened. */
bool cpsi_rounds_refresh_axes(CpsiLine *line, bool sides, double *turned);

/* Take the solution of a last round, in the position, as the rounds end with it: axes and contacts
 * of the position, bounds and certificate. */
void cpsi_rounds_end(CpsiLine *line, const CpsiChainProgram *program,
                     const CpsiStepOptions *options, CpsiBounds bounds, const CpsiIpmReport *ipm);

/* Set the bounds to mu R, and scale friction back where it exceeds them. */
void cpsi_rounds_couple_bounds(CpsiLine *line);

#endif
