/* SPDX-License-Identifier: BSD-3-Clause */
/* Paths of driven systems as points (see path_points.h). */
#include "io/read/path_points.h"

#include <math.h>
#include <string.h>

#include "capstan/drive_io.h"

void cps_drive_walk(int space, int points, const double *path, int count, double *out) {
    if (space < 1 || points < 2 || count < 1 || !path || !out) return;
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

static CpsStatus read_arc(CpsiDriveRead *r, const CpsiYaml *node, const double *start, int steps, int *points,
                          const double **path) {
    CpsiPathArcKeys arc = {.turn = 0};
    const CpsStatus status = cpsi_drive_fields(r, node, CPSI_DRIVE_PATH_ARC, &arc);
    if (status != CPS_OK) return status;
    if (!(fabs(arc.turn) <= 1000)) return cpsi_drive_wrong(r, node, "'arc'", "a turn of at most 1000 rad");
    /* corners where the steps end */
    const int sides = steps * (steps < CPSI_DRIVE_ARC_SIDES ? 1 + CPSI_DRIVE_ARC_SIDES / steps : 1);
    double *x = CPSI_POOL_TAKE(r->build.file.pool, 2 * ((size_t)sides + 1), double);
    if (!x) return cpsi_drive_no_memory(r);
    const double dx = start[0] - arc.center[0], dy = start[1] - arc.center[1];
    for (int i = 0; i <= sides; i++) {
        const double a = arc.turn * i / sides;
        x[2 * i] = arc.center[0] + cos(a) * dx - sin(a) * dy;
        x[2 * i + 1] = arc.center[1] + sin(a) * dx + cos(a) * dy;
    }
    *points = sides + 1, *path = x;
    return CPS_OK;
}

CpsStatus cpsi_drive_read_path(CpsiDriveRead *r, const CpsiYaml *node, int space, const double *start, int steps,
                               int *points, const double **path) {
    if (node->kind == CPSI_YAML_MAPPING) {
        CpsiPathKeys keys = {.arc = NULL};
        if (space != 2) return cpsi_drive_wrong(r, node, "'path'", "a list of points, as in [[0], [1]]");
        const CpsStatus status = cpsi_drive_fields(r, node, CPSI_DRIVE_PATH, &keys);
        return status ? status : read_arc(r, keys.arc, start, steps, points, path);
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
