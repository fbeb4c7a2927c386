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

#endif
