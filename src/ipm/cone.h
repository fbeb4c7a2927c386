/* SPDX-License-Identifier: BSD-3-Clause */
/* One cone of any dimension d in an interior-point step: a half-line (d = 1) or a second-order cone
 * (soc.h). With the scaling W, g of a pair the linearised complementarity is dz + H ds = q, H = g
 * W^-2; a half-line has W = 1, g = z/s. */
#ifndef CAPSTAN_SRC_IPM_CONE_H
#define CAPSTAN_SRC_IPM_CONE_H

#include <stddef.h>

#include "base/larger.h"
#include "ipm/program.h"
#include "ipm/soc.h"

/* The scaling: writes w (d), returns g. */
static inline double cpsi_cone_scale(double *w, const double *s, const double *z, int d) {
    if (d > 1) return cpsi_soc_scale(w, s, z, d);
    w[0] = 1;
    return z[0] / s[0];
}

/* out = factor W x (sign 1) or factor W^-1 x (sign -1); x and out (d) do not overlap. */
static inline void cpsi_cone_apply(double *out, const double *w, const double *x, double sign,
                                   double factor, int d) {
    if (d == 1)
        out[0] = x[0];
    else
        cpsi_soc_apply(out, w, x, sign, d);
    for (int r = 0; r < d; r++) out[r] *= factor;
}

/* 1/alpha of the nearest boundary. The scaled s and z are the same point, which lies well inside
 * the cone. scratch (2 d) */
static inline double cpsi_cone_step(int d, const double *w, double g, const double *s,
                                    const double *z, const double *ds, const double *dz,
                                    double *scratch) {
    if (d == 1) return cpsi_max_nan(-ds[0] / s[0], -dz[0] / z[0]);
    double *point = scratch, *turned = point + d;
    cpsi_soc_apply(point, w, z, 1, d);
    cpsi_soc_apply(turned, w, dz, 1, d);
    const double step_z = cpsi_soc_inverse_step(point, turned, d);
    cpsi_cone_apply(turned, w, ds, -1, g, d);
    return cpsi_max_nan(cpsi_soc_inverse_step(point, turned, d), step_z);
}

/* q of the corrector: s o z -> target e, less the second-order term of the predictor (ds, dz).
 * scratch (4 d) */
static inline void cpsi_cone_correct(double *q, int d, const double *w, double g, const double *s,
                                     const double *z, const double *ds, const double *dz,
                                     double target, double *scratch) {
    if (d == 1) {
        q[0] = -z[0] + (target - ds[0] * dz[0]) / s[0];
        return;
    }
    double *point = scratch, *one = point + d, *two = one + d, *second = two + d;
    cpsi_soc_apply(point, w, z, 1, d);
    cpsi_soc_apply(one, w, dz, 1, d);
    cpsi_soc_apply(two, w, ds, -1, d);
    cpsi_soc_product(second, one, two, d);
    cpsi_soc_divide(one, point, second, d);
    cpsi_soc_apply(two, w, one, -1, d);
    const double inverse = target / cpsi_soc_det(s, d);
    q[0] = -z[0] + inverse * s[0] - g * two[0];
    for (int r = 1; r < d; r++) q[r] = -z[r] - inverse * s[r] - g * two[r];
}

/* q of a half-line for an aim, where q holds the second-order term of a predictor. */
static inline double cpsi_cone_aim_half_line(const CpsiIpmAim *aim, double s, double z, double q) {
    if (aim->kind == CPSI_IPM_AIM_GIVEN) return q;
    if (aim->kind == CPSI_IPM_AIM_PREDICT) return -z;
    return -z + aim->target / s - (aim->kind == CPSI_IPM_AIM_CORRECT ? q : 0);
}

/* s += alpha ds, z += alpha dz, of cones of `count` rows in all. */
static inline void cpsi_cone_advance(size_t count, double alpha, double *s, const double *ds,
                                     double *z, const double *dz) {
    for (size_t i = 0; i < count; i++) {
        s[i] += alpha * ds[i];
        z[i] += alpha * dz[i];
    }
}

#endif
