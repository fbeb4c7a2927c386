/* SPDX-License-Identifier: BSD-3-Clause */
/* The dense back end: the same matrix in full, L D L^T without pivoting in the order "all nodes, then all tensions".
 *
 * A quasi-definite matrix has such a factor in every symmetric order (Vanderbei, SIAM J. Optim. 5 (1995)). The unknowns are
 * x_0, ..., x_{n-1} (3 each), then t_1, ..., t_{n-1}. Cost (4n)^3/3: for small lines and for testing the chain. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "linsys/linsys.h"

typedef struct Dense {
    double *l; /* (4n, 4n) lower triangle: L below, D on the diagonal; t_0 is kept as an idle unknown */
    double *b; /* (4n) scratch of a solve */
} Dense;

static CpsiLinsys *dense_layout(CpsiArena *arena, int n) {
    Dense *dense = CPSI_TAKE(arena, 1, Dense);
    const size_t size = 4*(size_t)n;
    double *l = CPSI_TAKE(arena, size*size, double), *b = CPSI_TAKE(arena, size, double);
    if (dense) *dense = (Dense){.l = l, .b = b};
    return (CpsiLinsys *)dense;
}

/* Fill the lower triangle. */
static void dense_fill(Dense *dense, const CpsiMatrix *a) {
    static const int row[6] = {0, 1, 1, 2, 2, 2}, column[6] = {0, 0, 1, 0, 1, 2};
    const int n = a->n;
    const size_t size = 4*(size_t)n;
    double *l = dense->l;
    memset(l, 0, size*size*sizeof *l);
    for (int j = 0; j < n; j++) {
        const size_t xj = 3*(size_t)j, tj = 3*(size_t)n + (size_t)j;
        const double k = j > 0 ? a->stiffness[j] : 0, k_next = j + 1 < n ? a->stiffness[j + 1] : 0;
        /* the node's own block */
        for (size_t i = 0; i < 6; i++) {
            const size_t r = (size_t)row[i], c = (size_t)column[i];
            l[(xj + r)*size + xj + c] = (a->held[j] ? 0 : a->diagonal[6*j + (int)i]) + (r == c ? k + k_next + a->held[j] : 0);
        }
        l[tj*size + tj] = j > 0 ? -a->compliance[j] : -1;
        if (j == 0) continue;
        /* the element before it: stiffness to the node before, and its tension's row */
        for (size_t i = 0; i < 3; i++) {
            if (!a->held[j] && !a->held[j - 1]) l[(xj + i)*size + xj - 3 + i] = -k;
            if (!a->held[j]) l[tj*size + xj + i] = a->direction[3*j + (int)i];
            if (!a->held[j - 1]) l[tj*size + xj - 3 + i] = -a->direction[3*j + (int)i];
        }
    }
}

static bool dense_factor(CpsiLinsys *self, const CpsiMatrix *matrix) {
    Dense *dense = (Dense *)self;
    const size_t size = 4*(size_t)matrix->n;
    double *l = dense->l;
    dense_fill(dense, matrix);
    for (size_t i = 0; i < size; i++) {
        double *li = &l[i*size];
        for (size_t j = 0; j < i; j++) {
            const double *lj = &l[j*size];
            double sum = li[j];
            for (size_t k = 0; k < j; k++) sum -= li[k]*lj[k];
            li[j] = sum; /* L_ij D_j for now */
        }
        const double entry = li[i], least = 4*DBL_EPSILON*fabs(entry);
        double pivot = entry;
        for (size_t j = 0; j < i; j++) {
            const double scaled = li[j]/l[j*size + j];
            pivot -= scaled*li[j];
            li[j] = scaled;
        }
        /* a pivot lost to rounding is lifted to the rounding level */
        if (fabs(pivot) < least) pivot = entry < 0 ? -least : least;
        if (!isfinite(pivot) || pivot == 0) return false;
        li[i] = pivot;
    }
    return true;
}

static void dense_solve(const CpsiLinsys *self, const CpsiMatrix *matrix, double *x, double *t) {
    const Dense *dense = (const Dense *)self;
    const size_t n = (size_t)matrix->n, size = 4*n;
    const double *l = dense->l;
    double *b = dense->b;
    /* the right-hand side, held nodes and t_0 at zero */
    for (size_t j = 0; j < n; j++)
        for (size_t i = 0; i < 3; i++) b[3*j + i] = matrix->held[j] ? 0 : x[3*j + i];
    for (size_t j = 0; j < n; j++) b[3*n + j] = j > 0 ? t[j] : 0;
    /* L y = b, D z = y, L^T x = z */
    for (size_t i = 0; i < size; i++)
        for (size_t j = 0; j < i; j++) b[i] -= l[i*size + j]*b[j];
    for (size_t i = 0; i < size; i++) b[i] /= l[i*size + i];
    for (size_t i = size; i-- > 0;)
        for (size_t j = i + 1; j < size; j++) b[i] -= l[j*size + i]*b[j];
    memcpy(x, b, 3*n*sizeof *x);
    memcpy(t, b + 3*n, n*sizeof *t);
}

const CpsiLinsysOps cpsi_linsys_dense = {"dense", dense_layout, dense_factor, dense_solve};
