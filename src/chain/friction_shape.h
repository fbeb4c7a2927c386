/* SPDX-License-Identifier: BSD-3-Clause */
/* The boundary of a planar friction set made of edges, corners and circular arcs, in the order of
 * their normals: what Newton's method on the active set (active_set.h) needs of it. */
#ifndef CAPSTAN_SRC_CHAIN_FRICTION_SHAPE_H
#define CAPSTAN_SRC_CHAIN_FRICTION_SHAPE_H

#include <stdbool.h>

/* A piece of the boundary, counterclockwise. An edge has one normal; the normals of an arc, or of a
 * corner, turn by less than pi. */
typedef struct CpsiShapePiece {
    bool is_edge;
    double at[2][2];          /* its end points */
    double normal[2][2];      /* unit, at the end points; of an edge both are the same */
    double centre[2], radius; /* of an arc; of a corner the point and 0 */
} CpsiShapePiece;

enum { CPSI_MOST_PIECES = 128 };

typedef struct CpsiFrictionShape {
    int count;    /* 0: the boundary is not of this kind */
    double inner; /* the disc of this radius round 0 lies in the set */
    double reach; /* ... and the set in that of this radius */
    CpsiShapePiece piece[CPSI_MOST_PIECES];
} CpsiFrictionShape;

/* The support function of the set in the direction of n. */
double cpsi_friction_shape_support(const CpsiFrictionShape *shape, const double n[2]);

/* The distance of x from the set, and the piece of its nearest point; 0 and -1 inside. */
double cpsi_friction_shape_beyond(const CpsiFrictionShape *shape, const double x[2], int *piece);

/* The arc or corner, or the first edge on the way to it from the arc or corner `from`, whose
 * normals contain the unit vector q. */
int cpsi_friction_shape_turn(const CpsiFrictionShape *shape, int from, const double q[2],
                             double rounding);

/* The largest t >= 0 with x + t q in the set, x in it, q a unit vector; 0 where x is not. */
double cpsi_friction_shape_reach(const CpsiFrictionShape *shape, const double x[2],
                                 const double q[2]);

#endif
