/* SPDX-License-Identifier: BSD-3-Clause */
/* Points of elements (point.h). */
#include "linsys/point.h"

#include <math.h>

#include "linsys/frame.h"

CpsiPointLaw cpsi_point_law(const CpsiMatrix *a, int j) {
    const double *d = &a->diagonal[6*(a->n + j)], *skew = &a->skew[2*(a->n + j)], *q = &a->frame[9*(a->n + j)];
    /* one turn of Jacobi's */
    const double zeta = d[1] == 0 ? INFINITY : (d[2] - d[0])/(2*d[1]);
    const double tangent = (zeta < 0 ? -1 : 1)/(fabs(zeta) + hypot(1, zeta));
    const double cosine = 1/hypot(1, tangent), sine = cosine*tangent;
    CpsiPointLaw law = {.e = {fmax(0, d[0] - tangent*d[1]), fmax(0, d[2] + tangent*d[1]), d[5]}, .cosine = cosine, .sine = sine};
    for (int i = 0; i < 3; i++) {
        law.axes[i] = cosine*q[i] - sine*q[3 + i];
        law.axes[3 + i] = sine*q[i] + cosine*q[3 + i];
        law.axes[6 + i] = q[6 + i];
        law.size[i] = fmax(1, fabs(law.e[i]));
    }
    if (!(d[5] > 0)) return law;
    law.c[0] = (cosine*skew[0] - sine*skew[1])/d[5];
    law.c[1] = (sine*skew[0] + cosine*skew[1])/d[5];
    return law;
}

void cpsi_point_turn(const CpsiMatrix *a, int node, const double axes[9], double r[9]) {
    cpsi_frame_relative(r, &a->frame[9*node], axes);
}

void cpsi_points_spread(const CpsiMatrix *a, double *x) {
    for (int j = 1; j < a->n; j++) {
        if (!cpsi_point_is_set(a, j)) continue;
        double *force = &x[3*(a->n + j)];
        for (int node = j - 1; node <= j; node++) {
            double r[9], here[3];
            cpsi_point_turn(a, node, &a->frame[9*(a->n + j)], r);
            cpsi_frame_to(here, r, force);
            for (int i = 0; i < 3; i++) x[3*node + i] += (node == j ? a->share[j] : 1 - a->share[j])*here[i];
        }
        for (int i = 0; i < 3; i++) force[i] = 0;
    }
}

static double size3(const double v[3]) { return fabs(v[0]) + fabs(v[1]) + fabs(v[2]); }

void cpsi_points_place(const CpsiMatrix *a, const double *t, double *x) {
    for (int j = 1; j < a->n; j++) {
        double *phi = &x[3*(a->n + j)];
        if (!cpsi_point_is_set(a, j)) {
            phi[0] = phi[1] = phi[2] = 0;
            continue;
        }
        const CpsiPointLaw law = cpsi_point_law(a, j);
        const double b = a->share[j];
        double r[9], near[3], far[3], place[3];
        cpsi_point_turn(a, j - 1, law.axes, r), cpsi_frame_from(near, r, &x[3*(j - 1)]);
        cpsi_point_turn(a, j, law.axes, r), cpsi_frame_from(far, r, &x[3*j]);
        const double places = size3(near) + size3(far), forces = size3(phi) + fabs(t[j]) + a->stiffness[j]*places;
        const double weight = forces > 0 && places > 0 ? forces/places : 1;
        for (int i = 0; i < 3; i++) {
            const double force = phi[i] - (i < 2 ? law.c[i]*phi[2] : 0);
            place[i] = (force + weight*((1 - b)*near[i] + b*far[i]))/(law.e[i] + weight);
        }
        phi[0] = law.cosine*place[0] + law.sine*place[1];
        phi[1] = law.cosine*place[1] - law.sine*place[0];
        phi[2] = place[2];
    }
    for (int i = 0; i < 3; i++) x[3*a->n + i] = 0; /* element 0 is none */
}
