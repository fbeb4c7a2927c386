/* SPDX-License-Identifier: BSD-3-Clause */
/* The second-order cone  Q = { (x0, x1) in R x R^(n-1) : |x1| <= x0 },  n >= 2: the kernels of an
 * interior-point step.
 *
 * Jordan product        x o y = (x.y, x0 y1 + y0 x1),   identity e = (1, 0),
 *     J = diag(1, -1, ..., -1),
 *                       det x = x0^2 - |x1|^2,          x^-1 = J x / det x.
 *
 * Nesterov-Todd scaling of an interior pair (s, z): the unique w with det w = 1, w0 > 0 and the
 * length eta such that
 *
 *     W s-scaled = z-scaled:   eta^-1 W^-1 s = eta W z,     W = [ w0  w1^T ; w1
 *         I + w1 w1^T/(1 + w0) ].
 *
 * eta itself is never needed: with  g = eta^-2  and  a = W z = g W^-1 s  every formula of the step
 * is free of it (the common factor cancels in the products, and steps to the boundary are ratios).
 * The scaled Hessian is g W^-2 = g (2 (J w)(J w)^T - J).
 *
 * References: Nesterov and Todd, Math. Oper. Res. 22 (1997); Vandenberghe, "The CVXOPT linear and
 * quadratic cone program solvers" (2010), section 4. All functions are exact up to rounding and
 * cannot fail; arguments must not overlap unless said. In the kinds of the cable `n` is a
 * compile-time constant, 3 or 4, so that the loops unroll. */
#ifndef CAPSTAN_SRC_IPM_SOC_H
#define CAPSTAN_SRC_IPM_SOC_H

#include <float.h>
#include <math.h>
#include <stdbool.h>

#include "base/larger.h"

#define CPSI_SOC_MAX 4

/* s.z of a pair whose members lie at the boundary is known to the rounding of s0 z0. A product of
 * this share of s0 z0 leaves each of them twenty units in the last place inside. */
#define CPSI_SOC_ROUNDING 1e-14

/* The product that a step aims at for a pair (s, z): the target, but at least the rounding of s0
 * z0. */
static inline double cpsi_soc_aim(double target, const double *s, const double *z) {
    const double least = CPSI_SOC_ROUNDING * s[0] * z[0];
    return target > least ? target : least;
}

/* Scaling of one pair. */
typedef struct CpsiSocScaling {
    double w[CPSI_SOC_MAX]; /* w0, w1 */
    double g;               /* eta^-2 */
} CpsiSocScaling;

/* det x, not less than the rounding of an interior point. */
static inline double cpsi_soc_det(const double *x, const int n) {
    double r = 0;
    for (int i = 1; i < n; i++) r += x[i] * x[i];
    const double det = x[0] * x[0] - r, floor = DBL_EPSILON * DBL_EPSILON * x[0] * x[0];
    return det > floor ? det : floor;
}

/* The scaling of the interior pair (s, z) of any dimension: writes w (n), returns g. */
static inline double cpsi_soc_scale(double *w, const double *s, const double *z, const int n) {
    const double ds = cpsi_soc_det(s, n), dz = cpsi_soc_det(z, n);
    const double is = 1 / sqrt(ds), iz = 1 / sqrt(dz);
    double sz = 0;
    for (int i = 0; i < n; i++) sz += s[i] * z[i];
    /* w = (s/|s| + J z/|z|) / (2 gamma) with |x| = sqrt(det x), 2 gamma^2 = 1 + s.z/(|s||z|) */
    const double scale = 1 / sqrt(2 * (1 + sz * is * iz));
    double w1w1 = 0;
    for (int i = 1; i < n; i++) {
        w[i] = scale * (s[i] * is - z[i] * iz);
        w1w1 += w[i] * w[i];
    }
    w[0] = sqrt(1 + w1w1); /* makes det w = 1 to rounding */
    return dz * iz * is;
}

/* The same for n <= CPSI_SOC_MAX, by value. */
static inline CpsiSocScaling cpsi_soc_scaling(const double *s, const double *z, const int n) {
    CpsiSocScaling out;
    out.g = cpsi_soc_scale(out.w, s, z, n);
    return out;
}

/* out = W x   (sign = +1)   or   W^-1 x   (sign = -1). */
static inline void cpsi_soc_apply(double *out, const double *w, const double *x, const double sign,
                                  const int n) {
    double w1x1 = 0;
    for (int i = 1; i < n; i++) w1x1 += w[i] * x[i];
    const double k =
        sign * x[0] +
        /* multiplied by the reciprocal, so that one division serves all calls with this w */
        w1x1 * (1 / (1 + w[0]));
    out[0] = w[0] * x[0] + sign * w1x1;
    for (int i = 1; i < n; i++) out[i] = x[i] + k * w[i];
}

/* out = x o y. */
static inline void cpsi_soc_product(double *out, const double *x, const double *y, const int n) {
    double xy = 0;
    for (int i = 0; i < n; i++) xy += x[i] * y[i];
    for (int i = 1; i < n; i++) out[i] = x[0] * y[i] + y[0] * x[i];
    out[0] = xy;
}

/* The solution of  x o out = y  for interior x. */
static inline void cpsi_soc_divide(double *out, const double *x, const double *y, const int n) {
    double x1y1 = 0;
    for (int i = 1; i < n; i++) x1y1 += x[i] * y[i];
    const double first = (x[0] * y[0] - x1y1) * (1 / cpsi_soc_det(x, n)), inverse = 1 / x[0];
    for (int i = 1; i < n; i++) out[i] = (y[i] - first * x[i]) * inverse;
    out[0] = first;
}

/* 1/alpha for the largest alpha with x + alpha d in Q, x interior; 0 where every alpha is
 * admissible, NaN if x or d is not finite. det(x + alpha d) = C + 2 B alpha + A alpha^2 vanishes
 * first at alpha = C/(-B + sqrt(B^2 - A C)). */
static inline double cpsi_soc_inverse_step(const double *x, const double *d, const int n) {
    double a = d[0] * d[0], b = x[0] * d[0];
    for (int i = 1; i < n; i++) {
        a -= d[i] * d[i];
        b -= x[i] * d[i];
    }
    const double c = cpsi_soc_det(x, n), disc = b * b - a * c;
    /* disc, but at least 0, without a choice: compilers branch around a root of 0 */
    const double positive = 0.5 * (disc + fabs(disc));
    const double inverse = (sqrt(positive) - b) * (1 / c);
    /* written so that NaN gives NaN, and with one comparison per choice (lanes.h) */
    const double least = inverse <= 0 ? 0 : inverse, away = b >= 0 ? 0 : least;
    return disc <= 0 ? away : least;
}

/* out = W^-1 (x \ (ds o dz)), the second-order term of a predictor: x = W z, ds = g W^-1 (direction
 * of s), dz = W (direction of z). */
static inline void cpsi_soc_second_order(double *out, const double *w, const double *x,
                                         const double *ds, const double *dz, const int n) {
    double product[CPSI_SOC_MAX], scaled[CPSI_SOC_MAX];
    cpsi_soc_product(product, ds, dz, n);
    cpsi_soc_divide(scaled, x, product, n);
    cpsi_soc_apply(out, w, scaled, -1, n);
}

/* The step of a pair along (ds, dz): returns the largest 1/alpha of its two boundaries, and for a
 * predictor writes its second-order term into q. */
static inline double cpsi_soc_step(double *q, bool predictor, const double *w, double g,
                                   const double *z, const double *ds, const double *dz,
                                   const int n) {
    double point[CPSI_SOC_MAX], scaled_ds[CPSI_SOC_MAX], scaled_dz[CPSI_SOC_MAX];
    cpsi_soc_apply(point, w, z, 1, n);
    cpsi_soc_apply(scaled_dz, w, dz, 1, n);
    cpsi_soc_apply(scaled_ds, w, ds, -1, n);
    for (int a = 0; a < n; a++) scaled_ds[a] *= g;
    const double step_s = cpsi_soc_inverse_step(point, scaled_ds, n),
                 step_z = cpsi_soc_inverse_step(point, scaled_dz, n);
    if (predictor) cpsi_soc_second_order(q, w, point, scaled_ds, scaled_dz, n);
    return cpsi_max_nan(step_s, step_z);
}

/* q with s o z -> target e, less the second-order term that q contains, or 0. */
static inline void cpsi_soc_correct(double *q, const double *s, const double *z, double target,
                                    const int n) {
    const double inverse = cpsi_soc_aim(target, s, z) / cpsi_soc_det(s, n);
    q[0] = -z[0] + inverse * s[0] - q[0];
    for (int a = 1; a < n; a++) q[a] = -z[a] - inverse * s[a] - q[a];
}

#endif
