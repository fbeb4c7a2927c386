/* SPDX-License-Identifier: BSD-3-Clause */
/* Davenport's method (farthest_rotation.h): for the rotation of a unit quaternion q, tr(Q' M) is
 * q' K q with the symmetric matrix
 *
 *     K = [ tr M    z' ;  z    M + M' - tr M I ],      z = (M32 - M23, M13 - M31, M21 - M12),
 *
 * so that its largest value is the largest eigenvalue of K. */
#include "linalg/farthest_rotation.h"

#include "linalg/symmetric.h"

enum { N = 4 };

static void fill(double m[3][3], double k[N][N]) {
    const double trace = m[0][0] + m[1][1] + m[2][2];
    k[0][0] = trace;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, l = (i + 2) % 3;
        k[0][i + 1] = k[i + 1][0] = m[l][j] - m[j][l];
        for (int c = 0; c < 3; c++) k[i + 1][c + 1] = m[i][c] + m[c][i] - (i == c ? trace : 0);
    }
}

double cpsi_farthest_rotation(double m[3][3], double quaternion[4]) {
    double k[N][N], vectors[N][N];
    fill(m, k);
    cpsi_symmetric_diagonalise(N, &k[0][0], &vectors[0][0]);
    int most = 0;
    for (int i = 1; i < N; i++)
        if (k[i][i] > k[most][most]) most = i;
    for (int i = 0; i < N; i++) quaternion[i] = vectors[i][most];
    return k[most][most];
}
