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
    int pieces;             /* of the boundary: edges of a polygon in their order, triangles */
    double *piece; /* (pieces, dimension, dimension) their corners c; of a segment its two ends */
    double size;   /* largest distance of a point from the origin */
} CpsiHull;

/* The hull of `count` points (count, n). *out NULL: no memory. `known` false: it has a dimension
 * above 3, or rounding does not tell its facets. */
CpsiHull *cpsi_hull_new(int n, int count, const double *points, bool *known);
void cpsi_hull_free(CpsiHull *hull);

/* The nearest point of the hull. */
void cpsi_hull_project(const CpsiHull *hull, const double *p, double *nearest);
/* The radius of the largest ball within the affine span round a point of it, negative outside. */
double cpsi_hull_margin(const CpsiHull *hull, const double *p);
/* The least t with p in t hull, of a hull with 0 in it. */
double cpsi_hull_gauge(const CpsiHull *hull, const double *p);

/* ---- the two algorithms, in coordinates c (count, d) of the span ---- */

/* Corners of the planar hull, counterclockwise: their places in `corner` (count); returns how many.
 * The monotone chain (Andrew 1979), n log n. `order` (count) is scratch. */
int cpsi_polygon(int count, const double *c, double size, int *order, int *corner);

/* A triangle of a hull in space, seen counterclockwise from outside. */
typedef struct CpsiTriangle {
    int corner[3], neighbour[3]; /* neighbour k lies beyond the edge from corner k to the next */
    double normal[3], offset;
    int first, farthest; /* points outside it, as a list; -1: none */
    double distance;     /* of the farthest */
    bool gone, visible;
} CpsiTriangle;

/* All triangles of the hull of points in space that span it, by Quickhull (Barber, Dobkin and
 * Huhdanpaa 1996); start: four of them. *triangles is the caller's to free; returns how many, gone
 * ones among them, 0: no memory, -1: rounding decides. */
int cpsi_quickhull(int count, const double *c, double size, const int start[4],
                   CpsiTriangle **triangles);

#endif
