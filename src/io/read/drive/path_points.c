/* SPDX-License-Identifier: BSD-3-Clause */
/* Paths of driven systems as points (see path_points.h). */
#include "io/read/drive/path_points.h"

#include <math.h>
#include <string.h>

#include "base/math.h"
#include "capstan/io.h"
#include "io/read/key_reader.h"

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
            /* all points on this side; the last point is on the last side */
            for (; at < count; at++) {
                const double s = count > 1 ? whole * at / (count - 1) : 0;
                if (s > here && i + 2 < points) break;
                const double t = length > 0 ? fmin((s - before) / length, 1) : 1;
                for (size_t k = 0; k < n; k++)
                    out[(size_t)at * n + k] = t == 1 ? path[((size_t)i + 1) * n + k]
                                                     : (1 - t) * path[(size_t)i * n + k] +
                                                           t * path[((size_t)i + 1) * n + k];
            }
            before = here;
        }
}

void cpsi_arc_points(const double start[2], const double centre[2], double degrees, int sides,
                     double *x) {
    const double dx = start[0] - centre[0], dy = start[1] - centre[1];
    for (int i = 0; i <= sides; i++) {
        const double a = degrees * CPSI_DEGREE * i / sides;
        x[2 * i] = centre[0] + cos(a) * dx - sin(a) * dy;
        x[2 * i + 1] = centre[1] + sin(a) * dx + cos(a) * dy;
    }
}

static CpsStatus build_arc(const CpsiDocument *d, const CpsiPathArcValues *arc, const double *start,
                           int steps, int *points, const double **path) {
    /* corners at the ends of steps */
    const int sides = steps * (steps < CPSI_DRIVE_ARC_SIDES ? 1 + CPSI_DRIVE_ARC_SIDES / steps : 1);
    double *x = CPSI_POOL_TAKE(d->pool, 2 * ((size_t)sides + 1), double);
    if (!x) return cpsi_document_no_memory(d);
    cpsi_arc_points(start, arc->centre, arc->angle, sides, x);
    *points = sides + 1;
    *path = x;
    return CPS_OK;
}

CpsStatus cpsi_build_path(const CpsiDocument *d, const CpsiPathValues *values, int space,
                          const double *start, int steps, int *points, const double **path) {
    const CpsiNumberRows *given = &values->points;
    if (values->node) {
        if (space != 2)
            return cpsi_document_wrong(d, values->node, "'path'",
                                       "a list of points, as in [[0], [1]]");
        return build_arc(d, &values->arc, start, steps, points, path);
    }
    const CpsStatus status = cpsi_expect_columns(d, given, "'path'", space);
    if (status != CPS_OK) return status;
    const size_t n = (size_t)space, rows = (size_t)given->rows;
    double *x = CPSI_POOL_TAKE(d->pool, (rows + 1) * n, double);
    if (!x) return cpsi_document_no_memory(d);
    memcpy(x, start, n * sizeof *x);
    memcpy(x + n, given->x, rows * n * sizeof *x);
    *points = given->rows + 1;
    *path = x;
    return CPS_OK;
}
