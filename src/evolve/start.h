/* SPDX-License-Identifier: BSD-3-Clause */
/* The initial positions of a line's nodes, by natural length along its initial shape.
 *
 *   straight,   node i at the arc length a_i s of the shape, with a_i its natural abscissa and s
 *   polyline    the length of the shape over that of the line, at least 1: an elastic line is
 *               stretched uniformly
 *   arc         nodes on the circle, each chord as long as its element: without tension
 *   nodes       where they are given (node_start.h)
 *   static      a first guess for statics: uniformly on the straight line between the held ends,
 *               or from the held end along the force on the free one (straight down, -z, where
 *               there is none)
 *
 * The line must have passed the check of its start (scene_check.c), which itself uses
 * cpsi_start_walk. */
#ifndef CAPSTAN_SRC_EVOLVE_START_H
#define CAPSTAN_SRC_EVOLVE_START_H

#include "base/vec3.h"
#include "capstan/scene.h"

/* The circle of a start arc: centre + radius (cos t e1 + sin t e2), t from 0. */
typedef struct CpsiArc {
    Vec3 centre; /* nearest point of the axis to the first node */
    Vec3 e1, e2; /* unit vectors: to the first node, and along the first step */
    double radius;
} CpsiArc;
CpsiArc cpsi_start_arc(const CpsLine *line);

/* [m] Length of the start shape; an arc and a static start are as long as the line. */
double cpsi_start_length(const CpsLine *line);

/* Visit the nodes from A to B. */
typedef struct CpsiStartWalk {
    const CpsLine *line;
    int node;       /* next to visit */
    double natural; /* [m] abscissa of that node */
    double stretch; /* [-] straight, polyline: shape's length over line's */
    double angle;   /* [rad] arc: of that node */
    double behind;  /* [m] polyline: length of the pieces already passed */
    int piece;      /* polyline: piece that the walk is on */
    CpsiArc arc;
    Vec3 from, to; /* static: the ends of the guess */
} CpsiStartWalk;
CpsiStartWalk cpsi_start_walk(const CpsLine *line);
Vec3 cpsi_start_next(CpsiStartWalk *walk);

/* All nodes.  position   (elements + 1, 3) [m], written */
void cpsi_start_place(const CpsLine *line, double *position);

/* The initial position of an end: the position of a held end, else the end of the initial shape. */
void cpsi_start_end(const CpsLine *line, int end, double position[3]);

#endif
