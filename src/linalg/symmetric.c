/* SPDX-License-Identifier: BSD-3-Clause */
/* Jacobi's method (symmetric.h): rotations in the plane of two rows make the entry at both vanish,
 * one after the other. */
#include "linalg/symmetric.h"

#include <math.h>
#include <stdbool.h>

/* Sweeps converge quadratically; few are needed. */
enum { SWEEPS = 30 };

/* Turn rows and columns p and q so that the entry at both vanishes. */
static void annihilate(int n, double *a, double *vectors, int p, int q) {
    const double theta = (a[q * n + q] - a[p * n + p]) / (2 * a[p * n + q]),
                 t = (theta < 0 ? -1 : 1) / (fabs(theta) + hypot(theta, 1)), c = 1 / hypot(t, 1),
                 s = t * c;
    for (int i = 0; i < n; i++) {
        const double x = a[i * n + p], y = a[i * n + q];
        a[i * n + p] = c * x - s * y;
        a[i * n + q] = s * x + c * y;
    }
    for (int i = 0; i < n; i++) {
        const double x = a[p * n + i], y = a[q * n + i], u = vectors[i * n + p],
                     v = vectors[i * n + q];
        a[p * n + i] = c * x - s * y;
        a[q * n + i] = s * x + c * y;
        vectors[i * n + p] = c * u - s * v;
        vectors[i * n + q] = s * u + c * v;
    }
}

void cpsi_symmetric_diagonalise(int n, double *a, double *vectors) {
    for (int i = 0; i < n * n; i++) vectors[i] = i % (n + 1) == 0;
    bool any = true;
    for (int sweep = 0; sweep < SWEEPS && any; sweep++) {
        any = false;
        for (int p = 0; p < n; p++)
            for (int q = p + 1; q < n; q++) {
                if (a[p * n + q] == 0) continue;
                annihilate(n, a, vectors, p, q);
                any = true;
            }
    }
}
