/* SPDX-License-Identifier: BSD-3-Clause */
/* Triangle meshes as the checker sees them: read from result.nc, and searched one by one in long
 * double. */
#ifndef CAPSTAN_CHECKER_MESH_H
#define CAPSTAN_CHECKER_MESH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "conic.h"

enum { MESH_KEPT = 64 };

/* A place that was asked for, with its answer. */
typedef struct MeshAnswer {
    bool is_there;
    Real x[3], normal[3], distance;
} MeshAnswer;

/* The nearest point of one triangle, or of several. */
typedef struct MeshNear {
    Real square, foot[3];
    size_t triangle;
    int edge;   /* -1: on the face */
    Real share; /* of the edge */
} MeshNear;

typedef struct Mesh {
    size_t vertices, triangles;
    double *vertex; /* (vertices, 3) */
    int *corner;    /* (triangles, 3) */
    bool *rim;      /* (triangles, 3) is the edge from corner i to the next one of no other? */
    double *ball;   /* (triangles, 4) middle, and a radius that holds the triangle */
    bool two_sided;
    bool has_elements; /* the file has contacts of elements, of which there are third ones */
    MeshNear *near;    /* (triangles) scratch */
    MeshAnswer kept[MESH_KEPT]; /* the last ones, by a hash of the place */
} Mesh;

/* Read the mesh of obstacle k, by its name; NULL, with a line in `log`, where it is not whole. */
Mesh *mesh_read(int nc, size_t k, FILE *log);
void mesh_free(Mesh *mesh);
/* Distance of x from the triangles, negative where lines may not be, and the normal there towards
 * the free side; x in the axes of the mesh. */
Real mesh_distance(Mesh *mesh, const Real *x, Real *normal);

/* A point of the triangles that is the nearest of those around it. */
typedef struct MeshFoot {
    Real distance, normal[3];
} MeshFoot;

enum { MESH_FEET = 12 };

/* The nearest point of the triangles to x and, if x is on the free side, the others from which x is
 * seen there, up to a distance; at most MESH_FEET, in no order but for the first. Returns their
 * number. */
size_t mesh_feet(Mesh *mesh, const Real *x, Real within, MeshFoot out[MESH_FEET]);

/* The contacts of a node by the number of obstacles: two also with one, where the file has second
 * ones, as with a mesh that has concave edges. */
size_t mesh_contacts(int nc, const char *line, size_t obstacles);
/* Is it the index of one of so many obstacles? A second contact may have none, -1, if there is one.
 */
bool mesh_is_index(double index, size_t obstacles, bool second);

/* The name of obstacle k; "" without one. */
void name_of_obstacle(int nc, size_t k, char name[201]);

#endif
