/* SPDX-License-Identifier: BSD-3-Clause */
/* Cones of friction conics, one of each of eight elements side by side in lanes: scaling, steps and
 * corrections (ipm/cone.h). Half-lines and cones of dimension 3 are worked on in lanes, others
 * element by element. */
#ifndef CAPSTAN_SRC_CHAIN_CONE_LANES_H
#define CAPSTAN_SRC_CHAIN_CONE_LANES_H

#include "base/larger.h"
#include "chain/conic_block.h"
#include "ipm/cone.h"

/* One cone of each element: its pairs, scaling and directions. */
typedef struct ConeLanes {
    CpsiLane *s, *z, *w, *q, *ds, *dz;
    double *g;
} ConeLanes;

static ConeLanes cone_of(const CpsiConicBlock *e, int k, int i) {
    return (ConeLanes){&e->s[i], &e->z[i], &e->w[i], &e->q[i], &e->ds[i], &e->dz[i], e->g[k]};
}

/* The d numbers of lane l. */
static inline void cpsi_lanes_take(const int d, CpsiLane *x, int l, double *out) {
    for (int a = 0; a < d; a++) out[a] = x[a][l];
}
static inline void cpsi_lanes_put(const int d, const double *x, int l, CpsiLane *out) {
    for (int a = 0; a < d; a++) out[a][l] = x[a];
}

CPSI_LANES_FUNCTION void scale_half_lines(CpsiLane *restrict s, CpsiLane *restrict z,
                                          CpsiLane *restrict w, double *restrict g) {
    CPSI_FOR_LANES(l) {
        w[0][l] = 1;
        g[l] = z[0][l] / s[0][l];
    }
}
CPSI_LANES_FUNCTION void scale_discs(CpsiLane *restrict s, CpsiLane *restrict z,
                                     CpsiLane *restrict w, double *restrict g) {
    CPSI_FOR_LANES(l) {
        const double one[3] = {s[0][l], s[1][l], s[2][l]}, two[3] = {z[0][l], z[1][l], z[2][l]};
        double out[3];
        g[l] = cpsi_cone_scale(out, one, two, 3);
        for (int a = 0; a < 3; a++) w[a][l] = out[a];
    }
}

/* The scaling of a cone, of dimension d; scratch (3 d). */
static void scale_cone(const CpsiConicBlock *e, ConeLanes x, int d, double *scratch) {
    if (d == 1) {
        scale_half_lines(x.s, x.z, x.w, x.g);
    } else if (d == 3) {
        scale_discs(x.s, x.z, x.w, x.g);
    } else {
        double *s = scratch, *z = s + d, *w = z + d;
        for (int l = e->from; l < e->to; l++) {
            cpsi_lanes_take(d, x.s, l, s);
            cpsi_lanes_take(d, x.z, l, z);
            x.g[l] = cpsi_cone_scale(w, s, z, d);
            cpsi_lanes_put(d, w, l, x.w);
        }
    }
}

/* The axes of W, and 1/sqrt(g). */
CPSI_LANES_FUNCTION void axes_of(int d, CpsiLane *restrict w, const double *restrict g,
                                 CpsiLane *restrict axis, double *restrict root) {
    CpsiLane size = {0};
    for (int a = 1; a < d; a++) CPSI_FOR_LANES(l) size[l] += w[a][l] * w[a][l];
    CPSI_FOR_LANES(l) {
        root[l] = 1 / sqrt(g[l]);
        size[l] = sqrt(size[l]);
        axis[0][l] = w[0][l] + size[l];
    }
    for (int a = 1; a < d; a++) CPSI_FOR_LANES(l) {
            const double none = a == 1, along = w[a][l] / size[l];
            axis[a][l] = size[l] > 0 ? along : none;
        }
}

CPSI_LANES_FUNCTION void step_half_lines(CpsiLane *restrict s, CpsiLane *restrict z,
                                         CpsiLane *restrict ds, CpsiLane *restrict dz,
                                         double *restrict inverse) {
    CPSI_FOR_LANES(l) {
        const double step = cpsi_max_nan(-ds[0][l] / s[0][l], -dz[0][l] / z[0][l]);
        inverse[l] = cpsi_max_nan(inverse[l], step);
    }
}
CPSI_LANES_FUNCTION void step_discs(CpsiLane *restrict s, CpsiLane *restrict z,
                                    CpsiLane *restrict w, const double *restrict g,
                                    CpsiLane *restrict ds, CpsiLane *restrict dz,
                                    double *restrict inverse) {
    CPSI_FOR_LANES(l) {
        const double one[3] = {s[0][l], s[1][l], s[2][l]}, two[3] = {z[0][l], z[1][l], z[2][l]},
                     by[3] = {w[0][l], w[1][l], w[2][l]}, d_one[3] = {ds[0][l], ds[1][l], ds[2][l]},
                     d_two[3] = {dz[0][l], dz[1][l], dz[2][l]};
        double scratch[6];
        const double step = cpsi_cone_step(3, by, g[l], one, two, d_one, d_two, scratch);
        inverse[l] = cpsi_max_nan(inverse[l], step);
    }
}

/* `inverse` becomes the largest 1/alpha; scratch (7 d). */
static void step_cone(const CpsiConicBlock *e, ConeLanes x, int d, double *inverse,
                      double *scratch) {
    if (d == 1) {
        step_half_lines(x.s, x.z, x.ds, x.dz, inverse);
    } else if (d == 3) {
        step_discs(x.s, x.z, x.w, x.g, x.ds, x.dz, inverse);
    } else {
        double *s = scratch, *z = s + d, *w = z + d, *ds = w + d, *dz = ds + d, *rest = dz + d;
        for (int l = e->from; l < e->to; l++) {
            cpsi_lanes_take(d, x.s, l, s);
            cpsi_lanes_take(d, x.z, l, z);
            cpsi_lanes_take(d, x.w, l, w);
            cpsi_lanes_take(d, x.ds, l, ds);
            cpsi_lanes_take(d, x.dz, l, dz);
            inverse[l] = cpsi_max_nan(inverse[l], cpsi_cone_step(d, w, x.g[l], s, z, ds, dz, rest));
        }
    }
}

CPSI_LANES_FUNCTION void correct_half_lines(double target, CpsiLane *restrict q,
                                            CpsiLane *restrict s, CpsiLane *restrict z,
                                            CpsiLane *restrict ds, CpsiLane *restrict dz) {
    CPSI_FOR_LANES(l) q[0][l] = -z[0][l] + (target - ds[0][l] * dz[0][l]) / s[0][l];
}
CPSI_LANES_FUNCTION void correct_discs(double target, CpsiLane *restrict q, CpsiLane *restrict s,
                                       CpsiLane *restrict z, CpsiLane *restrict w,
                                       const double *restrict g, CpsiLane *restrict ds,
                                       CpsiLane *restrict dz) {
    CPSI_FOR_LANES(l) {
        const double one[3] = {s[0][l], s[1][l], s[2][l]}, two[3] = {z[0][l], z[1][l], z[2][l]},
                     by[3] = {w[0][l], w[1][l], w[2][l]}, d_one[3] = {ds[0][l], ds[1][l], ds[2][l]},
                     d_two[3] = {dz[0][l], dz[1][l], dz[2][l]};
        double scratch[12], out[3];
        cpsi_cone_correct(out, 3, by, g[l], one, two, d_one, d_two, cpsi_soc_aim(target, one, two),
                          scratch);
        for (int a = 0; a < 3; a++) q[a][l] = out[a];
    }
}

/* q of the corrector; scratch (10 d). */
static void correct_cone(const CpsiConicBlock *e, ConeLanes x, int d, double target,
                         double *scratch) {
    if (d == 1) {
        correct_half_lines(target, x.q, x.s, x.z, x.ds, x.dz);
    } else if (d == 3) {
        correct_discs(target, x.q, x.s, x.z, x.w, x.g, x.ds, x.dz);
    } else {
        double *s = scratch, *z = s + d, *w = z + d, *ds = w + d, *dz = ds + d, *q = dz + d,
               *rest = q + d;
        for (int l = e->from; l < e->to; l++) {
            cpsi_lanes_take(d, x.s, l, s);
            cpsi_lanes_take(d, x.z, l, z);
            cpsi_lanes_take(d, x.w, l, w);
            cpsi_lanes_take(d, x.ds, l, ds);
            cpsi_lanes_take(d, x.dz, l, dz);
            cpsi_cone_correct(q, d, w, x.g[l], s, z, ds, dz, cpsi_soc_aim(target, s, z), rest);
            cpsi_lanes_put(d, q, l, x.q);
        }
    }
}

#endif
