/* SPDX-License-Identifier: BSD-3-Clause */
/* A start from given nodes: any reference x_R, with the forces T_R, R_R or A_R that it is known to
 * have. */
#ifndef CAPSTAN_SRC_EVOLVE_NODE_START_H
#define CAPSTAN_SRC_EVOLVE_NODE_START_H

#include "cable/line.h"

/* Do number, lengths and forces fit the line and the scene?  The line has passed the checks of its
 * numbers. Returns CPS_OK or CPS_ERR_ARGUMENT. */
CpsStatus cpsi_node_start_check(const CpsScene *scene, const CpsLine *line, CpsError *err);

/* Tension, reaction and state of a line that is placed, with its ends, as the start gives them. */
void cpsi_node_start(CpsiLine *line, const CpsLine *def);

#endif
