/* SPDX-License-Identifier: BSD-3-Clause */
/* A ground from the files that a scene names (ground_build.h). What the files hold in memory of
 * their own is freed; the ground has a copy. */
#include "io/read/shapes/ground/ground_build.h"

#include <math.h>

#include "base/status.h"
#include "io/base/file/read_file.h"
#include "io/read/shapes/ground/grid_file.h"

/* [-] Coordinates of two files that differ by less, per length of the axis, are the same. */
static const double SAME = 1e-9;

static CpsStatus read_grid(const CpsiDocument *d, const CpsiObstacleValues *values, const char *key,
                           const char *name, CpsiPool *pool, CpsiGridFile *out) {
    const CpsiYaml *place = cpsi_yaml_child(cpsi_yaml_child(values->node, "ground"), key);
    if (!cpsi_is_beside(name))
        return cpsi_document_fail(
            d, CPS_ERR_INPUT, place,
            "'%s': found '%.64s', expected the name of a file beside this one, without '/'", key,
            name);
    const char *path = cpsi_path_beside(pool, d->name, name);
    if (!path) return cpsi_document_no_memory(d);
    return cpsi_grid_file_read(path, (CpsiGridForm)values->form, values->variable,
                               d->limits->max_bytes, pool, out, d->err);
}

static bool are_same(int count, const double *a, const double *b) {
    const double near = SAME * (a[count - 1] - a[0]);
    for (int i = 0; i < count; i++)
        if (!(fabs(a[i] - b[i]) <= near)) return false;
    return true;
}

/* Does what the file says of its heights agree with the scene? */
static CpsStatus check_heights(const CpsiDocument *d, const CpsiObstacleValues *values,
                               const CpsiGridFile *heights) {
    const CpsiYaml *place = cpsi_yaml_child(cpsi_yaml_child(values->node, "ground"), "file");
    if (heights->units_are_others)
        return cpsi_document_fail(d, CPS_ERR_INPUT, place,
                                  "'file': its units are not metres: convert it");
    if (!(values->are_depths ? heights->is_up : heights->is_down)) return CPS_OK;
    return cpsi_document_fail(d, CPS_ERR_INPUT, place,
                              values->are_depths
                                  ? "'file': its variable is positive upwards: it has no depths"
                                  : "'file': its variable is positive downwards: it has depths, "
                                    "which 'depths: true' is to say");
}

static CpsStatus build(const CpsiDocument *d, const CpsiObstacleValues *values, CpsiPool *pool,
                       CpsGround **out) {
    CpsiGridFile heights = {0}, factors = {0};
    const CpsiYaml *ground = cpsi_yaml_child(values->node, "ground");
    if (values->form != CPSI_GRID_NETCDF && cpsi_yaml_child(ground, "variable"))
        return cpsi_document_fail(d, CPS_ERR_INPUT, cpsi_yaml_child(ground, "variable"),
                                  "'variable': it does not go with this form: leave it out");
    CpsStatus status = read_grid(d, values, "file", values->grid, pool, &heights);
    if (status == CPS_OK) status = check_heights(d, values, &heights);
    if (status == CPS_OK && values->factors)
        status = read_grid(d, values, "friction_factor", values->factors, pool, &factors);
    if (status != CPS_OK) return status;
    if (values->factors &&
        (factors.x_count != heights.x_count || factors.y_count != heights.y_count ||
         !are_same(heights.x_count, heights.x, factors.x) ||
         !are_same(heights.y_count, heights.y, factors.y)))
        return cpsi_document_fail(d, CPS_ERR_INPUT, cpsi_yaml_child(ground, "friction_factor"),
                                  "'friction_factor': found %d x %d points, expected the %d x %d "
                                  "points of 'file'",
                                  factors.x_count, factors.y_count, heights.x_count,
                                  heights.y_count);
    const size_t points = (size_t)heights.x_count * (size_t)heights.y_count;
    if (values->are_depths || values->form == CPSI_GRID_MOORDYN_F)
        for (size_t i = 0; i < points; i++) heights.z[i] = -heights.z[i];
    CpsGroundGrid grid = cps_ground_grid_default();
    grid.x_count = heights.x_count;
    grid.y_count = heights.y_count;
    grid.x = heights.x;
    grid.y = heights.y;
    grid.z = heights.z;
    grid.friction_factor = factors.z;
    grid.extends = values->extends;
    CpsError found = {0};
    status = cps_ground_create(&grid, out, &found);
    if (status == CPS_OK) return CPS_OK;
    return cpsi_document_fail(d, status == CPS_ERR_ARGUMENT ? CPS_ERR_INPUT : status, ground, "%s",
                              found.message);
}

CpsStatus cpsi_ground_build(const CpsiDocument *d, const CpsiObstacleValues *values,
                            CpsGround **out) {
    CpsiPool pool = {0};
    *out = NULL;
    const CpsStatus status = build(d, values, &pool, out);
    cpsi_pool_free(&pool);
    return status;
}
