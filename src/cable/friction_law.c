/* SPDX-License-Identifier: BSD-3-Clause */
/* Ellipse, box and general set of friction forces (friction_law.h). With B = diag(ratio) an ellipse
 * is B times the disc of radius w: phi(u) = w |B u|, and F = B f with |f| <= w. */
#include "cable/friction_law.h"

#include <math.h>

#include "base/vec3.h"

/* |f||u| + f.u in the plane, without cancellation; their sizes are given. */
static double defect(const double f[2], const double u[2], double size_f, double size_u) {
    return vec3_angle_defect(vec3(-f[0], -f[1], 0), vec3(u[0], u[1], 0), size_f, size_u);
}

/* f with F = B f; 0 where the set has no width. */
static void unmap(const CpsiFrictionLaw *law, const double force[2], double f[2]) {
    for (int a = 0; a < 2; a++) f[a] = law->ratio[a] > 0 ? force[a] / law->ratio[a] : 0;
}

double cpsi_friction_law_gap(const CpsiFrictionLaw *law, double bound, const double force[2],
                             const double slip[2]) {
    if (law->given)
        return cpsi_friction_law_dissipation(law, bound, slip) + force[0] * slip[0] +
               force[1] * slip[1];
    double f[2], u[2], gap = 0;
    unmap(law, force, f);
    for (int a = 0; a < 2; a++) u[a] = law->ratio[a] * slip[a];
    if (!law->box) {
        const double size_f = hypot(f[0], f[1]), size_u = hypot(u[0], u[1]);
        return (bound - size_f) * size_u + defect(f, u, size_f, size_u);
    }
    for (int a = 0; a < 2; a++) {
        const double f1[2] = {f[a], 0}, u1[2] = {u[a], 0};
        gap += (bound - fabs(f[a])) * fabs(u[a]) + defect(f1, u1, fabs(f[a]), fabs(u[a]));
    }
    return gap;
}

double cpsi_friction_law_dissipation(const CpsiFrictionLaw *law, double bound,
                                     const double slip[2]) {
    if (law->given) return bound > 0 ? bound * cpsi_friction_set_phi(law->given, slip) : 0;
    const double u[2] = {law->ratio[0] * slip[0], law->ratio[1] * slip[1]};
    return bound * (law->box ? fabs(u[0]) + fabs(u[1]) : hypot(u[0], u[1]));
}

/* The gauge of the set at F, times w. */
static double size(const CpsiFrictionLaw *law, const double force[2]) {
    double f[2];
    unmap(law, force, f);
    return law->box ? fmax(fabs(f[0]), fabs(f[1])) : hypot(f[0], f[1]);
}

void cpsi_friction_law_clip(const CpsiFrictionLaw *law, double within, double bound,
                            double force[2]) {
    if (law->given) { /* 0 is in it, and the sets are multiples of each other */
        if (within > bound)
            for (int a = 0; a < 2; a++) force[a] *= bound / within;
        return;
    }
    const double found = size(law, force), keep = found > bound ? bound / found : 1;
    for (int a = 0; a < 2; a++) force[a] = law->ratio[a] > 0 ? keep * force[a] : 0;
}

double cpsi_friction_law_margin(const CpsiFrictionLaw *law, double bound, const double force[2]) {
    if (law->given) return 0;
    return fmax(0, bound - size(law, force)) * fmin(law->ratio[0], law->ratio[1]);
}
