/* SPDX-License-Identifier: BSD-3-Clause */
/* Estimate of the discretisation error of the tension, from the step's own solution. */
#ifndef CAPSTAN_SRC_CABLE_MESH_ERROR_H
#define CAPSTAN_SRC_CABLE_MESH_ERROR_H

#include "cable/line.h"

/* Estimate the largest error of the tension in the line, *error [N], to leading order in the
 * elements' lengths. False, and 0, where no estimate is possible: the weight of an element exceeds
 * its tension. Reads segment forces, contacts and states; O(nodes). */
bool cpsi_mesh_error(const CpsiLine *line, double *error);

#endif
