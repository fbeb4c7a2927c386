/* SPDX-License-Identifier: BSD-3-Clause */
/* Rounds that look ahead (ahead.h).
 *
 * A round takes the nodes from places y to G(y), and y = G(y) is sought. Near the solution the way
 * r = G(y) - y is linear in y, and a round leaves a fixed share of it, often a third: friction has
 * turned with the axes of y. With the changes dr_i, dG_i of the last rounds and
 *
 *     gamma = argmin |r - sum gamma_i dr_i|,      the next y = G(y) - sum gamma_i dG_i
 *
 * (Anderson 1965), a secant method: exact once the changes span what is left. */
#include "cable/ahead.h"

#include <math.h>
#include <string.h>

#include "linsys/small.h"

/* Changes this nearly dependent add nothing. */
static const double INDEPENDENT = 1e-12;
/* No foresight goes farther than this many times the ways known: it is no longer near the
 * solution. */
static const double FAR = 10;

void cpsi_ahead_layout(CpsiAhead *ahead, CpsiArena *arena, int n) {
    double **const all[] = {&ahead->from, &ahead->to, &ahead->way};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        *all[i] = CPSI_TAKE(arena, 3 * (size_t)n, double);
    for (int k = 0; k < CPSI_AHEAD_KEPT; k++) {
        ahead->d_to[k] = CPSI_TAKE(arena, 3 * (size_t)n, double);
        ahead->d_way[k] = CPSI_TAKE(arena, 3 * (size_t)n, double);
    }
}

void cpsi_ahead_start(CpsiAhead *ahead, int n, const double *place) {
    ahead->kept = 0;
    ahead->begun = false;
    memcpy(ahead->from, place, 3 * (size_t)n * sizeof *place);
}

/* The oldest change makes room for the newest. */
static void keep_change(CpsiAhead *ahead, int n, const double *place) {
    double *to = ahead->d_to[CPSI_AHEAD_KEPT - 1], *way = ahead->d_way[CPSI_AHEAD_KEPT - 1];
    for (int k = CPSI_AHEAD_KEPT - 1; k > 0; k--) {
        ahead->d_to[k] = ahead->d_to[k - 1];
        ahead->d_way[k] = ahead->d_way[k - 1];
    }
    ahead->d_to[0] = to;
    ahead->d_way[0] = way;
    for (int i = 0; i < 3 * n; i++) {
        to[i] = place[i] - ahead->to[i];
        way[i] = place[i] - ahead->from[i] - ahead->way[i];
    }
    if (ahead->kept < CPSI_AHEAD_KEPT) ahead->kept++;
}

/* Product over the nodes that count. */
static double weighed(int n, const double *weight, const double *a, const double *b) {
    double sum = 0;
    for (int j = 0; j < n; j++)
        if (weight[j] > 0) sum += cpsi_dot(3, &a[3 * j], &b[3 * j]);
    return sum;
}

/* gamma of the newest `count` changes; false where they are dependent or lead too far. */
static bool mix(const CpsiAhead *ahead, int n, const double *weight, int count, double *gamma) {
    double m[CPSI_AHEAD_KEPT * CPSI_AHEAD_KEPT], size[CPSI_AHEAD_KEPT],
        l[CPSI_AHEAD_KEPT * CPSI_AHEAD_KEPT], total = 0;
    int pivot[CPSI_AHEAD_KEPT];
    for (int i = 0; i < count; i++) {
        size[i] = sqrt(weighed(n, weight, ahead->d_way[i], ahead->d_way[i]));
        if (!(size[i] > 0)) return false;
        gamma[i] = weighed(n, weight, ahead->d_way[i], ahead->way) / size[i];
    }
    for (int i = 0; i < count; i++)
        for (int k = 0; k < count; k++) {
            m[i * count + k] =
                weighed(n, weight, ahead->d_way[i], ahead->d_way[k]) / (size[i] * size[k]);
            l[i * count + k] = m[i * count + k] - (i == k ? INDEPENDENT : 0);
        }
    double lower[CPSI_AHEAD_KEPT * CPSI_AHEAD_KEPT];
    if (!cpsi_cholesky(count, l, lower) || !cpsi_lu_factor(count, m, pivot)) return false;
    cpsi_lu_solve(count, m, pivot, gamma);
    for (int i = 0; i < count; i++) {
        gamma[i] /= size[i];
        total += fabs(gamma[i]);
    }
    return total <= FAR;
}

void cpsi_ahead_foresee(CpsiAhead *ahead, int n, const double *weight, double *place) {
    if (ahead->begun) keep_change(ahead, n, place);
    ahead->begun = true;
    for (int i = 0; i < 3 * n; i++) {
        ahead->way[i] = place[i] - ahead->from[i];
        ahead->to[i] = place[i];
    }
    double gamma[CPSI_AHEAD_KEPT];
    int count = ahead->kept;
    while (count > 0 && !mix(ahead, n, weight, count, gamma)) count--;
    for (int k = 0; k < count; k++)
        for (int i = 0; i < 3 * n; i++) place[i] -= gamma[k] * ahead->d_to[k][i];
    memcpy(ahead->from, place, 3 * (size_t)n * sizeof *place);
}
