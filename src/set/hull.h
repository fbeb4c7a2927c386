/* SPDX-License-Identifier: BSD-3-Clause */
/* The hull of points as half-spaces: facets and the affine space that the points span. */
#ifndef CAPSTAN_SRC_SET_HULL_H
#define CAPSTAN_SRC_SET_HULL_H

#include <stdbool.h>

/* { x : <normal_i, x> = level_i,  <row_k, x> <= offset_k },  normals and rows of length one, rows
 * in the span of `basis`. One block of memory. */
typedef struct CpsiHull {
    int n, dimension;       /* of x; of the hull, 1 to 3 */
    int rows;               /* facets */
    double *row, *offset;   /* (rows, n), (rows) */
    double *normal, *level; /* (n - dimension, n), (n - dimension) */
    double *basis, *origin; /* (dimension, n), (n): x = origin + basis' c */
    int pieces;             /* pieces of the boundary: edges of a polygon in order, or triangles */
    double *piece; /* (pieces, dimension, dimension) their corners c; of a segment its two ends */
    double size;   /* largest distance of a point from the origin */
} CpsiHull;

/* The hull of `count` points (count, n). *out is NULL when memory does not suffice. `known` is
 * false where the dimension is above 3 or rounding prevents the determination of the facets. */
CpsiHull *cpsi_hull_new(int n, int count, const double *points, bool *known);
void cpsi_hull_free(CpsiHull *hull);

/* The nearest point of the hull. */
void cpsi_hull_project(const CpsiHull *hull, const double *p, double *nearest);
/* The radius of the largest ball within the affine span round a point of it; negative outside. */
double cpsi_hull_margin(const CpsiHull *hull, const double *p);
/* The point of the segment between two points that is nearest to p. */
void cpsi_nearest_on_segment(int n, const double *from, const double *to, const double *p,
                             double *nearest);

/* The smallest t with p in t hull, for a hull that contains 0. */
double cpsi_hull_gauge(const CpsiHull *hull, const double *p);

/* ---- the two algorithms, in coordinates c (count, d) of the span ---- */

/* Corners of the planar hull, counterclockwise, as indices in `corner` (count). Returns their
 * number. The monotone chain (Andrew 1979), n log n. `order` (count) is scratch. */
int cpsi_polygon(int count, const double *c, double size, int *order, int *corner);

/* A triangle of a hull in space, counterclockwise as seen from outside. */
typedef struct CpsiTriangle {
    int corner[3], neighbour[3]; /* neighbour k is adjacent at the edge from corner k to the next */
    double normal[3], offset;
    int first, farthest; /* list of the points outside it; -1: none */
    double distance;     /* distance of the farthest one */
    bool gone, visible;
} CpsiTriangle;

/* All triangles of the hull of points in space that span it, by Quickhull (Barber, Dobkin and
 * Huhdanpaa 1996); `start` are four of the points. The caller frees *triangles. Returns their
 * number, including deleted ones; 0 when memory does not suffice; -1 where rounding prevents an
 * answer. */
int cpsi_quickhull(int count, const double *c, double size, const int start[4],
                   CpsiTriangle **triangles);

#endif
