/* SPDX-License-Identifier: BSD-3-Clause */
/* Complete elliptic integrals as the limit surfaces of ring and disc need them, without
 * cancellation at either end of the range of the modulus. */
#ifndef CAPSTAN_SRC_LINALG_ELLIPTIC_H
#define CAPSTAN_SRC_LINALG_ELLIPTIC_H

/* With s = sin x, c = cos x, d = sqrt(1 - k^2 s^2), integrated over a quarter turn:
 *
 *     E = of d      B = of c^2/d      D = of s^2/d      C = of s^2 c^2/d^3
 *
 * so K = B + D, E = K - k^2 D, D - B = k^2 C (Jahnke and Emde's names). */
typedef struct CpsiElliptic {
    double e, b, c, d;
} CpsiElliptic;

/* For modulus k, 0 <= k <= 1. The complement kc = sqrt(1 - k^2) is a second argument, so that
 * neither is lost by rounding. Relative accuracy 3e-14, of E 1e-14 (tested against quadrature). C
 * and D grow like log(4/kc); kc counts as at least 1e-16. */
CpsiElliptic cpsi_elliptic(double k, double kc);

#endif
