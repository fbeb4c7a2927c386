/* SPDX-License-Identifier: BSD-3-Clause */
/* Tensions of an inextensible line that its position does not determine: which are reported, and
 * their range. */
#ifndef CAPSTAN_SRC_CABLE_TENSION_FIELD_H
#define CAPSTAN_SRC_CABLE_TENSION_FIELD_H

#include "cable/force_set.h"
#include "cable/line.h"
#include "cable/step_options.h"

/* The force law of a step. */
CpsiForceLaw cpsi_force_law(const CpsiStepOptions *options, bool exact);

/* The forces of least sum l (T - T_R)^2, T_R = line->tension_before, of all that hold the line
 * where it is; then, at nodes in corners, those of least sum (R - R_R)^2. Writes the force fields;
 * false where there is no choice or no solution; then the fields are unchanged.
 *
 *   tight   segments are taut and contacts stick only where positions show it to rounding */
bool cpsi_line_tension_field(CpsiLine *line, CpsiForceSet *set, const CpsiStepOptions *options,
                             bool exact);

/* Write the least and the greatest tension of the elements at the ends, over the same set, to the
 * report of a certified step. */
void cpsi_line_tension_range(CpsiLine *line, CpsiForceSet *set, const CpsiStepOptions *options);

#endif
