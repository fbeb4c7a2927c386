/* SPDX-License-Identifier: BSD-3-Clause */
/* The chain back end: block tridiagonal elimination, one node at a time, each node before the tension that hangs on it.
 *
 * Take the unknowns as blocks (x_j, t_j). Eliminating blocks 0..j-1 leaves on block j the 4 x 4 matrix
 *
 *     S_j = [ X   v ; v^T  -b ],   X = D_j + (k_j + k_{j+1}) I - k_j^2 C,   v = m_j - k_j C m_j,   b = a_j + m_j.C m_j,
 *
 * where C = (S_{j-1}^-1)_xx is the compliance of all that lies before, seen at node j-1 (0 where it is held). With
 * Y = X^-1, y = Y v, beta = b + v.y:
 *
 *     (S_j^-1)_xx = Y - y y^T/beta = C_j,      (S_j^-1)_xt = y/beta,      (S_j^-1)_tt = -1/beta.
 *
 * So one pass keeps three small quantities per node, and a solve is two passes of 3 x 3 products. Compliances in series add
 * without cancellation, which is why the tension is kept: an element's own stiffness 1/a_j never meets k_j in one number. */
#include <float.h>
#include <math.h>

#include "linsys/linsys.h"

/* The factor of one node: 80 bytes that every pass reads together. */
typedef struct ChainBlock {
    double c[6];   /* C_j as xx, xy, yy, xz, yz, zz */
    double y[3];   /* y/beta */
    double tt;     /* 1/beta */
} ChainBlock;

typedef struct Chain {
    ChainBlock *block; /* (n) */
} Chain;

static CpsiLinsys *chain_layout(CpsiArena *arena, int n) {
    Chain *chain = CPSI_TAKE(arena, 1, Chain);
    ChainBlock *block = CPSI_TAKE(arena, n, ChainBlock);
    if (chain) *chain = (Chain){.block = block};
    return (CpsiLinsys *)chain;
}

/* out = A x for symmetric A (6). */
static inline void sym_apply(double out[3], const double a[6], const double x[3]) {
    out[0] = a[0]*x[0] + a[1]*x[1] + a[3]*x[2];
    out[1] = a[1]*x[0] + a[2]*x[1] + a[4]*x[2];
    out[2] = a[3]*x[0] + a[4]*x[1] + a[5]*x[2];
}

/* out = A^-1 for symmetric positive A (6), by L D L^T in the order z, y, x: along z stands the obstacle's normal, the
 * stiffest direction where there is contact. A pivot lost to rounding is lifted to the rounding level. */
static inline void sym_inverse(double out[6], const double a[6]) {
    const double tiny = 4*DBL_EPSILON, least = DBL_MIN/DBL_EPSILON;
    const double dz = a[5] > least ? a[5] : least, iz = 1/dz;
    const double lxz = a[3]*iz, lyz = a[4]*iz;
    double dy = a[2] - a[4]*lyz;
    dy = dy > tiny*a[2] ? dy : tiny*a[2] + least;
    const double iy = 1/dy, ayx = a[1] - a[3]*lyz, lxy = ayx*iy;
    double dx = a[0] - a[3]*lxz - ayx*lxy;
    dx = dx > tiny*a[0] ? dx : tiny*a[0] + least;
    /* A^-1 = L^-T D^-1 L^-1 with x eliminated last */
    const double ix = 1/dx, mxz = lxy*lyz - lxz;
    out[0] = ix;
    out[1] = -lxy*ix;
    out[2] = iy + lxy*lxy*ix;
    out[3] = mxz*ix;
    out[4] = -lyz*iy - lxy*mxz*ix;
    out[5] = iz + lyz*lyz*iy + mxz*mxz*ix;
}

static bool chain_factor(CpsiLinsys *self, const CpsiMatrix *a) {
    Chain *chain = (Chain *)self;
    const int n = a->n;
    static const double zero[6] = {0};
    const double *c = zero;
    double check = 0;
    for (int j = 0; j < n; j++) {
        ChainBlock *block = &chain->block[j];
        const double *m = &a->direction[3*j], *d = &a->diagonal[6*j];
        const double k = j > 0 ? a->stiffness[j] : 0, k_next = j + 1 < n ? a->stiffness[j + 1] : 0;
        double x[6], v[3] = {0, 0, 0}, beta = 1;
        /* what the chain before leaves on this node and its tension */
        for (int i = 0; i < 6; i++) x[i] = d[i] - k*k*c[i];
        x[0] += k + k_next, x[2] += k + k_next, x[5] += k + k_next;
        if (j > 0) {
            double cm[3];
            sym_apply(cm, c, m);
            for (int i = 0; i < 3; i++) v[i] = m[i] - k*cm[i];
            const double series = m[0]*cm[0] + m[1]*cm[1] + m[2]*cm[2];
            beta = a->compliance[j] + (series > 0 ? series : 0);
        }
        if (a->held[j]) {
            for (int i = 0; i < 6; i++) block->c[i] = 0;
            for (int i = 0; i < 3; i++) block->y[i] = 0;
            block->tt = 1/beta;
        } else {
            double inverse[6], y[3];
            sym_inverse(inverse, x);
            sym_apply(y, inverse, v);
            beta += v[0]*y[0] + v[1]*y[1] + v[2]*y[2];
            const double ib = 1/beta;
            for (int i = 0; i < 3; i++) block->y[i] = y[i]*ib;
            const double *b = block->y;
            block->c[0] = inverse[0] - y[0]*b[0], block->c[1] = inverse[1] - y[0]*b[1];
            block->c[2] = inverse[2] - y[1]*b[1], block->c[3] = inverse[3] - y[0]*b[2];
            block->c[4] = inverse[4] - y[1]*b[2], block->c[5] = inverse[5] - y[2]*b[2];
            block->tt = ib;
        }
        c = block->c;
        check += block->tt + c[0] + c[2] + c[5];
    }
    return isfinite(check);
}

static void chain_solve(const CpsiLinsys *self, const CpsiMatrix *a, double *x, double *t) {
    const Chain *chain = (const Chain *)self;
    const int n = a->n;
    /* forward: x_j, t_j as if nothing came after */
    double before[3] = {0, 0, 0};
    for (int j = 0; j < n; j++) {
        const ChainBlock *block = &chain->block[j];
        const double *m = &a->direction[3*j], *y = block->y;
        double *xj = &x[3*j], f[3], h = 0;
        const double k = j > 0 ? a->stiffness[j] : 0;
        for (int i = 0; i < 3; i++) f[i] = a->held[j] ? 0 : xj[i] + k*before[i];
        if (j > 0) h = t[j] + m[0]*before[0] + m[1]*before[1] + m[2]*before[2];
        sym_apply(xj, block->c, f);
        for (int i = 0; i < 3; i++) before[i] = xj[i] += y[i]*h;
        t[j] = j > 0 ? y[0]*f[0] + y[1]*f[1] + y[2]*f[2] - block->tt*h : 0;
    }
    /* backward: what comes after pulls on node j with k_{j+1} x_{j+1} + m_{j+1} t_{j+1} */
    for (int j = n - 2; j >= 0; j--) {
        const ChainBlock *block = &chain->block[j];
        const double *m = &a->direction[3*(j + 1)], *y = block->y, k = a->stiffness[j + 1], tension = t[j + 1];
        double *xj = &x[3*j], pull[3], dx[3];
        for (int i = 0; i < 3; i++) pull[i] = k*xj[3 + i] + m[i]*tension;
        sym_apply(dx, block->c, pull);
        for (int i = 0; i < 3; i++) xj[i] += dx[i];
        if (j > 0) t[j] += y[0]*pull[0] + y[1]*pull[1] + y[2]*pull[2];
    }
}

const CpsiLinsysOps cpsi_linsys_chain = {"chain", chain_layout, chain_factor, chain_solve};
