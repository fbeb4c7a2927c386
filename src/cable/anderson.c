/* SPDX-License-Identifier: BSD-3-Clause */
/* Anderson acceleration of the rounds (anderson.h).
 *
 * A round moves the nodes from y to G(y), and a fixed point y = G(y) is sought. Near the solution
 * the displacement r = G(y) - y is linear in y, and a round reduces it by a constant factor only,
 * often to a third, because friction has turned with the axes of y. With the changes dr_i, dG_i of
 * the last rounds and
 *
 *     gamma = argmin |r - sum gamma_i dr_i|,      the next y = G(y) - sum gamma_i dG_i
 *
 * (Anderson 1965). This is a secant method: it is exact once the changes span the remaining
 * error. */
#include "cable/anderson.h"

#include <math.h>
#include <string.h>

#include "linalg/dense.h"

/* Changes are linearly dependent where a pivot of their normalised Gram matrix is below this. */
static const double INDEPENDENT = 1e-12;
/* Sum of |gamma| beyond which an extrapolation is not used: the rounds are then not near the
 * solution. */
static const double MAX_EXTRAPOLATION = 10;

void cpsi_anderson_layout(CpsiAnderson *anderson, CpsiArena *arena, int n) {
    double **const all[] = {&anderson->from, &anderson->to, &anderson->displacement};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) CPSI_PLACE(arena, *all[i], 3 * (size_t)n);
    for (int k = 0; k < CPSI_ANDERSON_MEMORY; k++) {
        CPSI_PLACE(arena, anderson->d_to[k], 3 * (size_t)n);
        CPSI_PLACE(arena, anderson->d_displacement[k], 3 * (size_t)n);
    }
}

void cpsi_anderson_start(CpsiAnderson *anderson, int n, const double *place) {
    anderson->count = 0;
    anderson->begun = false;
    memcpy(anderson->from, place, 3 * (size_t)n * sizeof *place);
}

/* Store the newest change in place of the oldest. */
static void store_change(CpsiAnderson *anderson, int n, const double *place) {
    double *to = anderson->d_to[CPSI_ANDERSON_MEMORY - 1],
           *displacement = anderson->d_displacement[CPSI_ANDERSON_MEMORY - 1];
    for (int k = CPSI_ANDERSON_MEMORY - 1; k > 0; k--) {
        anderson->d_to[k] = anderson->d_to[k - 1];
        anderson->d_displacement[k] = anderson->d_displacement[k - 1];
    }
    anderson->d_to[0] = to;
    anderson->d_displacement[0] = displacement;
    for (int i = 0; i < 3 * n; i++) {
        to[i] = place[i] - anderson->to[i];
        displacement[i] = place[i] - anderson->from[i] - anderson->displacement[i];
    }
    if (anderson->count < CPSI_ANDERSON_MEMORY) anderson->count++;
}

/* Scalar product over the nodes of positive weight. */
static double weighted_dot(int n, const double *weight, const double *a, const double *b) {
    double sum = 0;
    for (int j = 0; j < n; j++)
        if (weight[j] > 0) sum += cpsi_dot(3, &a[3 * j], &b[3 * j]);
    return sum;
}

/* gamma for the newest `count` changes; false where they are dependent or the extrapolation goes
 * too far. */
static bool solve_coefficients(const CpsiAnderson *anderson, int n, const double *weight, int count,
                               double *gamma) {
    double m[CPSI_ANDERSON_MEMORY * CPSI_ANDERSON_MEMORY], size[CPSI_ANDERSON_MEMORY],
        l[CPSI_ANDERSON_MEMORY * CPSI_ANDERSON_MEMORY], total = 0;
    int pivot[CPSI_ANDERSON_MEMORY];
    for (int i = 0; i < count; i++) {
        size[i] =
            sqrt(weighted_dot(n, weight, anderson->d_displacement[i], anderson->d_displacement[i]));
        if (!(size[i] > 0)) return false;
        gamma[i] =
            weighted_dot(n, weight, anderson->d_displacement[i], anderson->displacement) / size[i];
    }
    for (int i = 0; i < count; i++)
        for (int k = 0; k < count; k++) {
            m[i * count + k] =
                weighted_dot(n, weight, anderson->d_displacement[i], anderson->d_displacement[k]) /
                (size[i] * size[k]);
            l[i * count + k] = m[i * count + k] - (i == k ? INDEPENDENT : 0);
        }
    double lower[CPSI_ANDERSON_MEMORY * CPSI_ANDERSON_MEMORY];
    if (!cpsi_cholesky(count, l, lower) || !cpsi_lu_factor(count, m, pivot)) return false;
    cpsi_lu_solve(count, m, pivot, gamma);
    for (int i = 0; i < count; i++) {
        gamma[i] /= size[i];
        total += fabs(gamma[i]);
    }
    return total <= MAX_EXTRAPOLATION;
}

void cpsi_anderson_accelerate(CpsiAnderson *anderson, int n, const double *weight, double *place) {
    if (anderson->begun) store_change(anderson, n, place);
    anderson->begun = true;
    for (int i = 0; i < 3 * n; i++) {
        anderson->displacement[i] = place[i] - anderson->from[i];
        anderson->to[i] = place[i];
    }
    double gamma[CPSI_ANDERSON_MEMORY];
    int count = anderson->count;
    while (count > 0 && !solve_coefficients(anderson, n, weight, count, gamma)) count--;
    for (int k = 0; k < count; k++)
        for (int i = 0; i < 3 * n; i++) place[i] -= gamma[k] * anderson->d_to[k][i];
    memcpy(anderson->from, place, 3 * (size_t)n * sizeof *place);
}
