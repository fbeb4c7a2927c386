/* SPDX-License-Identifier: BSD-3-Clause */
/* Read a file of driven systems: bytes -> tree (yaml.h) -> values by the table of keys
 * (key_reader.h) -> the kind that the key names. */
#include "io/read/drive/drive_file.h"

#include <stdlib.h>

#include "base/status.h"
#include "io/read/key_reader.h"

/* The file and the memory of its texts and arrays. */
typedef struct Keep {
    CpsDriveFile file;
    CpsiPool pool;
} Keep;

void cps_drive_file_destroy(CpsDriveFile *file) {
    if (!file) return;
    Keep *keep = (Keep *)file;
    cps_system_destroy(file->system.system);
    cps_planar_destroy(file->body.planar);
    for (int i = 0; i < file->body.patch_count; i++)
        cps_law_release((CpsLaw *)file->body.patch[i].law);
    cps_law_release((CpsLaw *)file->sweep.law);
    cpsi_pool_free(&keep->pool);
    free(keep);
}

static CpsStatus build_kind(CpsiSetBuild *b, const CpsiDriveValues *values, CpsDriveFile *out) {
    static const CpsDriveKind KIND[] = {
        [CPSI_DRIVE_SYSTEM] = CPS_DRIVE_SYSTEM, [CPSI_DRIVE_BODY] = CPS_DRIVE_BODY,
        [CPSI_DRIVE_VEHICLE] = CPS_DRIVE_BODY,  [CPSI_DRIVE_PLANIMETER] = CPS_DRIVE_PLANIMETER,
        [CPSI_DRIVE_ROPE] = CPS_DRIVE_ROPE,     [CPSI_DRIVE_SWEEP] = CPS_DRIVE_SWEEP,
    };
    out->title = values->title;
    out->kind = KIND[values->kind];
    switch ((CpsiDriveKind)values->kind) {
    case CPSI_DRIVE_SYSTEM: return cpsi_build_system(b, &values->system, &out->system);
    case CPSI_DRIVE_BODY: return cpsi_build_body(b, &values->body, false, &out->body);
    case CPSI_DRIVE_VEHICLE: return cpsi_build_body(b, &values->vehicle, true, &out->body);
    case CPSI_DRIVE_PLANIMETER:
        return cpsi_build_planimeter(b, &values->planimeter, &out->planimeter);
    case CPSI_DRIVE_ROPE: return cpsi_build_rope(b, &values->rope, &out->rope);
    default: return cpsi_build_sweep(b, &values->sweep, &out->sweep);
    }
}

static CpsStatus build(const CpsiDocument *d, void *out) {
    CpsiSetBuild b = {.d = d};
    CpsiDriveValues values = {.node = NULL};
    const CpsStatus status =
        cpsi_read_mapping(d, d->root, &cpsi_drive_file, cpsi_drive_file.name, &values);
    return status ? status : build_kind(&b, &values, out);
}

/* from the file at `path`, or from `text` */
static CpsStatus read_drive(const char *path, const char *text, const CpsReadLimits *limits,
                            CpsDriveFile **out, CpsError *err) {
    *out = NULL;
    CpsError unused;
    if (!err) err = &unused;
    Keep *keep = calloc(1, sizeof *keep);
    if (!keep) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    const CpsStatus status = cpsi_document_read(path, text, limits, CPSI_FILE_DRIVE, &keep->pool,
                                                build, &keep->file, err);
    if (status == CPS_OK)
        *out = &keep->file;
    else
        cps_drive_file_destroy(&keep->file);
    return status;
}

CpsStatus cps_drive_read(const char *path, const CpsReadLimits *limits, CpsDriveFile **out,
                         CpsError *err) {
    if (!path || !out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "path or out is NULL");
    return read_drive(path, NULL, limits, out, err);
}

CpsStatus cps_drive_read_text(const char *text, const char *name, const CpsReadLimits *limits,
                              CpsDriveFile **out, CpsError *err) {
    if (!text || !name || !out)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "text, name or out is NULL");
    return read_drive(name, text, limits, out, err);
}
