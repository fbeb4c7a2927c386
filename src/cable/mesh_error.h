/* SPDX-License-Identifier: BSD-3-Clause */
/* How far off the tension is because elements have a length: an estimate from the step's own
 * answer. */
#ifndef CAPSTAN_SRC_CABLE_MESH_ERROR_H
#define CAPSTAN_SRC_CABLE_MESH_ERROR_H

#include "cable/line.h"

/* [N] Estimate of the largest error of the tension in the line, to leading order in the elements'
 * lengths; NaN where the answer says nothing of it: an element that weighs more than it is tight.
 * Reads segment forces, contacts and states; O(nodes). */
double cpsi_mesh_error(const CpsiLine *line);

#endif
