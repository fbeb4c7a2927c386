/* SPDX-License-Identifier: BSD-3-Clause */
/* Read triangles from a file in one of several forms. */
#ifndef CAPSTAN_SRC_IO_READ_SHAPES_MESH_MESH_FILE_H
#define CAPSTAN_SRC_IO_READ_SHAPES_MESH_MESH_FILE_H

#include "io/read/shapes/mesh/mesh_parts.h"

typedef enum CpsiMeshForm {
    CPSI_MESH_STL, /* STL, binary or text: which of them follows from the file */
    CPSI_MESH_OBJ  /* Wavefront OBJ: its vertices and faces; other lines are passed over */
} CpsiMeshForm;

/* Read the file at `path`; the arrays are in the pool. A message of an error has the path, and of a
 * file of text the line and column.
 *
 *   max_bytes  a larger file is refused
 *
 * Returns CPS_OK, CPS_ERR_INPUT, CPS_ERR_IO, CPS_ERR_LIMIT or CPS_ERR_MEMORY. */
CpsStatus cpsi_mesh_file_read(const char *path, CpsiMeshForm form, size_t max_bytes, CpsiPool *pool,
                              CpsiMeshFile *out, CpsError *err);

#endif
