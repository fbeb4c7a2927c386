/* SPDX-License-Identifier: BSD-3-Clause */
/* Laws drawn over velocity: of one component the graph of forces; of more the forces at some speeds
 * in all directions. */
#ifndef CAPSTAN_SRC_IO_DRAW_LAW_GRAPH_H
#define CAPSTAN_SRC_IO_DRAW_LAW_GRAPH_H

#include "capstan/results.h"

/* A friction law, or a resistance: one of them. */
CpsStatus cpsi_law_graph(const CpsSet *set, const CpsResistance *resistance,
                         const CpsLawPicture *picture, FILE *out, CpsError *err);

#endif
