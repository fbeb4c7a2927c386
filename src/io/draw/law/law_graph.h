/* SPDX-License-Identifier: BSD-3-Clause */
/* Laws drawn over velocity: for one component the graph of forces; for more the forces at some
 * speeds in all directions. */
#ifndef CAPSTAN_SRC_IO_DRAW_LAW_LAW_GRAPH_H
#define CAPSTAN_SRC_IO_DRAW_LAW_LAW_GRAPH_H

#include "capstan/results.h"

/* Either a friction law or a resistance law. */
CpsStatus cpsi_law_graph(const CpsSet *set, const CpsResistance *resistance,
                         const CpsLawPicture *picture, FILE *out, CpsError *err);

#endif
