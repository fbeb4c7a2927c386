/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/mesh.h: bodies given as triangles: rocks, quays, hulls, scanned ground.
 *
 * An obstacle of the kind CPS_OBSTACLE_MESH (scene.h) is all that is nearer to the triangles than
 * its radius r: convex edges and corners are rounded by r, and faces lie r above the triangles. A
 * mesh is made once, does not change, and may be shared by obstacles, scenes and threads. */
#ifndef CAPSTAN_MESH_H
#define CAPSTAN_MESH_H

#include <stdbool.h>
#include <stddef.h>

#include "capstan/base.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct CpsMesh CpsMesh;

enum { CPS_MAX_MESH_VERTICES = 60000000, CPS_MAX_MESH_TRIANGLES = 20000000 };

/* The triangles of a mesh. Begin with cps_mesh_triangles_default(). Vertices with the same
 * coordinates are one. Triangles with two corners in one place, and those that are there already,
 * are left out; one whose corners lie on one line is refused. */
typedef struct CpsMeshTriangles {
    uint32_t cookie;
    int vertex_count;     /* 3..CPS_MAX_MESH_VERTICES */
    const double *vertex; /* (vertex_count, 3) [m] relative to the point of the obstacle */
    int triangle_count;   /* 1..CPS_MAX_MESH_TRIANGLES */
    const int *triangle;  /* (triangle_count, 3) indices of vertices */
    /* false, the default: lines stay on the side from which the corners of a triangle are seen
     * counter-clockwise: outside a closed body, inside one whose triangles face inwards, above open
     * ground. At most two triangles meet at an edge, turned alike. At the rim of an open mesh lines
     * may go round; on its back the body has no end. true: the triangles are a sheet with two free
     * sides, 2 r thick; they may be turned at will. */
    bool two_sided;
} CpsMeshTriangles;

CPS_API CpsMeshTriangles cps_mesh_triangles_default(void);

/* Make a mesh of triangles, which are copied.
 *
 *   out   with one reference, which the caller releases; NULL on failure
 *
 * Returns CPS_OK, CPS_ERR_ARGUMENT, CPS_ERR_LIMIT or CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_mesh_create(const CpsMeshTriangles *triangles, CpsMesh **out, CpsError *err);
CPS_API CpsMesh *cps_mesh_retain(const CpsMesh *mesh); /* NULL is accepted */
CPS_API void cps_mesh_release(CpsMesh *mesh);          /* NULL is accepted */

/* The triangles that it consists of, in an order of its own; the arrays belong to the mesh. */
CPS_API CpsMeshTriangles cps_mesh_triangles(const CpsMesh *mesh);

typedef struct CpsMeshReport {
    int left_out_count; /* triangles that were given and are not there, see above */
    int rim_count;      /* edges with one triangle; 0: the mesh is closed */
    double volume; /* [m3] inside a closed mesh; negative: its triangles face inwards; else 0 */
    double low[3], high[3]; /* [m] range of the coordinates */
    size_t bytes;           /* of memory */
} CpsMeshReport;

CPS_API CpsMeshReport cps_mesh_report(const CpsMesh *mesh);

/* [m] Distance of a place x [m] from the triangles, negative on the side where lines may not be;
 * foot [m] the nearest of their points, may be NULL. */
CPS_API double cps_mesh_distance(const CpsMesh *mesh, const double x[3], double foot[3]);

#ifdef __cplusplus
}
#endif
#endif
