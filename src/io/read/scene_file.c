/* SPDX-License-Identifier: BSD-3-Clause */
/* Read a scene file: bytes -> tree (yaml.h) -> validated by the table of keys (validate.h) -> structs
 * (scene_build.h) -> cps_scene_check. */
#include <locale.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "capstan/io.h"
#include "io/base/read_file.h"
#include "io/schema/file_kind.h"
#include "io/read/scene_build.h"
#include "io/schema/validate.h"

struct CpsSceneFile {
    CpsScene scene;
    CpsiPool pool; /* all that the scene points to, but for the friction sets, which are held */
};

CpsReadLimits cps_read_limits_default(void) {
    return (CpsReadLimits){
        .max_bytes = (size_t)64 << 20, .max_depth = 64, .max_elements = 10000000, .max_steps = 1000000};
}

void cps_scene_file_destroy(CpsSceneFile *file) {
    if (!file) return;
    for (int k = 0; k < file->scene.obstacle_count; k++)
        cps_set_release((CpsSet *)file->scene.obstacle[k].friction_set);
    cpsi_pool_free(&file->pool);
    free(file);
}

const CpsScene *cps_scene_file_scene(const CpsSceneFile *file) { return &file->scene; }

static CpsStatus check(const char *file, const CpsiYaml *root, const CpsScene *scene, CpsError *err) {
    CpsError found;
    const CpsStatus status = cps_scene_check(scene, &found);
    if (status == CPS_OK) return CPS_OK;
    const CpsiYaml *node = cpsi_yaml_at(root, found.where);
    const CpsStatus input = status == CPS_ERR_ARGUMENT ? CPS_ERR_INPUT : status;
    cpsi_fail_at(err, input, file, node->line, node->column, "%s", found.message);
    return cpsi_fail_inside(err, input, "%s", found.where);
}

static CpsStatus read_scene(const char *path, const CpsReadLimits *limits, CpsSceneFile *scene, CpsError *err) {
    const char *file = strcmp(path, "-") == 0 ? "standard input" : path;
    char *bytes = NULL;
    size_t size = 0;
    CpsiPool tree = {0};
    CpsiYaml *root = NULL;
    CpsStatus status = cpsi_read_file(path, file, limits->max_bytes, &bytes, &size, err);
    if (status == CPS_OK) status = cpsi_yaml_parse(file, "scene", bytes, size, limits->max_depth, &tree, &root, err);
    free(bytes);
    if (status == CPS_OK) status = cpsi_file_expect(file, root, CPSI_FILE_SCENE, err);
    if (status == CPS_OK) status = cpsi_scene_validate(file, root, err);
    if (status == CPS_OK) status = cpsi_scene_build(file, root, limits, &scene->pool, &scene->scene, err);
    if (status == CPS_OK) status = check(file, root, &scene->scene, err);
    cpsi_pool_free(&tree);
    return status;
}

CpsStatus cps_scene_read(const char *path, const CpsReadLimits *limits, CpsSceneFile **out, CpsError *err) {
    if (!path || !out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "path or out is NULL");
    *out = NULL;
    const CpsReadLimits defaults = cps_read_limits_default();
    if (!limits) limits = &defaults;
    if (limits->max_depth < 1 || limits->max_elements < 1 || limits->max_steps < 1)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "limits are not positive: start from cps_read_limits_default()");

    /* numbers have a decimal point whatever the program's locale */
    const locale_t numbers = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    CpsSceneFile *scene = calloc(1, sizeof *scene);
    if (!numbers || !scene) {
        if (numbers) freelocale(numbers);
        free(scene);
        return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    }
    const locale_t before = uselocale(numbers);
    const CpsStatus status = read_scene(path, limits, scene, err);
    uselocale(before);
    freelocale(numbers);
    if (status == CPS_OK)
        *out = scene;
    else
        cps_scene_file_destroy(scene);
    return status;
}
