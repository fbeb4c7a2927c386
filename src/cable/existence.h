/* SPDX-License-Identifier: BSD-3-Clause */
/* Proofs that a line has no equilibrium. */
#ifndef CAPSTAN_SRC_CABLE_EXISTENCE_H
#define CAPSTAN_SRC_CABLE_EXISTENCE_H

#include "cable/line.h"
#include "cable/step_options.h"

/* [-] Least power of the loads per metre along a motion that proves that they fall, as a share of
 * the sum of their sizes: forces in a certified equilibrium balance to less. */
#define CPSI_LEAST_POWER 1e-6

/* Is there a proof that the step, as it is posed, has no solution?  Then the line's report holds
 * the outcome and the proof. */
bool cpsi_line_has_no_equilibrium(CpsiLine *line, const CpsiStepOptions *options);

/* Is there a proof that a line with two free ends on planes, with the frozen bounds of its
 * reference, has no equilibrium? Then the line's report holds the outcome and the proof. */
bool cpsi_line_outruns_frozen_bounds(CpsiLine *line);

/* Does the line not touch an obstacle, and never come nearer to one while it moves along the unit
 * vector v? */
bool cpsi_line_moves_away(const CpsiLine *line, Vec3 v);

/* Does the line fall freely without ever touching an obstacle? `direction` is that of the sum of
 * its loads and `load` [N] its size. Reads position and load. */
bool cpsi_line_falls_away(const CpsiLine *line, double direction[3], double *load);

#endif
