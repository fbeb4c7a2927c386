/* SPDX-License-Identifier: BSD-3-Clause */
/* The stiffness of an end of a line after a step (capstan/stiffness.h; docs/theory.md 6c). */
#ifndef CAPSTAN_SRC_CABLE_STIFFNESS_H
#define CAPSTAN_SRC_CABLE_STIFFNESS_H

#include "cable/line.h"
#include "cable/step_options.h"
#include "capstan/stiffness.h"
#include "chain/chain_program.h"

/* `program`: scratch memory for the line. */
CpsStiffness cpsi_line_stiffness(const CpsiLine *line, CpsiChainProgram *program,
                                 const CpsiStepOptions *options, CpsStiffnessKind kind, int end);

/* A derivative of the forces on the line at its ends A and B by their places, (6, 6) [N/m], that of
 * the step where cpsi_line_stiffness would find it. Elsewhere what is not looked into there counts
 * as held, and so do loose nodes: for Newton's method on the places of the ends. All 0 where there
 * is none, and for a free end. */
void cpsi_line_tangent(const CpsiLine *line, CpsiChainProgram *program,
                       const CpsiStepOptions *options, double tangent[36]);

#endif
