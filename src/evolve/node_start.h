/* SPDX-License-Identifier: BSD-3-Clause */
/* A start from given nodes: any reference x_R, with its known forces T_R, R_R or A_R. */
#ifndef CAPSTAN_SRC_EVOLVE_NODE_START_H
#define CAPSTAN_SRC_EVOLVE_NODE_START_H

#include "cable/line.h"

/* Do number, lengths and forces fit the line and the scene?  The line has passed the checks of its
 * numbers. Returns CPS_OK or CPS_ERR_ARGUMENT. */
CpsStatus cpsi_node_start_check(const CpsScene *scene, const CpsLine *line, CpsError *err);

/* Set tension, reaction and state from the start of a line whose nodes and ends have been
 * placed. */
void cpsi_node_start(CpsiLine *line, const CpsLine *def);

#endif
