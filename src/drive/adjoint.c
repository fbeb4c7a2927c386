/* SPDX-License-Identifier: BSD-3-Clause */
/* B*f of one piece (adjoint.h).
 *
 * A law with a flat set, for instance a segment, may be connected to the parameters in such a way
 * that its forces do no work on one of them. The sum over the components is then 0 in exact
 * arithmetic and a rounding error in floating point. In a program whose equations are scaled, this
 * rounding error would become an equation of size one. */
#include "drive/adjoint.h"

#include <math.h>
#include <stdlib.h>

#include "base/status.h"

/* A sum this small relative to its terms is rounding: vectors of a form come from orthogonal bases,
 * which are accurate to some tens of eps. */
static const double ROUNDING = 1e-13;

CpsStatus cpsi_adjoint_new(const CpsSystem *system, CpsiAdjoint *out, CpsError *err) {
    const size_t n = (size_t)system->n;
    *out = (CpsiAdjoint){.sum = calloc(2 * n + 1, sizeof(double)),
                         .column = calloc(n + 1, sizeof(int))};
    if (out->sum && out->column) {
        out->terms = out->sum + n;
        return CPS_OK;
    }
    cpsi_adjoint_free(out);
    return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a system of %d parameters", system->n);
}

void cpsi_adjoint_free(CpsiAdjoint *adjoint) {
    free(adjoint->sum);
    free(adjoint->column);
    *adjoint = (CpsiAdjoint){0};
}

double cpsi_adjoint_size(size_t count, const double *a) {
    double size = 0;
    for (size_t i = 0; i < count; i++) size = fmax(size, fabs(a[i]));
    return size;
}

/* Add one row of B times its force. */
static void add_row(CpsiAdjoint *adjoint, const CpsiRows *map, int row, double force, double size) {
    for (size_t e = map->start[row]; e < map->start[row + 1]; e++) {
        const int column = map->column[e];
        if (map->value[e] == 0) continue;
        if (adjoint->terms[column] == 0) adjoint->column[adjoint->count++] = column;
        adjoint->sum[column] += map->value[e] * force;
        adjoint->terms[column] += fabs(map->value[e]) * size;
    }
}

void cpsi_adjoint_apply(CpsiAdjoint *adjoint, const CpsSystem *system, const CpsiPiece *piece,
                        const double *f, size_t stride, double size) {
    const int base = system->law[piece->law].first + piece->offset;
    for (int i = 0; i < adjoint->count; i++)
        adjoint->sum[adjoint->column[i]] = adjoint->terms[adjoint->column[i]] = 0;
    adjoint->count = 0;
    for (int r = 0; r < piece->space; r++) {
        const double force = f[(size_t)r * stride];
        if (force != 0) add_row(adjoint, &system->map, base + r, force, size);
    }
    for (int i = 0; i < adjoint->count; i++) {
        const int column = adjoint->column[i];
        if (fabs(adjoint->sum[column]) <= ROUNDING * adjoint->terms[column])
            adjoint->sum[column] = 0;
    }
}
