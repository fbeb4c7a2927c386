/* SPDX-License-Identifier: BSD-3-Clause */
/* `body:` and `vehicle:` of a file of driven systems: patches or wheels, what is pushed, and a tow. */
#include <math.h>
#include <string.h>

#include "io/read/drive_file.h"
#include "io/read/path_points.h"

/* ---- patches ---- */

static CpsStatus read_brake(CpsiDriveRead *r, const CpsiYaml *node, double *brake) {
    if (node->kind == CPSI_YAML_SCALAR && strcmp(node->text, "locked") == 0) return *brake = INFINITY, CPS_OK;
    double x = NAN;
    if (node->kind == CPSI_YAML_SCALAR && node->plain && cpsi_yaml_number(node->text, &x) && x >= 0 && x <= 1e100)
        return *brake = x, CPS_OK;
    return cpsi_drive_wrong(r, node, "'brake'", "a torque of at least 0 in N m, or 'locked'");
}

/* the corners, law or brake of a patch whose numbers are read */
static CpsStatus read_parts(CpsiDriveRead *r, const CpsiYaml *node, const CpsiPatchKeys *keys, CpsPatch *patch) {
    static const char NEEDS[] = "'friction' and 'load', or 'law' without them";
    CpsStatus status = CPS_OK;
    if (keys->brake) status = read_brake(r, keys->brake, &patch->brake);
    if (status == CPS_OK && keys->corners)
        status = cpsi_drive_rows(r, keys->corners, "'corners'", 2, 3, &patch->corner_count, &patch->corner);
    CpsLaw *own = NULL;
    if (status == CPS_OK && keys->law) status = cpsi_drive_law(r, keys->law, &own);
    patch->law = own;
    const bool load = !isnan(patch->load), friction = !isnan(patch->friction);
    if (status == CPS_OK && (keys->law ? load || friction : !load || !friction))
        return cpsi_drive_wrong(r, node, "'point'", NEEDS);
    if (keys->law) patch->load = patch->friction = 0;
    return status;
}

static CpsStatus read_patch(CpsiDriveRead *r, const CpsiYaml *node, CpsPatchKind kind, CpsPatch *patch) {
    CpsiPatchKeys keys = {.patch = {.kind = kind}};
    /* not given, unless they are read; every other kind needs them */
    if (kind == CPS_PATCH_POINT) keys.patch.friction = keys.patch.load = NAN;
    const CpsStatus status = cpsi_drive_fields(r, node, (CpsiDriveMapping)(CPSI_DRIVE_PATCH + (int)kind), &keys);
    *patch = keys.patch;
    return status ? status : read_parts(r, node, &keys, patch);
}

/* {KIND: {..}} */
static CpsStatus read_kind(CpsiDriveRead *r, const CpsiYaml *node, CpsPatch *patch) {
    if (node->kind == CPSI_YAML_MAPPING && node->count == 1)
        for (int k = CPS_PATCH_POINT; k <= CPS_PATCH_POLYGON; k++)
            if (strcmp(node->child->key, cpsi_drive_word((CpsiDriveMapping)(CPSI_DRIVE_PATCH + k))->alias) == 0)
                return read_patch(r, node->child, (CpsPatchKind)k, patch);
    return cpsi_drive_wrong(r, node, "patch",
                            "one of point, wheel, rod, ring, disc, polygon with its keys, as in "
                            "{disc: {radius: 1, friction: 0.5, load: 10}}");
}

/* A patch that the library rejects is reported at its own line. */
static CpsStatus check_patch(CpsiDriveRead *r, const CpsiYaml *node, const CpsPatch *patch) {
    CpsError found;
    return cps_patch_check(patch, &found) == CPS_OK ? CPS_OK : cpsi_drive_place(r, node, &found);
}

static CpsStatus read_patches(CpsiDriveRead *r, const CpsiYaml *node, bool wheels, CpsDriveBody *out) {
    if (node->kind != CPSI_YAML_SEQUENCE || node->count < 1)
        return cpsi_drive_wrong(r, node, wheels ? "'wheels'" : "'patches'",
                                wheels ? "a list of wheels, as in [{radius: 0.3, friction: 0.8, load: 4000}]"
                                       : "a list of patches, as in [{disc: {radius: 1, friction: 0.5, load: 10}}]");
    CpsPatch *patch = CPSI_POOL_TAKE(r->build.file.pool, node->count, CpsPatch);
    if (!patch) return cpsi_drive_no_memory(r);
    CpsStatus status = CPS_OK;
    out->patch = patch;
    for (const CpsiYaml *item = node->child; item && status == CPS_OK; item = item->next) {
        CpsPatch *next = &patch[out->patches++];
        status = wheels ? read_patch(r, item, CPS_PATCH_WHEEL, next) : read_kind(r, item, next);
        if (status == CPS_OK) status = check_patch(r, item, next);
    }
    CpsError found;
    if (status == CPS_OK && cps_planar_create(out->patches, patch, &out->planar, &found) != CPS_OK)
        status = cpsi_drive_place(r, node, &found);
    return status;
}

/* ---- pushes ---- */

/* the rows of the velocity of a point in body axes, (1, 0, -y) and (0, 1, x), along `normal` or both */
static void point_rows(const double at[2], const double *normal, CpsDrivePush *push) {
    const double row[2][3] = {{1, 0, -at[1]}, {0, 1, at[0]}};
    for (int k = 0; k < 3; k++) {
        if (normal)
            push->map[k] = normal[0] * row[0][k] + normal[1] * row[1][k];
        else
            push->map[k] = row[0][k], push->map[3 + k] = row[1][k];
    }
}

static CpsStatus read_push(CpsiDriveRead *r, const CpsiYaml *node, CpsDrivePush *push) {
    CpsiPushKeys keys = {.at = {NAN}, .velocity = {NAN}, .normal = {NAN}, .speed = NAN, .twist = {NAN}};
    const CpsStatus status = cpsi_drive_fields(r, node, CPSI_DRIVE_PUSH, &keys);
    if (status != CPS_OK) return status;
    const double *at = keys.at, *velocity = keys.velocity, *twist = keys.twist, speed = keys.speed;
    double *normal = keys.normal;
    const bool has_at = !isnan(at[0]), both = !isnan(velocity[0]), one = !isnan(normal[0]) && !isnan(speed);
    const bool partial = isnan(normal[0]) != isnan(speed);
    *push = (CpsDrivePush){.at_point = has_at, .point = {at[0], at[1]}};
    if (!isnan(twist[0]) && !has_at && !both && !one && !partial) {
        push->rows = 3;
        push->map[0] = push->map[4] = push->map[8] = 1;
        memcpy(push->velocity, twist, sizeof keys.twist);
        return CPS_OK;
    }
    if (!isnan(twist[0]) || !has_at || both == one || partial)
        return cpsi_drive_wrong(r, node, "push", "{at, velocity}, {at, normal, speed} or {twist}");
    const double length = hypot(normal[0], normal[1]);
    if (one && !(length > 0)) return cpsi_drive_wrong(r, node, "push", "a 'normal' that is not 0");
    if (one) normal[0] /= length, normal[1] /= length;
    point_rows(at, one ? normal : NULL, push);
    push->rows = one ? 1 : 2;
    for (int k = 0; k < 2; k++) push->way[k] = one ? speed * normal[k] : velocity[k];
    push->velocity[0] = one ? speed : velocity[0], push->velocity[1] = one ? 0 : velocity[1];
    return CPS_OK;
}

static CpsStatus read_pushes(CpsiDriveRead *r, const CpsiYaml *node, CpsDriveBody *out) {
    if (node->kind != CPSI_YAML_SEQUENCE || node->count < 1)
        return cpsi_drive_wrong(r, node, "'push'", "a list of pushes, as in [{at: [1, 0], velocity: [0, 1]}]");
    CpsDrivePush *push = CPSI_POOL_TAKE(r->build.file.pool, node->count, CpsDrivePush);
    if (!push) return cpsi_drive_no_memory(r);
    CpsStatus status = CPS_OK;
    out->push = push;
    for (const CpsiYaml *item = node->child; item && status == CPS_OK; item = item->next)
        status = read_push(r, item, &push[out->pushes++]);
    return status;
}

/* ---- tow ---- */

static CpsStatus read_tow(CpsiDriveRead *r, const CpsiYaml *node, CpsDriveTow *out) {
    CpsiTowKeys keys = {.end = {NAN}};
    CpsStatus status = cpsi_drive_fields(r, node, CPSI_DRIVE_TOW, &keys);
    if (status != CPS_OK) return status;
    out->start = keys.start, out->steps = keys.steps;
    CpsTow *tow = &out->start;
    const double *end = keys.end;
    const double c = cos(tow->pose[2]), s = sin(tow->pose[2]);
    const double hitch[2] = {tow->pose[0] + c * tow->hitch[0] - s * tow->hitch[1],
                             tow->pose[1] + s * tow->hitch[0] + c * tow->hitch[1]};
    if ((tow->rope > 0) != !isnan(end[0]))
        return cpsi_drive_wrong(r, node, "tow", "'rope' (its length) and 'end' (where its far end is) together or not");
    if (tow->rope > 0 && !(hypot(end[0] - hitch[0], end[1] - hitch[1]) <= tow->rope * (1 + 1e-9)))
        return cpsi_drive_wrong(r, node, "tow", "an 'end' no farther from the hitch than the rope is long");
    memcpy(tow->end, tow->rope > 0 ? end : hitch, sizeof tow->end);
    status = cpsi_drive_read_path(r, keys.path, 2, tow->end, out->steps, &out->points, &out->path);
    return status;
}

/* ---- together ---- */

static CpsStatus read_whole(CpsiDriveRead *r, const CpsiYaml *node, bool vehicle, CpsDriveBody *out) {
    CpsiBodyKeys keys = {.patches = NULL};
    out->vehicle = vehicle;
    CpsStatus status = cpsi_drive_fields(r, node, vehicle ? CPSI_DRIVE_VEHICLE : CPSI_DRIVE_BODY, &keys);
    if (status == CPS_OK) status = read_patches(r, keys.patches, vehicle, out);
    if (status == CPS_OK && keys.push) status = read_pushes(r, keys.push, out);
    if (status == CPS_OK && keys.tow) status = read_tow(r, keys.tow, &out->tow);
    return status;
}

CpsStatus cpsi_drive_read_body(CpsiDriveRead *r, const CpsiYaml *node, CpsDriveBody *out) {
    return read_whole(r, node, false, out);
}

CpsStatus cpsi_drive_read_vehicle(CpsiDriveRead *r, const CpsiYaml *node, CpsDriveBody *out) {
    return read_whole(r, node, true, out);
}
