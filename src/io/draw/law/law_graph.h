/* SPDX-License-Identifier: BSD-3-Clause */
/* Laws drawn over velocity: for one component the graph of forces; for more the forces at some
 * speeds in all directions. */
#ifndef CAPSTAN_SRC_IO_DRAW_LAW_LAW_GRAPH_H
#define CAPSTAN_SRC_IO_DRAW_LAW_LAW_GRAPH_H

#include "capstan/results.h"

/* Whether a picture of a law of n components was made by cps_law_picture_default(), has what it
 * counts, and different axes. */
CpsStatus cpsi_law_picture_check(const CpsLawPicture *picture, int n, CpsError *err);

/* Either a friction law or a resistance law. */
CpsStatus cpsi_law_graph(const CpsSet *set, const CpsResistance *resistance,
                         const CpsLawPicture *picture, FILE *out, CpsError *err);

#endif
