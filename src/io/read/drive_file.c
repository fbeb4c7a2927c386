/* SPDX-License-Identifier: BSD-3-Clause */
/* Read a file of driven systems: bytes -> tree (yaml.h) -> the kind that its key names. */
#include "io/read/drive_file.h"

#include <locale.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "io/base/read_file.h"
#include "io/schema/file_kind.h"

/* The file and what its texts and arrays live in. */
typedef struct Keep {
    CpsDriveFile file;
    CpsiPool pool;
} Keep;

void cps_drive_file_destroy(CpsDriveFile *file) {
    if (!file) return;
    Keep *keep = (Keep *)file;
    cps_system_destroy(file->system.system);
    cps_planar_destroy(file->body.planar);
    for (int i = 0; i < file->body.patches; i++) cps_law_destroy((CpsLaw *)file->body.patch[i].law);
    cps_law_destroy((CpsLaw *)file->sweep.law);
    cpsi_pool_free(&keep->pool);
    free(keep);
}

static CpsStatus read_kind(CpsiDriveRead *r, const CpsiYaml *root, CpsDriveFile *out) {
    enum { SYSTEM, BODY, VEHICLE, PLANIMETER, ROPE, SWEEP, KINDS };
    CpsiFileKeys keys = {.title = ""};
    static const CpsDriveKind KIND[KINDS] = {CPS_DRIVE_SYSTEM,     CPS_DRIVE_BODY, CPS_DRIVE_BODY,
                                             CPS_DRIVE_PLANIMETER, CPS_DRIVE_ROPE, CPS_DRIVE_SWEEP};
    const CpsiLawFile *f = &r->build.file;
    const CpsStatus status = cpsi_drive_fields(r, root, CPSI_DRIVE_FILE, &keys);
    if (status != CPS_OK) return status;
    out->title = keys.title;
    const CpsiYaml *const kind[KINDS] = {keys.system, keys.body, keys.vehicle, keys.planimeter, keys.rope, keys.sweep};
    int given = 0, which = 0;
    for (int k = 0; k < KINDS; k++)
        if (kind[k]) given++, which = k;
    if (given != 1)
        return cpsi_fail_at(f->err, CPS_ERR_INPUT, f->name, root->line, root->column,
                            "drive file: %s given, expected exactly one of 'system', 'body', 'vehicle', 'planimeter', "
                            "'rope', 'sweep'",
                            given ? "more than one" : "none");
    out->kind = KIND[which];
    switch (which) {
    case SYSTEM:
        return cpsi_drive_read_system(r, kind[which], &out->system);
    case BODY:
        return cpsi_drive_read_body(r, kind[which], &out->body);
    case VEHICLE:
        return cpsi_drive_read_vehicle(r, kind[which], &out->body);
    case PLANIMETER:
        return cpsi_drive_read_planimeter(r, kind[which], &out->planimeter);
    case ROPE:
        return cpsi_drive_read_rope(r, kind[which], &out->rope);
    default:
        return cpsi_drive_read_sweep(r, kind[which], &out->sweep);
    }
}

static CpsStatus read_drive(const char *path, const CpsReadLimits *limits, Keep *keep, CpsError *err) {
    const char *name = strcmp(path, "-") == 0 ? "standard input" : path;
    char *bytes = NULL;
    size_t size = 0;
    CpsiYaml *root = NULL;
    CpsStatus status = cpsi_read_file(path, name, limits->max_bytes, &bytes, &size, err);
    if (status == CPS_OK)
        status = cpsi_yaml_parse(name, "driven system", bytes, size, limits->max_depth, &keep->pool, &root, err);
    free(bytes);
    if (status == CPS_OK) status = cpsi_file_expect(name, root, CPSI_FILE_DRIVE, err);
    CpsiDriveRead r = {.build = {.file = {.name = name, .pool = &keep->pool, .err = err}},
                       .path = path,
                       .max_bytes = limits->max_bytes};
    return status ? status : read_kind(&r, root, &keep->file);
}

CpsStatus cps_drive_read(const char *path, const CpsReadLimits *limits, CpsDriveFile **out, CpsError *err) {
    if (!path || !out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "path or out is NULL");
    *out = NULL;
    CpsError unused;
    if (!err) err = &unused;
    const CpsReadLimits defaults = cps_read_limits_default();
    if (!limits) limits = &defaults;
    if (limits->max_depth < 1)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "limits are not positive: start from cps_read_limits_default()");

    /* numbers have a decimal point whatever the program's locale */
    const locale_t numbers = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    Keep *keep = calloc(1, sizeof *keep);
    if (!numbers || !keep) {
        if (numbers) freelocale(numbers);
        free(keep);
        return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    }
    const locale_t before = uselocale(numbers);
    const CpsStatus status = read_drive(path, limits, keep, err);
    uselocale(before);
    freelocale(numbers);
    if (status == CPS_OK)
        *out = &keep->file;
    else
        cps_drive_file_destroy(&keep->file);
    return status;
}
