/* SPDX-License-Identifier: BSD-3-Clause */
/* Read a file of driven systems: bytes -> tree (yaml.h) -> the kind that its key names. */
#include "io/read/drive_file.h"

#include <stdlib.h>

#include "base/status.h"
#include "io/read/document.h"

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

static CpsStatus build(const CpsiDocument *d, void *out) {
    CpsiDriveRead r = {.build = {.file = {.name = d->name, .pool = d->pool, .err = d->err}},
                       .path = d->path,
                       .max_bytes = d->limits->max_bytes};
    return read_kind(&r, d->root, out);
}

CpsStatus cps_drive_read(const char *path, const CpsReadLimits *limits, CpsDriveFile **out, CpsError *err) {
    if (!path || !out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "path or out is NULL");
    *out = NULL;
    CpsError unused;
    if (!err) err = &unused;
    Keep *keep = calloc(1, sizeof *keep);
    if (!keep) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    const CpsStatus status = cpsi_document_read(path, limits, CPSI_FILE_DRIVE, &keep->pool, build, &keep->file, err);
    if (status == CPS_OK)
        *out = &keep->file;
    else
        cps_drive_file_destroy(&keep->file);
    return status;
}
