/* SPDX-License-Identifier: BSD-3-Clause */
/* What the forms of meshes share. */
#ifndef CAPSTAN_SRC_IO_READ_SHAPES_MESH_MESH_PARTS_H
#define CAPSTAN_SRC_IO_READ_SHAPES_MESH_MESH_PARTS_H

#include "io/read/shapes/ground/grid_parts.h"

typedef struct CpsiMeshFile {
    int vertex_count, triangle_count;
    double *vertex; /* (vertex_count, 3) as in the file */
    int *triangle;  /* (triangle_count, 3) from 0 */
} CpsiMeshFile;

/* Memory for so many, each within its limit. */
CpsStatus cpsi_mesh_allocate(const CpsiGridText *text, size_t vertices, size_t triangles,
                             CpsiMeshFile *out);

CpsStatus cpsi_mesh_read_stl(CpsiGridText *text, CpsiMeshFile *out);
CpsStatus cpsi_mesh_read_obj(CpsiGridText *text, CpsiMeshFile *out);

#endif
