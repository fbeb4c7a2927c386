/* SPDX-License-Identifier: BSD-3-Clause */
/* The least length of a polygonal line that reaches round a cylinder or a ball. */
#ifndef CAPSTAN_SRC_GEOMETRY_SHORTEST_PATH_H
#define CAPSTAN_SRC_GEOMETRY_SHORTEST_PATH_H

#include "geometry/obstacle.h"

/* Bounds on the elements of a polygonal line: none is longer than `length`, and none comes nearer
 * to the axis or centre than `nearest` (0: not known). Their ends lie outside the obstacle, except
 * possibly the two ends of the whole line. */
typedef struct CpsiPolygon {
    double length, nearest; /* [m] */
} CpsiPolygon;

typedef struct CpsiShortestPath {
    double length;   /* [m] no polygon is shorter */
    double rounding; /* [m] rounding error that it may contain */
    Vec3 leaves;     /* unit vector along the shortest path at its first end */
} CpsiShortestPath;

/* The shortest path from a to b round a cylinder or a ball (docs/theory.md 5). `turn` [rad]: the
 * angle by which the path turns about the axis of a cylinder, right-hand rule; a ball has only one
 * shortest path. False where the straight path is free, and for a plane. */
bool cpsi_shortest_path(const CpsiObstacle *obstacle, Vec3 a, Vec3 b, double turn,
                        CpsiPolygon polygon, CpsiShortestPath *out);

/* [m] The least length of a polygon from a to b that meets the half-line from the centre of a ball
 * in direction e, a unit vector, from `polygon.nearest` on outwards. It has a rounding error as
 * above. False where an end is seen from the centre at less than a right angle to e. */
bool cpsi_shortest_path_across(const CpsiObstacle *ball, Vec3 a, Vec3 b, Vec3 e,
                               CpsiPolygon polygon, double *length);

#endif
