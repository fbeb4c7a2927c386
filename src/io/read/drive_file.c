/* SPDX-License-Identifier: BSD-3-Clause */
/* Read a file of driven systems: bytes -> tree (yaml.h) -> the kind that its key names. */
#include "io/read/drive_file.h"

#include <locale.h>
#include <math.h>
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

void cps_drive_walk(int space, int points, const double *path, int count, double *out) {
    const size_t n = (size_t)space;
    double whole = 0, before = 0, here = 0;
    for (int pass = 0, at = 0; pass < 2; pass++)
        for (int i = 0; i + 1 < points; i++) {
            double length = 0;
            for (size_t k = 0; k < n; k++) {
                const double d = path[((size_t)i + 1) * n + k] - path[(size_t)i * n + k];
                length += d * d;
            }
            length = sqrt(length);
            if (pass == 0) {
                whole += length;
                continue;
            }
            here = before + length;
            /* all that fall on this side, the last point on the last side */
            for (; at < count; at++) {
                const double s = count > 1 ? whole * at / (count - 1) : 0;
                if (s > here && i + 2 < points) break;
                const double t = length > 0 ? fmin((s - before) / length, 1) : 1;
                for (size_t k = 0; k < n; k++)
                    out[(size_t)at * n + k] =
                        t == 1 ? path[((size_t)i + 1) * n + k]
                               : (1 - t) * path[(size_t)i * n + k] + t * path[((size_t)i + 1) * n + k];
            }
            before = here;
        }
}

/* ---- paths ---- */

static CpsStatus read_arc(CpsiDriveRead *r, const CpsiYaml *node, const double *start, int steps, int *points,
                          const double **path) {
    double center[2], turn = 0;
    void *const to[] = {center, &turn};
    const CpsStatus status = cpsi_drive_fields(r, node, CPSI_DRIVE_PATH_ARC, to);
    if (status != CPS_OK) return status;
    if (!(fabs(turn) <= 1000)) return cpsi_drive_wrong(r, node, "'arc'", "a turn of at most 1000 rad");
    /* corners where the steps end */
    const int sides = steps * (steps < CPSI_DRIVE_ARC_SIDES ? 1 + CPSI_DRIVE_ARC_SIDES / steps : 1);
    double *x = CPSI_POOL_TAKE(r->build.file.pool, 2 * ((size_t)sides + 1), double);
    if (!x) return cpsi_drive_no_memory(r);
    const double dx = start[0] - center[0], dy = start[1] - center[1];
    for (int i = 0; i <= sides; i++) {
        const double a = turn * i / sides;
        x[2 * i] = center[0] + cos(a) * dx - sin(a) * dy;
        x[2 * i + 1] = center[1] + sin(a) * dx + cos(a) * dy;
    }
    *points = sides + 1, *path = x;
    return CPS_OK;
}

CpsStatus cpsi_drive_read_path(CpsiDriveRead *r, const CpsiYaml *node, int space, const double *start, int steps,
                               int *points, const double **path) {
    if (node->kind == CPSI_YAML_MAPPING) {
        const CpsiYaml *arc = NULL;
        void *const to[] = {&arc};
        if (space != 2) return cpsi_drive_wrong(r, node, "'path'", "a list of points, as in [[0], [1]]");
        const CpsStatus status = cpsi_drive_fields(r, node, CPSI_DRIVE_PATH, to);
        return status ? status : read_arc(r, arc, start, steps, points, path);
    }
    int rows = 0;
    const double *given = NULL;
    const CpsStatus status = cpsi_drive_rows(r, node, "'path'", space, 1, &rows, &given);
    if (status != CPS_OK) return status;
    double *x = CPSI_POOL_TAKE(r->build.file.pool, ((size_t)rows + 1) * (size_t)space, double);
    if (!x) return cpsi_drive_no_memory(r);
    memcpy(x, start, (size_t)space * sizeof *x);
    memcpy(x + space, given, (size_t)rows * (size_t)space * sizeof *x);
    *points = rows + 1, *path = x;
    return CPS_OK;
}

/* ---- the file ---- */

static CpsStatus read_kind(CpsiDriveRead *r, const CpsiYaml *root, CpsDriveFile *out) {
    int version;
    enum { SYSTEM, BODY, VEHICLE, PLANIMETER, ROPE, SWEEP, KINDS };
    const CpsiYaml *kind[KINDS] = {NULL};
    out->title = "";
    void *const to[] = {&version,       &out->title,       &kind[SYSTEM], &kind[BODY],
                        &kind[VEHICLE], &kind[PLANIMETER], &kind[ROPE],   &kind[SWEEP]};
    static const CpsDriveKind KIND[KINDS] = {CPS_DRIVE_SYSTEM,     CPS_DRIVE_BODY, CPS_DRIVE_BODY,
                                             CPS_DRIVE_PLANIMETER, CPS_DRIVE_ROPE, CPS_DRIVE_SWEEP};
    const CpsiLawFile *f = &r->build.file;
    const CpsStatus status = cpsi_drive_fields(r, root, CPSI_DRIVE_FILE, to);
    if (status != CPS_OK) return status;
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
