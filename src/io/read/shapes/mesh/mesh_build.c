/* SPDX-License-Identifier: BSD-3-Clause */
/* A mesh from the file that a scene names (mesh_build.h). What the file holds in memory of its own
 * is freed; the mesh has a copy. */
#include "io/read/shapes/mesh/mesh_build.h"

#include "base/status.h"
#include "io/base/file/read_file.h"
#include "io/read/shapes/mesh/mesh_file.h"

static void place(const CpsiObstacleValues *values, Rotation turn, CpsiMeshFile *file) {
    const bool turns = turn.x != 0 || turn.y != 0 || turn.z != 0;
    for (size_t v = 0; v < (size_t)file->vertex_count; v++) {
        const Vec3 x = vec3_scale(values->scale, vec3_load(&file->vertex[3 * v]));
        vec3_store(&file->vertex[3 * v], turns ? rotation_apply(turn, x) : x);
    }
}

static CpsStatus build(const CpsiDocument *d, const CpsiObstacleValues *values, Rotation turn,
                       CpsiPool *pool, CpsMesh **out) {
    const CpsiYaml *mesh = cpsi_yaml_child(values->node, "mesh");
    if (!cpsi_is_beside(values->triangles))
        return cpsi_document_fail(
            d, CPS_ERR_INPUT, cpsi_yaml_child(mesh, "file"),
            "'file': found '%.64s', expected the name of a file beside this one, without '/'",
            values->triangles);
    const char *path = cpsi_path_beside(pool, d->name, values->triangles);
    if (!path) return cpsi_document_no_memory(d);
    CpsiMeshFile file;
    CpsStatus status = cpsi_mesh_file_read(path, (CpsiMeshForm)values->mesh_form,
                                           d->limits->max_bytes, pool, &file, d->err);
    if (status != CPS_OK) return status;
    place(values, turn, &file);
    CpsMeshTriangles triangles = cps_mesh_triangles_default();
    triangles.vertex_count = file.vertex_count;
    triangles.vertex = file.vertex;
    triangles.triangle_count = file.triangle_count;
    triangles.triangle = file.triangle;
    triangles.two_sided = values->two_sided;
    CpsError found = {0};
    status = cps_mesh_create(&triangles, out, &found);
    if (status == CPS_OK) return CPS_OK;
    return cpsi_fail_at(d->err, status == CPS_ERR_ARGUMENT ? CPS_ERR_INPUT : status, path, 0, 0,
                        "%s", found.message);
}

CpsStatus cpsi_mesh_build(const CpsiDocument *d, const CpsiObstacleValues *values, Rotation turn,
                          CpsMesh **out) {
    CpsiPool pool = {0};
    *out = NULL;
    const CpsStatus status = build(d, values, turn, &pool, out);
    cpsi_pool_free(&pool);
    return status;
}
