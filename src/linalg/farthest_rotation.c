/* SPDX-License-Identifier: BSD-3-Clause */
/* Davenport's method (farthest_rotation.h): for the rotation of a unit quaternion q, tr(Q' M) is
 * q' K q with the symmetric matrix
 *
 *     K = [ tr M    z' ;  z    M + M' - tr M I ],      z = (M32 - M23, M13 - M31, M21 - M12),
 *
 * so that its largest value is the largest eigenvalue of K, which Jacobi's rotations find. */
#include "linalg/farthest_rotation.h"

#include <math.h>
#include <stdbool.h>

/* Sweeps converge quadratically; few are needed. */
enum { N = 4, SWEEPS = 30 };

static void fill(double m[3][3], double k[N][N]) {
    const double trace = m[0][0] + m[1][1] + m[2][2];
    k[0][0] = trace;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, l = (i + 2) % 3;
        k[0][i + 1] = k[i + 1][0] = m[l][j] - m[j][l];
        for (int c = 0; c < 3; c++) k[i + 1][c + 1] = m[i][c] + m[c][i] - (i == c ? trace : 0);
    }
}

/* Turn rows and columns p and q of the matrix so that the entry at both vanishes. */
static void annihilate(double k[N][N], double vectors[N][N], int p, int q) {
    const double theta = (k[q][q] - k[p][p]) / (2 * k[p][q]),
                 t = (theta < 0 ? -1 : 1) / (fabs(theta) + hypot(theta, 1)), c = 1 / hypot(t, 1),
                 s = t * c;
    for (int i = 0; i < N; i++) {
        const double a = k[i][p], b = k[i][q];
        k[i][p] = c * a - s * b;
        k[i][q] = s * a + c * b;
    }
    for (int i = 0; i < N; i++) {
        const double a = k[p][i], b = k[q][i];
        k[p][i] = c * a - s * b;
        k[q][i] = s * a + c * b;
        const double x = vectors[i][p], y = vectors[i][q];
        vectors[i][p] = c * x - s * y;
        vectors[i][q] = s * x + c * y;
    }
}

double cpsi_farthest_rotation(double m[3][3], double quaternion[4]) {
    double k[N][N], vectors[N][N] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    fill(m, k);
    bool any = true;
    for (int sweep = 0; sweep < SWEEPS && any; sweep++) {
        any = false;
        for (int p = 0; p < N; p++)
            for (int q = p + 1; q < N; q++) {
                if (k[p][q] == 0) continue;
                annihilate(k, vectors, p, q);
                any = true;
            }
    }
    int most = 0;
    for (int i = 1; i < N; i++)
        if (k[i][i] > k[most][most]) most = i;
    for (int i = 0; i < N; i++) quaternion[i] = vectors[i][most];
    return k[most][most];
}
