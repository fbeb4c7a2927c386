/* SPDX-License-Identifier: BSD-3-Clause */
/* The friction factors of the nodes of a line with friction zones. */
#ifndef CAPSTAN_SRC_EVOLVE_FRICTION_ZONE_H
#define CAPSTAN_SRC_EVOLVE_FRICTION_ZONE_H

#include "capstan/scene.h"

/* The mean factor over the length `share` of a node that begins at abscissa `low` [m]. *first is
 * the number of zones that end before that: 0 for the first node; pass it on from node to node. */
double cpsi_zone_factor(const CpsLine *line, int *first, double low, double share);

#endif
