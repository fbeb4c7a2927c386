/* SPDX-License-Identifier: BSD-3-Clause */
/* Residuals of the chain's equations (residual.h). */
#include "chain/residual.h"

#include <string.h>

#include "chain/frame.h"
#include "chain/point.h"

/* Subtract the terms of node j alone. */
static void subtract_node(const CpsiMatrix *a, int j, const CpsiUnknowns *unknowns,
                          const CpsiUnknowns *right) {
    const double *d = &a->diagonal[6 * j], *skew = &a->skew[2 * j], *u = &unknowns->x[3 * j];
    double *r = &right->x[3 * j];
    r[0] -= d[0] * u[0] + d[1] * u[1] + (d[3] + skew[0]) * u[2];
    r[1] -= d[1] * u[0] + d[2] * u[1] + (d[4] + skew[1]) * u[2];
    r[2] -= d[3] * u[0] + d[4] * u[1] + d[5] * u[2];
    if (!unknowns->f || !cpsi_second_is_set(a->second, j)) return;
    right->f[j] += a->second->compliance[j] * unknowns->f[j];
    for (int i = 0; i < 3; i++) {
        r[i] -= a->second->column[3 * j + i] * unknowns->f[j];
        right->f[j] -= a->second->row[3 * j + i] * u[i];
    }
}

/* Add by x v, a vector of the common axes, to that of node j. */
static void add_common(const CpsiMatrix *a, int j, double by, const double v[3], double *r) {
    double own[3];
    cpsi_frame_to(own, &a->frame[9 * j], v);
    for (int i = 0; i < 3; i++) r[3 * j + i] += by * own[i];
}

/* Subtract the terms of element j: its force on both nodes, and its own equation. */
static void subtract_element(const CpsiMatrix *a, int j, const double *x, const double *t,
                             double *r_x, double *r_t) {
    const double *m = &a->direction[3 * j];
    double far[3], near[3], pull[3];
    cpsi_frame_from(far, &a->frame[9 * j], &x[3 * j]);
    cpsi_frame_from(near, &a->frame[9 * (j - 1)], &x[3 * (j - 1)]);
    r_t[j] += a->compliance[j] * t[j];
    for (int i = 0; i < 3; i++) {
        const double d = far[i] - near[i];
        pull[i] = a->stiffness[j] * d + m[i] * t[j];
        r_t[j] -= m[i] * d;
    }
    add_common(a, j, -1, pull, r_x);
    add_common(a, j - 1, 1, pull, r_x);
}

/* Subtract the terms of the point of element j: its force on both nodes, and its own equations. */
static void subtract_point(const CpsiMatrix *a, int j, const double *x, double *r_x) {
    const CpsiPointLaw law = cpsi_point_law(a, j);
    const double *phi = &x[3 * (a->n + j)];
    double place[3] = {0}, *own = &r_x[3 * (a->n + j)];
    for (int node = j - 1; node <= j; node++) {
        const double share = node == j ? a->share[j] : 1 - a->share[j];
        double r[9], force[3], here[3];
        cpsi_point_turn(a, node, law.axes, r);
        cpsi_frame_to(force, r, phi);
        cpsi_frame_from(here, r, &x[3 * node]);
        for (int i = 0; i < 3; i++) {
            r_x[3 * node + i] -= share * force[i];
            place[i] += share * here[i];
        }
    }
    for (int i = 0; i < 3; i++)
        own[i] -= law.e[i] / law.size[i] * place[i] -
                  (phi[i] - (i < 2 ? law.c[i] * phi[2] : 0)) / law.size[i];
}

void cpsi_linsys_residual(const CpsiMatrix *a, const CpsiUnknowns *unknowns,
                          const CpsiUnknowns *right) {
    for (int j = 0; j < a->n; j++) {
        subtract_node(a, j, unknowns, right);
        if (j > 0) subtract_element(a, j, unknowns->x, unknowns->t, right->x, right->t);
        if (cpsi_point_is_set(a, j)) subtract_point(a, j, unknowns->x, right->x);
    }
    for (int j = 0; j < a->n; j++) {
        if (!a->held[j]) continue;
        for (int i = 0; i < 3; i++) right->x[3 * j + i] = 0;
        if (right->f) right->f[j] = 0;
    }
}

void cpsi_linsys_solve_points(const CpsiLinsys *self, const CpsiMatrix *a, CpsiPass *pass,
                              const CpsiUnknowns *found, const CpsiUnknowns scratch[2]) {
    const size_t n = (size_t)a->n;
    const CpsiUnknowns *right = &scratch[0],
                       rest = {scratch[1].x, scratch[1].t, found->f ? scratch[1].f : NULL};
    cpsi_points_spread(a, found->x);
    memcpy(right->x, found->x, 6 * n * sizeof *right->x);
    memcpy(right->t, found->t, n * sizeof *right->t);
    pass(self, a, found);
    memcpy(rest.x, right->x, 6 * n * sizeof *rest.x);
    memcpy(rest.t, right->t, n * sizeof *rest.t);
    if (rest.f) memset(rest.f, 0, n * sizeof *rest.f);
    cpsi_linsys_residual(a, found, &rest);
    pass(self, a, &rest);
    for (size_t i = 0; i < 6 * n; i++) found->x[i] += rest.x[i];
    for (size_t i = 0; i < n; i++) found->t[i] += rest.t[i];
    for (size_t i = 0; i < n && rest.f; i++) found->f[i] += rest.f[i];
    cpsi_points_place(a, found->t, found->x);
}
