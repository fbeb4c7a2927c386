/* SPDX-License-Identifier: BSD-3-Clause */
/* A triangle mesh (capstan/mesh.h), its tree, and its nearest point (docs/theory.md 2.3). */
#ifndef CAPSTAN_SRC_GEOMETRY_MESH_H
#define CAPSTAN_SRC_GEOMETRY_MESH_H

#include <stdatomic.h>

#include "base/vec3.h"
#include "capstan/mesh.h"

/* A box with its sides along the axes. */
typedef struct CpsiBox {
    double low[3], high[3]; /* [m] */
} CpsiBox;

struct CpsMesh {
    int vertex_count, triangle_count;
    double *vertex; /* (vertex_count, 3) [m] */
    int *triangle;  /* (triangle_count, 3), in the order of the tree's leaves */
    int *neighbour; /* (triangle_count, 3) beyond the edge from corner i to the next; -1: none */
    double *normal; /* (vertex_count, 3) sum of the normals at a vertex, weighted by their
                       angles; 0 at a rim */
    double *range;  /* (triangle_count) [m] over which the surface turns by a radian */
    int depth;      /* of the tree: it has 2^depth leaves */
    CpsiBox *box;   /* (2^(depth + 1) - 1) of node i, whose halves are 2 i + 1 and 2 i + 2 */
    bool two_sided;
    bool has_folds; /* a concave edge, of a sheet with two sides any edge between two planes; or
                       it is not all in one piece: a place may have several feet */
    CpsMeshReport report;
    atomic_int refcount;
};

/* Order the triangles and make the boxes; `box` has memory for its depth. False: no memory. */
bool cpsi_mesh_plant(CpsMesh *mesh);
/* The least depth of a tree for so many triangles. */
int cpsi_mesh_depth(int triangle_count);

Vec3 cpsi_mesh_corner(const CpsMesh *mesh, int triangle, int corner);
/* The unit normal of a triangle. */
Vec3 cpsi_mesh_normal(const CpsMesh *mesh, int triangle);

/* Which part of its triangle a foot is on: the face, edge i from corner i to the next, corner i. */
typedef enum CpsiMeshPart {
    CPSI_MESH_FACE,
    CPSI_MESH_EDGE,      /* + i */
    CPSI_MESH_CORNER = 4 /* + i */
} CpsiMeshPart;

/* The nearest point of the triangles. */
typedef struct CpsiMeshFoot {
    int triangle, part; /* part: CpsiMeshPart plus i */
    double distance;    /* [m] negative on the side where lines may not be */
    Vec3 foot, normal;  /* normal: of length 1, towards the free side */
} CpsiMeshFoot;

CpsiMeshFoot cpsi_mesh_nearest(const CpsMesh *mesh, Vec3 x);
/* The nearest point of one triangle; its distance is not negative, and it has no normal. */
CpsiMeshFoot cpsi_mesh_nearest_of(const CpsMesh *mesh, int triangle, Vec3 x);
/* Give such a point the sign of its distance and its normal. */
void cpsi_mesh_orient(const CpsMesh *mesh, Vec3 x, CpsiMeshFoot *at);
/* Call `take` with the nearest point, without sign, of every triangle within a distance. */
void cpsi_mesh_each_within(const CpsMesh *mesh, Vec3 x, double within,
                           void (*take)(void *into, const CpsiMeshFoot *foot), void *into);

/* Several feet (mesh_feet.c). */

/* Set has_folds; `scratch` has memory for 2 triangle_count numbers. */
void cpsi_mesh_find_folds(CpsMesh *mesh, int *scratch);
/* The nearest foot of x and, if x is on the free side, the other points of the triangles that are
 * the nearest of those around them, up to a distance; at most `most`, the nearest first. Where x is
 * behind a concave edge or corner they are its feet on the planes of the faces there, the deepest
 * first, and *beyond is set. Returns their number, at least 1. */
int cpsi_mesh_feet(const CpsMesh *mesh, Vec3 x, double within, int most, CpsiMeshFoot out[],
                   bool *beyond);
/* The foot that is reached from a face by going to nearer points of the faces around, but over no
 * concave edge. *beyond: it would go on over one; the foot is that on the plane of the last face.
 */
CpsiMeshFoot cpsi_mesh_foot_from(const CpsMesh *mesh, int face, Vec3 x, bool *beyond);

#endif
