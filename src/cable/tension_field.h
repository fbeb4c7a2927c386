/* SPDX-License-Identifier: BSD-3-Clause */
/* Tensions of an inextensible line that its place leaves open: which are reported, and between
 * which values they lie. */
#ifndef CAPSTAN_SRC_CABLE_TENSION_FIELD_H
#define CAPSTAN_SRC_CABLE_TENSION_FIELD_H

#include "cable/force_set.h"
#include "cable/line.h"
#include "cable/step_options.h"

/* The law that the forces of a step obey. */
CpsiForceLaw cpsi_force_law(const CpsiStepOptions *options, bool tight);

/* The forces of least sum l (T - T_R)^2, T_R = line->tension_before, of all that hold the line
 * where it is; then, at nodes in corners, those of least sum (R - R_R)^2. Writes the force fields;
 * false where there is no choice or no answer, and they are as they were.
 *
 *   tight   taut and stuck only where the places say so to rounding
 */
bool cpsi_line_tension_field(CpsiLine *line, CpsiForceSet *set, const CpsiStepOptions *options,
                             bool tight);

/* The least and the greatest tension of the elements at the ends, over the same set, into the
 * report of a step that was certified. */
void cpsi_line_tension_range(CpsiLine *line, CpsiForceSet *set, const CpsiStepOptions *options);

#endif
