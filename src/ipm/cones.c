/* SPDX-License-Identifier: BSD-3-Clause */
/* Passes over cones of any dimension. */
#include "ipm/cones.h"

#include <string.h>

#include "base/larger.h"
#include "cone/soc.h"

void cpsi_cones_layout(CpsiArena *arena, CpsiCones *cones, int rows, int count, int largest) {
    const size_t m = (size_t)rows;
    double *at = CPSI_TAKE(arena, 7*m + (size_t)count + 4*(size_t)largest, double);
    *cones = (CpsiCones){.rows = rows, .count = count};
    if (!at) return;
    double **part[] = {&cones->s, &cones->z, &cones->ds, &cones->dz, &cones->q, &cones->w, &cones->rho};
    for (size_t k = 0; k < sizeof part/sizeof *part; k++, at += m) *part[k] = at;
    cones->g = at;
    cones->scratch = at + count;
}

void cpsi_cones_start(CpsiCones *cones, double mu) {
    memset(cones->s, 0, (size_t)cones->rows*sizeof *cones->s);
    memset(cones->z, 0, (size_t)cones->rows*sizeof *cones->z);
    for (int k = 0, i = 0; k < cones->count; i += cones->dim[k++]) cones->s[i] = 1, cones->z[i] = mu;
}

void cpsi_cones_scale(CpsiCones *cones) {
    for (int k = 0, i = 0; k < cones->count; i += cones->dim[k++]) {
        const int d = cones->dim[k];
        if (d == 1) cones->g[k] = cones->z[i]/cones->s[i], cones->w[i] = 1;
        else cones->g[k] = cpsi_soc_scale(&cones->w[i], &cones->s[i], &cones->z[i], d);
    }
    for (int i = 0; i < cones->rows; i++) cones->q[i] = -cones->z[i];
}

void cpsi_cones_apply(const CpsiCones *cones, int k, int i, double sign, double factor, const double *x, double *out) {
    const int d = cones->dim[k];
    if (d == 1) out[0] = x[0];
    else cpsi_soc_apply(out, &cones->w[i], x, sign, d);
    for (int r = 0; r < d; r++) out[r] *= factor;
}

/* s and z are the same point of the scaled space, and well inside there */
static double step_of_cone(CpsiCones *cones, int k, int i) {
    const int d = cones->dim[k];
    const double *s = &cones->s[i], *z = &cones->z[i], *ds = &cones->ds[i], *dz = &cones->dz[i];
    if (d == 1) return cpsi_larger(-ds[0]/s[0], -dz[0]/z[0]);
    double *point = cones->scratch, *turned = point + d;
    cpsi_soc_apply(point, &cones->w[i], z, 1, d);
    cpsi_soc_apply(turned, &cones->w[i], dz, 1, d);
    const double step_z = cpsi_soc_inverse_step(point, turned, d);
    cpsi_cones_apply(cones, k, i, -1, cones->g[k], ds, turned);
    return cpsi_larger(cpsi_soc_inverse_step(point, turned, d), step_z);
}

double cpsi_cones_step(CpsiCones *cones) {
    double inverse = 0;
    for (int k = 0, i = 0; k < cones->count; i += cones->dim[k++])
        inverse = cpsi_larger(inverse, step_of_cone(cones, k, i));
    return inverse;
}

void cpsi_cones_correct(CpsiCones *cones, double target) {
    for (int k = 0, i = 0; k < cones->count; i += cones->dim[k++]) {
        const int d = cones->dim[k];
        const double *s = &cones->s[i], *z = &cones->z[i], *w = &cones->w[i], g = cones->g[k];
        double *q = &cones->q[i];
        if (d == 1) {
            q[0] = -z[0] + (target - cones->ds[i]*cones->dz[i])/s[0];
            continue;
        }
        double *point = cones->scratch, *one = point + d, *two = one + d, *second = two + d;
        cpsi_soc_apply(point, w, z, 1, d);
        cpsi_soc_apply(one, w, &cones->dz[i], 1, d);
        cpsi_soc_apply(two, w, &cones->ds[i], -1, d);
        cpsi_soc_product(second, one, two, d);
        cpsi_soc_divide(one, point, second, d);
        cpsi_soc_apply(two, w, one, -1, d);
        const double inverse = target/cpsi_soc_det(s, d);
        q[0] = -z[0] + inverse*s[0] - g*two[0];
        for (int r = 1; r < d; r++) q[r] = -z[r] - inverse*s[r] - g*two[r];
    }
}

void cpsi_cones_advance(CpsiCones *cones, double alpha) {
    for (int i = 0; i < cones->rows; i++) {
        cones->s[i] += alpha*cones->ds[i];
        cones->z[i] += alpha*cones->dz[i];
    }
}
