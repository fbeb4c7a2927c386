/* SPDX-License-Identifier: BSD-3-Clause */
/* The point of an ellipsoid's boundary nearest to a given point, from outside and from inside.
 *
 * In the axes, with half axes e_i and the point y, the nearest point is x_i = e_i^2 y_i/(e_i^2 + m)
 * for the m that places it on the boundary: sum of (e_i y_i/(e_i^2 + m))^2 = 1. Of the roots, the
 * one with m > -e_1^2, e_1 the smallest half axis, belongs to the nearest point; m > 0 outside. The
 * unknown is s = m + e_1^2 > 0, in which the sum is decreasing. For a point without component along
 * the shortest axes there may be no such root. Then s = 0, and those components of x make up the
 * difference of the sum to 1. */
#include <math.h>
#include <string.h>

#include "linalg/dense.h"
#include "set/set.h"

/* Rotate columns j and k of w and of v (n, n) until those of w are normal to each other. Returns
 * false where they already were. */
static bool turn_columns(int n, int j, int k, double *w, double *v) {
    double jj = 0, kk = 0, jk = 0;
    for (int i = 0; i < n; i++) {
        jj += w[i * n + j] * w[i * n + j];
        kk += w[i * n + k] * w[i * n + k];
        jk += w[i * n + j] * w[i * n + k];
    }
    if (fabs(jk) <= 1e-16 * sqrt(jj) * sqrt(kk)) return false;
    const double zeta = (kk - jj) / (2 * jk), t = copysign(1, zeta) / (fabs(zeta) + hypot(1, zeta)),
                 c = 1 / sqrt(1 + t * t), s = c * t;
    for (int i = 0; i < n; i++) {
        const double a = w[i * n + j], b = w[i * n + k], p = v[i * n + j], q = v[i * n + k];
        w[i * n + j] = c * a - s * b;
        w[i * n + k] = s * a + c * b;
        v[i * n + j] = c * p - s * q;
        v[i * n + k] = s * p + c * q;
    }
    return true;
}

/* Half axes (n) and, as columns of v (n, n), their directions: the singular values of the inverse
 * Cholesky factor by one-sided Jacobi rotations, which keep the relative accuracy of the small ones
 * (Demmel and Veselic 1992). */
static bool find_axes(const CpsSet *set, double *w, double *v, double *half) {
    enum { SWEEPS = 40 };
    const int n = set->n;
    double most = 0;
    for (int i = 0; i < n * n; i++) most = fmax(most, fabs(set->c[i]));
    for (int i = 0; i < n * n; i++) {
        w[i] = set->c[i] / most;
        v[i] = i % (n + 1) == 0;
    }
    bool turned = true;
    for (int sweep = 0; turned && sweep < SWEEPS; sweep++) {
        turned = false;
        for (int j = 0; j < n; j++)
            for (int k = j + 1; k < n; k++) turned = turn_columns(n, j, k, w, v) || turned;
    }
    for (int j = 0; j < n; j++) {
        double size = 0;
        for (int i = 0; i < n; i++) size = hypot(size, w[i * n + j]);
        half[j] = 1 / size / most;
        if (!(half[j] > 0) || !isfinite(half[j])) return false;
    }
    return true;
}

/* s, for half axes with squares least + above_i; 0 where there is no root. */
static double find_root(int n, const double *half, const double *y, double least) {
    double low = 0, high = 0;
    for (int i = 0; i < n; i++) {
        const double pull = half[i] * fabs(y[i]), above = (half[i] - least) * (half[i] + least);
        low = fmax(low, pull - above); /* at this lower bound a single term is at least 1 */
        high = hypot(high, pull);      /* at this upper bound the sum of all terms is at most 1 */
    }
    for (int k = 0; k < 2000 && high - low > 2e-16 * high; k++) {
        const double s = low > 0 && high > 4 * low ? sqrt(low) * sqrt(high) : 0.5 * (low + high);
        double sum = 0;
        for (int i = 0; i < n; i++) {
            const double term = half[i] * y[i] / ((half[i] - least) * (half[i] + least) + s);
            sum += y[i] != 0 ? term * term : 0;
        }
        if (s <= low || s >= high) break;
        if (sum > 1)
            low = s;
        else
            high = s;
    }
    return high;
}

bool cpsi_ellipsoid_nearest(const CpsSet *set, const double *p, double *nearest, double *distance,
                            bool *inside) {
    const int n = set->n;
    const size_t square = (size_t)n * (size_t)n;
    CpsiScratch scratch;
    double *w = cpsi_scratch_take(&scratch, 2 * square + 3 * (size_t)n), *v = w ? w + square : NULL;
    double *half = w ? v + square : NULL, *y = w ? half + n : NULL, *x = w ? y + n : NULL;
    const bool done = w && find_axes(set, w, v, half);
    if (done) {
        double least = INFINITY, out = 0, filled = 0;
        int shortest = 0;
        for (int j = 0; j < n; j++) {
            y[j] = 0;
            for (int i = 0; i < n; i++) y[j] += v[i * n + j] * (p[i] - set->a[i]);
            out = hypot(out, y[j] / half[j]);
            if (half[j] < least) {
                least = half[j];
                shortest = j;
            }
        }
        *inside = out <= 1;
        const double s = find_root(n, half, y, least);
        for (int j = 0; j < n; j++) {
            const double above = (half[j] - least) * (half[j] + least) + s;
            x[j] = above > 0 ? half[j] * (half[j] * y[j] / above) : 0;
            filled += j != shortest ? x[j] / half[j] * (x[j] / half[j]) : 0;
        }
        /* the undetermined component, or one lost in rounding: place the point on the boundary */
        if (*inside && fabs(y[shortest]) <= 1e-9 * least)
            x[shortest] = copysign(least * sqrt(fmax(0, 1 - filled)), y[shortest]);
        *distance = 0;
        for (int j = 0; j < n; j++) *distance = hypot(*distance, x[j] - y[j]);
        for (int i = 0; i < n; i++) nearest[i] = set->a[i] + cpsi_dot(n, &v[i * n], x);
    }
    cpsi_scratch_give(&scratch);
    return done;
}
