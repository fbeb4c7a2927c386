/* SPDX-License-Identifier: BSD-3-Clause */
/* Hulls of integer points in the plane and in space: the cone of velocities at a point, at the
 * middle of two, inside. */
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "extreme_case.h"

enum { MOST_POINTS = 12 };

typedef struct Points {
    int count, n;
    long x[MOST_POINTS][3];
} Points;

static CpsSet *hull_of(const Points *p) {
    double x[MOST_POINTS * 3];
    CpsSet *set = NULL;
    for (int k = 0; k < p->count; k++)
        for (int i = 0; i < p->n; i++) x[k * p->n + i] = (double)p->x[k][i];
    need(cps_set_hull_of_points(p->n, p->count, x, &set, &err), "hull");
    return set;
}

static Points draw_points(int n) {
    Points p = {.count = n + 2 + below(MOST_POINTS - n - 1), .n = n};
    for (int k = 0; k < p.count; k++) {
        for (int i = 0; i < n; i++) p.x[k][i] = digit(5);
        if (k > 0 && below(6) == 0) memcpy(p.x[k], p.x[below(k)], sizeof p.x[k]);
    }
    return p;
}

/* Normals of the facets through `at` (twice its coordinates, so that middles are integers), by all
 * pairs or triples of points: unit normals once each. Returns how many; *inside: does `at` belong
 * to the hull? *flat: no facet has a side without all. */
static int facets_at(const Points *p, const long *at, double *normals, bool *inside) {
    int count = 0;
    *inside = true;
    for (int a = 0; a < p->count; a++)
        for (int b = 0; b < p->count; b++)
            for (int c = 0; c < (p->n == 3 ? p->count : 1); c++) {
                long m[3] = {0}, least = 0, most = 0, here = 0;
                if (p->n == 2) {
                    m[0] = p->x[b][1] - p->x[a][1];
                    m[1] = p->x[a][0] - p->x[b][0];
                } else {
                    for (int i = 0; i < 3; i++) {
                        const int j = (i + 1) % 3, k = (i + 2) % 3;
                        m[i] = (p->x[b][j] - p->x[a][j]) * (p->x[c][k] - p->x[a][k]) -
                               (p->x[b][k] - p->x[a][k]) * (p->x[c][j] - p->x[a][j]);
                    }
                }
                if (!m[0] && !m[1] && !m[2]) continue;
                for (int k = 0; k < p->count; k++) {
                    long h = 0;
                    for (int i = 0; i < p->n; i++) h += m[i] * (p->x[k][i] - p->x[a][i]);
                    least = h < least ? h : least;
                    most = h > most ? h : most;
                }
                if (most > 0) continue; /* no facet, seen from this side */
                for (int i = 0; i < p->n; i++) here += m[i] * (at[i] - 2 * p->x[a][i]);
                if (here > 0) *inside = false;
                if (here != 0) continue;
                double size = sqrt((double)(m[0] * m[0] + m[1] * m[1] + m[2] * m[2])), unit[3];
                bool known = false;
                for (int i = 0; i < p->n; i++) unit[i] = (double)m[i] / size;
                for (int k = 0; k < count; k++)
                    known = known || dot(p->n, unit, &normals[k * p->n]) > 1 - 1e-12;
                if (!known) memcpy(&normals[count++ * p->n], unit, (size_t)p->n * sizeof *unit);
            }
    return count;
}

/* Rank of unit normals with entries that are not small unless 0. */
static int rank_of(int n, int count, const double *rows) {
    double a[200 * 3];
    int rank = 0;
    memcpy(a, rows, (size_t)(count * n) * sizeof *a);
    for (int j = 0; j < n && rank < count; j++) {
        int best = rank;
        for (int i = rank; i < count; i++)
            if (fabs(a[i * n + j]) > fabs(a[best * n + j])) best = i;
        if (fabs(a[best * n + j]) < 1e-9) continue;
        for (int k = 0; k < n; k++) {
            const double keep = a[rank * n + k];
            a[rank * n + k] = a[best * n + k];
            a[best * n + k] = keep;
        }
        for (int i = rank + 1; i < count; i++) {
            const double factor = a[i * n + j] / a[rank * n + j];
            for (int k = j; k < n; k++) a[i * n + k] -= factor * a[rank * n + k];
        }
        rank++;
    }
    return rank;
}

/* At a point of the set and in the middle of two. The set need not contain 0: velocities are asked
 * of any set of forces. */
static void try_points(int n) {
    const Points p = draw_points(n);
    CpsSet *set = hull_of(&p);
    double normals[200 * 3], force[3];
    for (int trial = 0; trial < 4; trial++) {
        const int one = below(p.count), other = trial < 2 ? one : below(p.count);
        long at[3] = {0};
        bool inside;
        for (int i = 0; i < n; i++) {
            at[i] = p.x[one][i] + p.x[other][i];
            force[i] = 0.5 * (double)at[i];
        }
        const int count = facets_at(&p, at, normals, &inside);
        double outside[3] = {0};
        for (int k = 0; k < count; k++)
            for (int i = 0; i < n; i++)
                outside[i] += normals[k * n + i]; /* a normal itself is no velocity, */
        const double size = sqrt(dot(n, outside, outside));
        for (int i = 0; i < n; i++) outside[i] /= size;
        const int dimension = rank_of(n, count, normals);
        double spread[MOST_POINTS * 3];
        for (int k = 0; k < p.count; k++)
            for (int i = 0; i < n; i++) spread[k * n + i] = (double)(p.x[k][i] - p.x[0][i]);
        bool flat = rank_of(n, p.count, spread) < n; /* but in a flat set it may be */
        for (int k = 0; k < count; k++)
            for (int l = 0; l < count; l++)
                flat = flat || dot(n, &normals[k * n], &normals[l * n]) < -1 + 1e-12;
        if (flat) continue; /* class `lines` has these */
        if (inside)
            compare_cone(set, n, force, count, normals, dimension, count > 0 ? outside : NULL);
    }
    cps_set_release(set);
}

void try_polygon(void) { try_points(2); }
void try_solid(void) { try_points(3); }
