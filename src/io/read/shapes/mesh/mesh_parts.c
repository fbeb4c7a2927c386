/* SPDX-License-Identifier: BSD-3-Clause */
/* Memory for the triangles of a file (mesh_parts.h). */
#include "io/read/shapes/mesh/mesh_parts.h"

#include "capstan/mesh.h"
#include "io/base/yaml/yaml.h"

CpsStatus cpsi_mesh_allocate(const CpsiGridText *text, size_t vertices, size_t triangles,
                             CpsiMeshFile *out) {
    if (vertices > CPS_MAX_MESH_VERTICES || triangles > CPS_MAX_MESH_TRIANGLES)
        return cpsi_fail_at(text->err, CPS_ERR_LIMIT, text->path, 0, 0,
                            "%zu triangles with %zu vertices, the limits are %d and %d: simplify "
                            "the mesh",
                            triangles, vertices, CPS_MAX_MESH_TRIANGLES, CPS_MAX_MESH_VERTICES);
    out->vertex = CPSI_POOL_TAKE(text->pool, 3 * vertices, double);
    out->triangle = CPSI_POOL_TAKE(text->pool, 3 * triangles, int);
    if (out->vertex && out->triangle) return CPS_OK;
    return cpsi_fail_at(text->err, CPS_ERR_MEMORY, text->path, 0, 0,
                        "out of memory while reading the mesh");
}
