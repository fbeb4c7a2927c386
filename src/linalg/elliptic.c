/* SPDX-License-Identifier: BSD-3-Clause */
/* Complete elliptic integrals by the arithmetic-geometric mean.
 *
 * From a_0 = 1, g_0 = kc the means converge to M, and K = pi/(2 M). With c_n = (a_(n-1) -
 * g_(n-1))/2 Legendre's sum is E = K (1 - k^2/2 - sum of 2^(n-1) c_n^2) (Abramowitz and Stegun
 * 1964, 17.6.3-4). Every c_n has the factor k^2, so with q_n = c_n/k^2 the difference D - B = 2 D -
 * K = k^2 C becomes C = K x sum of 2^n q_n^2, whose terms are positive and accurate also at k = 0.
 */
#include "linalg/elliptic.h"

#include <math.h>

#include "base/math.h"

static const double HALF_PI = 0.5 * CPSI_PI;

CpsiElliptic cpsi_elliptic(double k, double kc) {
    const double m = k * k;
    double a = 1, g = fmax(kc, 1e-16);

    /* q_1 = (1 - kc)/(2 k^2), then q_(n+1) = k^2 q_n^2/(4 a_(n+1)); the convergence is quadratic,
     * so that 9 means are enough from 1e-16 */
    double q = 0.5 / (1 + g), power = 2, sum = 0, legendre = 0.5 * (1 + g * g);
    for (int n = 1; n <= 10; n++) {
        const double mean = 0.5 * (a + g), half = 0.5 * (a - g);
        legendre -= 0.5 * power * half * half;
        g = sqrt(a * g);
        a = mean;
        if (n > 1) q = m * q * q / (4 * a);
        sum += power * q * q;
        power *= 2;
    }
    const double kk = HALF_PI / a, c = kk * sum;
    const double d = 0.5 * (kk + m * c);
    return (CpsiElliptic){.e = kk * legendre, .b = 0.5 * (kk - m * c), .c = c, .d = d};
}
