/* SPDX-License-Identifier: BSD-3-Clause */
/* `body:` and `vehicle:` of a file of driven systems: patches or wheels, pushes, and a tow. */
#include <math.h>
#include <string.h>

#include "base/math.h"
#include "io/read/drive/drive_file.h"
#include "io/read/drive/path_points.h"

/* ---- patches ---- */

/* the law of a point, or its friction and load */
static CpsStatus build_patch(CpsiSetBuild *b, const CpsiPatchValues *values, CpsPatch *patch) {
    CpsLaw *law = NULL;
    *patch = values->patch;
    patch->angle = values->orientation * CPSI_DEGREE;
    if (values->locked == 0) patch->brake = INFINITY;
    patch->corner = values->corners.x;
    patch->corner_count = values->corners.rows;
    const CpsStatus status = values->law ? cpsi_build_law(b, values->law, &law) : CPS_OK;
    patch->law = law;
    const bool load = !isnan(patch->load), friction = !isnan(patch->friction);
    if (status == CPS_OK && (law ? load || friction : !load || !friction))
        return cpsi_document_wrong(b->d, values->node->child, "'point'",
                                   "'friction' and 'load', or 'law' without them");
    if (law) patch->load = patch->friction = 0;
    return status;
}

/* A patch that the library rejects is reported at its own line. */
static CpsStatus check_patch(const CpsiDocument *d, const CpsiYaml *node, const CpsPatch *patch) {
    CpsError found;
    return cps_patch_check(patch, &found) == CPS_OK ? CPS_OK : cpsi_document_place(d, node, &found);
}

static CpsStatus build_patches(CpsiSetBuild *b, const CpsiList *list, CpsDriveBody *out) {
    const CpsiPatchValues *values = list->item;
    CpsPatch *patch = CPSI_POOL_TAKE(b->d->pool, list->count, CpsPatch);
    if (!patch) return cpsi_document_no_memory(b->d);
    CpsStatus status = CPS_OK;
    out->patch = patch;
    for (int i = 0; i < list->count && status == CPS_OK; i++) {
        out->patch_count++;
        status = build_patch(b, &values[i], &patch[i]);
        if (out->vehicle) patch[i].kind = CPS_PATCH_WHEEL;
        if (status == CPS_OK) status = check_patch(b->d, values[i].node, &patch[i]);
    }
    CpsError found;
    if (status == CPS_OK &&
        cps_planar_create(out->patch_count, patch, &out->planar, &found) != CPS_OK)
        status = cpsi_document_place(b->d, list->node, &found);
    return status;
}

/* ---- pushes ---- */

/* the rows for the velocity of a point in body axes, (1, 0, -y) and (0, 1, x), along `normal` or
 * both */
static void point_rows(const double at[2], const double *normal, CpsDrivePush *push) {
    const double row[2][3] = {{1, 0, -at[1]}, {0, 1, at[0]}};
    for (int k = 0; k < 3; k++) {
        push->map[k] = normal ? normal[0] * row[0][k] + normal[1] * row[1][k] : row[0][k];
        if (!normal) push->map[3 + k] = row[1][k];
    }
}

static CpsStatus build_push(const CpsiDocument *d, const CpsiPushValues *values,
                            CpsDrivePush *push) {
    const double *at = values->at, *velocity = values->velocity, speed = values->speed;
    double normal[2] = {values->normal[0], values->normal[1]};
    const bool has_at = !isnan(at[0]), both = !isnan(velocity[0]), turn = !isnan(values->twist[0]);
    const bool one = !isnan(normal[0]) && !isnan(speed), partial = isnan(normal[0]) != isnan(speed);
    *push = (CpsDrivePush){.at_point = has_at, .point = {at[0], at[1]}};
    if (turn && !has_at && !both && !one && !partial) {
        push->row_count = 3;
        push->map[0] = push->map[4] = push->map[8] = 1;
        memcpy(push->velocity, values->twist, sizeof values->twist);
        return CPS_OK;
    }
    if (turn || !has_at || both == one || partial)
        return cpsi_document_wrong(d, values->node, "push",
                                   "{at, velocity}, {at, normal, speed} or {twist}");
    const double length = hypot(normal[0], normal[1]);
    if (one && !(length > 0))
        return cpsi_document_wrong(d, values->node, "push", "a 'normal' that is not 0");
    if (one)
        for (int k = 0; k < 2; k++) normal[k] /= length;
    point_rows(at, one ? normal : NULL, push);
    push->row_count = one ? 1 : 2;
    for (int k = 0; k < 2; k++) push->point_velocity[k] = one ? speed * normal[k] : velocity[k];
    push->velocity[0] = one ? speed : velocity[0];
    push->velocity[1] = one ? 0 : velocity[1];
    return CPS_OK;
}

static CpsStatus build_pushes(const CpsiDocument *d, const CpsiList *list, CpsDriveBody *out) {
    const CpsiPushValues *values = list->item;
    CpsDrivePush *push = CPSI_POOL_TAKE(d->pool, list->count, CpsDrivePush);
    if (!push) return cpsi_document_no_memory(d);
    CpsStatus status = CPS_OK;
    out->push = push;
    out->push_count = list->count;
    for (int i = 0; i < list->count && status == CPS_OK; i++)
        status = build_push(d, &values[i], &push[i]);
    return status;
}

/* ---- tow ---- */

static CpsStatus build_tow(const CpsiDocument *d, const CpsiTowValues *values, CpsDriveTow *out) {
    out->start = values->start;
    out->step_count = values->steps;
    CpsTow *tow = &out->start;
    memcpy(tow->pose, values->position, sizeof values->position);
    tow->pose[2] = values->orientation * CPSI_DEGREE;
    const double *end = values->end;
    const double c = cos(tow->pose[2]), s = sin(tow->pose[2]);
    const double hitch[2] = {tow->pose[0] + c * tow->hitch[0] - s * tow->hitch[1],
                             tow->pose[1] + s * tow->hitch[0] + c * tow->hitch[1]};
    if ((tow->rope > 0) != !isnan(end[0]))
        return cpsi_document_wrong(
            d, values->node, "'tow'",
            "'rope' (its length) and 'end' (where its far end is) together or not");
    if (tow->rope > 0 && !(hypot(end[0] - hitch[0], end[1] - hitch[1]) <= tow->rope * (1 + 1e-9)))
        return cpsi_document_wrong(d, values->node, "'tow'",
                                   "an 'end' no farther from the hitch than the rope is long");
    memcpy(tow->end, tow->rope > 0 ? end : hitch, sizeof tow->end);
    return cpsi_build_path(d, &values->path, 2, tow->end, out->step_count, &out->point_count,
                           &out->path);
}

CpsStatus cpsi_build_body(CpsiSetBuild *b, const CpsiBodyValues *values, bool vehicle,
                          CpsDriveBody *out) {
    out->vehicle = vehicle;
    CpsStatus status = build_patches(b, &values->patches, out);
    if (status == CPS_OK && values->pushes.node) status = build_pushes(b->d, &values->pushes, out);
    if (status == CPS_OK && values->tow.node) status = build_tow(b->d, &values->tow, &out->tow);
    return status;
}
