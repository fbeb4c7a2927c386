/* SPDX-License-Identifier: BSD-3-Clause */
/* Points of elements (point.h). */
#include "chain/point.h"

#include <float.h>
#include <math.h>

#include "chain/frame.h"

/* Sweeps of Jacobi's method at most; a 3 x 3 matrix converges in four or five. */
enum { SWEEPS = 10 };

/* Is the off-diagonal entry (p, q) of the symmetric m (3, 3) below the rounding of the diagonal? */
static bool is_diagonal(const double m[9], int p, int q) {
    return fabs(m[3 * p + q]) <= DBL_EPSILON * sqrt(fabs(m[4 * p] * m[4 * q]));
}

/* One Jacobi rotation in the plane of p and q: m becomes J m J^T with m_pq = 0, and turn becomes J
 * turn. */
static void turn_plane(double m[9], double turn[9], int p, int q) {
    const double zeta = m[3 * p + q] == 0 ? INFINITY : (m[4 * q] - m[4 * p]) / (2 * m[3 * p + q]);
    const double t = (zeta < 0 ? -1 : 1) / (fabs(zeta) + hypot(1, zeta)), c = 1 / hypot(1, t),
                 s = c * t;
    const int r = 3 - p - q;
    const double pq = m[3 * p + q], pr = m[3 * p + r], qr = m[3 * q + r];
    m[4 * p] -= t * pq;
    m[4 * q] += t * pq;
    m[3 * p + q] = m[3 * q + p] = 0;
    m[3 * p + r] = m[3 * r + p] = c * pr - s * qr;
    m[3 * q + r] = m[3 * r + q] = s * pr + c * qr;
    for (int i = 0; i < 3; i++) {
        const double a = turn[3 * p + i], b = turn[3 * q + i];
        turn[3 * p + i] = c * a - s * b;
        turn[3 * q + i] = s * a + c * b;
    }
}

CpsiPointLaw cpsi_point_law(const CpsiMatrix *a, int j) {
    const double *d = &a->diagonal[6 * (a->n + j)], *skew = &a->skew[2 * (a->n + j)],
                 *q = &a->frame[9 * (a->n + j)];
    double m[9] = {d[0], d[1], d[3], d[1], d[2], d[4], d[3], d[4], d[5]};
    CpsiPointLaw law = {.turn = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    turn_plane(m, law.turn, 0, 1);
    for (int i = 0;
         i < SWEEPS && !(is_diagonal(m, 0, 1) && is_diagonal(m, 0, 2) && is_diagonal(m, 1, 2));
         i++) {
        turn_plane(m, law.turn, 0, 2);
        turn_plane(m, law.turn, 1, 2);
        turn_plane(m, law.turn, 0, 1);
    }
    for (int i = 0; i < 3; i++) {
        law.e[i] = i < 2 || d[3] != 0 || d[4] != 0 ? fmax(0, m[4 * i]) : m[8];
        for (int k = 0; k < 3; k++)
            law.axes[3 * i + k] = law.turn[3 * i] * q[k] + law.turn[3 * i + 1] * q[3 + k] +
                                  law.turn[3 * i + 2] * q[6 + k];
        law.size[i] = fmax(1, fabs(law.e[i]));
    }
    if (d[5] > 0)
        for (int i = 0; i < 2; i++)
            law.c[i] = (law.turn[3 * i] * skew[0] + law.turn[3 * i + 1] * skew[1]) / d[5];
    return law;
}

void cpsi_point_turn(const CpsiMatrix *a, int node, const double axes[9], double r[9]) {
    cpsi_frame_relative(r, &a->frame[9 * node], axes);
}

void cpsi_points_spread(const CpsiMatrix *a, double *x) {
    for (int j = 1; j < a->n; j++) {
        if (!cpsi_point_is_set(a, j)) continue;
        double *force = &x[3 * (a->n + j)];
        for (int node = j - 1; node <= j; node++) {
            double r[9], here[3];
            cpsi_point_turn(a, node, &a->frame[9 * (a->n + j)], r);
            cpsi_frame_to(here, r, force);
            for (int i = 0; i < 3; i++)
                x[3 * node + i] += (node == j ? a->share[j] : 1 - a->share[j]) * here[i];
        }
        for (int i = 0; i < 3; i++) force[i] = 0;
    }
}

static double size3(const double v[3]) { return fabs(v[0]) + fabs(v[1]) + fabs(v[2]); }

void cpsi_points_place(const CpsiMatrix *a, const double *t, double *x) {
    for (int j = 1; j < a->n; j++) {
        double *phi = &x[3 * (a->n + j)];
        if (!cpsi_point_is_set(a, j)) {
            phi[0] = phi[1] = phi[2] = 0;
            continue;
        }
        const CpsiPointLaw law = cpsi_point_law(a, j);
        const double b = a->share[j];
        double r[9], near[3], far[3], place[3];
        cpsi_point_turn(a, j - 1, law.axes, r);
        cpsi_frame_from(near, r, &x[3 * (j - 1)]);
        cpsi_point_turn(a, j, law.axes, r);
        cpsi_frame_from(far, r, &x[3 * j]);
        const double places = size3(near) + size3(far),
                     forces = size3(phi) + fabs(t[j]) + a->stiffness[j] * places;
        const double weight = forces > 0 && places > 0 ? forces / places : 1;
        for (int i = 0; i < 3; i++) {
            const double force = phi[i] - (i < 2 ? law.c[i] * phi[2] : 0);
            place[i] = (force + weight * ((1 - b) * near[i] + b * far[i])) / (law.e[i] + weight);
        }
        cpsi_frame_from(phi, law.turn, place);
    }
    for (int i = 0; i < 3; i++) x[3 * a->n + i] = 0; /* there is no element 0 */
}
