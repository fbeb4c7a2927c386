/* SPDX-License-Identifier: BSD-3-Clause */
/* Loops over cones of any dimension. */
#include "ipm/cones.h"

#include <string.h>

#include "ipm/cone.h"

void cpsi_cones_layout(CpsiArena *arena, CpsiCones *cones, int rows, int count, int largest) {
    const size_t m = (size_t)rows;
    double *at = cpsi_arena_take(arena, 7 * m + (size_t)count + 4 * (size_t)largest, sizeof *at);
    *cones = (CpsiCones){.rows = rows, .count = count};
    if (!at) return;
    double **part[] = {&cones->s, &cones->z, &cones->ds, &cones->dz,
                       &cones->q, &cones->w, &cones->rho};
    for (size_t k = 0; k < sizeof part / sizeof *part; k++, at += m) *part[k] = at;
    cones->g = at;
    cones->scratch = at + count;
}

void cpsi_cones_start(CpsiCones *cones, double mu) {
    memset(cones->s, 0, (size_t)cones->rows * sizeof *cones->s);
    memset(cones->z, 0, (size_t)cones->rows * sizeof *cones->z);
    CPSI_FOR_CONES(k, i, cones->count, cones->dim) {
        cones->s[i] = 1;
        cones->z[i] = mu;
    }
}

void cpsi_cones_scale(CpsiCones *cones) {
    CPSI_FOR_CONES(k, i, cones->count, cones->dim)
        cones->g[k] = cpsi_cone_scale(&cones->w[i], &cones->s[i], &cones->z[i], cones->dim[k]);
    for (int i = 0; i < cones->rows; i++) cones->q[i] = -cones->z[i];
}

void cpsi_cones_apply(const CpsiCones *cones, int k, int i, double sign, double factor,
                      const double *x, double *out) {
    cpsi_cone_apply(out, &cones->w[i], x, sign, factor, cones->dim[k]);
}

double cpsi_cones_step(CpsiCones *cones) {
    double inverse = 0;
    CPSI_FOR_CONES(k, i, cones->count, cones->dim) {
        const double step =
            cpsi_cone_step(cones->dim[k], &cones->w[i], cones->g[k], &cones->s[i], &cones->z[i],
                           &cones->ds[i], &cones->dz[i], cones->scratch);
        inverse = cpsi_max_nan(inverse, step);
    }
    return inverse;
}

void cpsi_cones_correct(CpsiCones *cones, double target) {
    CPSI_FOR_CONES(k, i, cones->count, cones->dim)
        cpsi_cone_correct(&cones->q[i], cones->dim[k], &cones->w[i], cones->g[k], &cones->s[i],
                          &cones->z[i], &cones->ds[i], &cones->dz[i], target, cones->scratch);
}

void cpsi_cones_advance(CpsiCones *cones, double alpha) {
    cpsi_cone_advance((size_t)cones->rows, alpha, cones->s, cones->ds, cones->z, cones->dz);
}
