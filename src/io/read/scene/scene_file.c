/* SPDX-License-Identifier: BSD-3-Clause */
/* Read a scene file: bytes -> tree (yaml.h) -> values by the table of keys (key_reader.h) ->
 * structs (scene_build.h) -> cps_scene_check; then lengths for pretensions and floats. */
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "capstan/io.h"
#include "io/read/document.h"
#include "io/read/key_reader.h"
#include "io/read/scene/scene_build.h"

struct CpsSceneFile {
    CpsScene scene;
    /* memory of everything that the scene refers to, except sets and ground, which are
     * retained */
    CpsiPool pool;
};

void cps_scene_file_destroy(CpsSceneFile *file) {
    if (!file) return;
    for (int k = 0; k < file->scene.obstacle_count; k++) {
        cps_set_release((CpsSet *)file->scene.obstacle[k].friction_set);
        cps_ground_release((CpsGround *)file->scene.obstacle[k].ground);
        cps_mesh_release((CpsMesh *)file->scene.obstacle[k].mesh);
    }
    for (int i = 0; i < file->scene.line_count; i++)
        for (int end = 0; end < 2; end++)
            cps_set_release((CpsSet *)file->scene.line[i].constraint[end].set);
    for (int i = 0; i < file->scene.point_count; i++)
        cps_set_release((CpsSet *)file->scene.point[i].constraint.set);
    cpsi_pool_free(&file->pool);
    free(file);
}

const CpsScene *cps_scene_file_scene(const CpsSceneFile *file) {
    return file ? &file->scene : NULL;
}

static CpsStatus check(const CpsiDocument *d, const CpsScene *scene) {
    CpsError found;
    const CpsStatus status = cps_scene_check(scene, &found);
    if (status == CPS_OK) return CPS_OK;
    const CpsStatus input = status == CPS_ERR_ARGUMENT ? CPS_ERR_INPUT : status;
    cpsi_document_fail(d, input, cpsi_yaml_at(d->root, found.where), "%s", found.message);
    return cpsi_fail_inside(d->err, input, "%s", found.where);
}

static CpsStatus build(const CpsiDocument *d, void *out) {
    CpsSceneFile *file = out;
    CpsiSceneValues values = {.node = NULL};
    CpsStatus status =
        cpsi_read_mapping(d, d->root, &cpsi_scene_file, cpsi_scene_file.name, &values);
    if (status == CPS_OK) status = cpsi_scene_build(d, &values, &file->pool, &file->scene);
    if (status == CPS_OK) status = check(d, &file->scene);
    const CpsLine *as_written = file->scene.line;
    if (status == CPS_OK) status = cpsi_scene_find_lengths(d, &values, &file->pool, &file->scene);
    if (status == CPS_OK) status = cpsi_scene_split_floats(d, &values, &file->pool, &file->scene);
    if (status != CPS_OK || file->scene.line == as_written) return status;
    return check(d, &file->scene);
}

/* from the file at `path`, or from `text` */
static CpsStatus read_scene(const char *path, const char *text, const CpsReadLimits *limits,
                            CpsSceneFile **out, CpsError *err) {
    *out = NULL;
    CpsiPool tree = {0};
    CpsSceneFile *file = calloc(1, sizeof *file);
    if (!file) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    const CpsStatus status =
        cpsi_document_read(path, text, limits, CPSI_FILE_SCENE, &tree, build, file, err);
    cpsi_pool_free(&tree);
    if (status == CPS_OK)
        *out = file;
    else
        cps_scene_file_destroy(file);
    return status;
}

CpsStatus cps_scene_read(const char *path, const CpsReadLimits *limits, CpsSceneFile **out,
                         CpsError *err) {
    if (!path || !out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "path or out is NULL");
    return read_scene(path, NULL, limits, out, err);
}

CpsStatus cps_scene_read_text(const char *text, const char *name, const CpsReadLimits *limits,
                              CpsSceneFile **out, CpsError *err) {
    if (!text || !name || !out)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "text, name or out is NULL");
    return read_scene(name, text, limits, out, err);
}
