/* SPDX-License-Identifier: BSD-3-Clause */
/* How long a polygon must be to reach round a cylinder or a ball. */
#ifndef CAPSTAN_SRC_GEOMETRY_SHORTEST_WAY_H
#define CAPSTAN_SRC_GEOMETRY_SHORTEST_WAY_H

#include "geometry/obstacle.h"

/* What is known of the elements of a polygon: none is longer than `length`, and none comes nearer
 * to the axis or centre than `nearest` (0: not known). Their ends lie outside the obstacle, the
 * polygon's own ends apart. */
typedef struct CpsiPolygon {
    double length, nearest; /* [m] */
} CpsiPolygon;

typedef struct CpsiShortestPath {
    double length;   /* [m] no polygon is shorter */
    double rounding; /* [m] what arithmetic may have added to it */
    Vec3 leaves; /* the direction, of length 1, in which the shortest way round the obstacle leaves
                    its first end */
} CpsiShortestPath;

/* The shortest way from a to b round a cylinder or a ball (docs/theory.md 5). `turn` [rad]: by
 * which the way goes about the axis of a cylinder, right-hand rule; a ball has one way only. False
 * where the obstacle is not in the way, and for a plane. */
bool cpsi_shortest_path(const CpsiObstacle *obstacle, Vec3 a, Vec3 b, double turn,
                        CpsiPolygon polygon, CpsiShortestPath *out);

#endif
