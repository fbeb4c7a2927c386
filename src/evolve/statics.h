/* SPDX-License-Identifier: BSD-3-Clause */
/* The start by statics: the first equilibrium of a line, without friction. */
#ifndef CAPSTAN_SRC_EVOLVE_STATICS_H
#define CAPSTAN_SRC_EVOLVE_STATICS_H

#include "evolve/substeps.h"

/* Place the line in an equilibrium without friction, from its initial guess. */
void cpsi_line_place_statically(CpsiLine *line, CpsiChainProgram *program,
                                const CpsiStepOptions *options, CpsiSubsteps *scratch);

#endif
