/* SPDX-License-Identifier: BSD-3-Clause */
/* Q R of eight small matrices (m, n), m >= n, side by side in lanes (base/lanes.h), with rows
 * sorted by size and columns by what remains of them. With both orders a row keeps its relative
 * accuracy, however small it is beside the others (Cox and Higham 1998). So each lane has orders of
 * its own; the lanes `from` to `to` - 1 count, the others hold anything. */
#ifndef CAPSTAN_SRC_CHAIN_QR_LANES_H
#define CAPSTAN_SRC_CHAIN_QR_LANES_H

#include <string.h>

#include "base/lanes.h"

typedef struct CpsiLanesQr {
    int m, n, from, to;
    CpsiLane *a;           /* (m, n) R on and above the diagonal, below it the reflections */
    CpsiLane *beta;        /* (n) */
    CpsiIndexLane *row;    /* (m) the row of the matrix that row i of its factor is */
    CpsiIndexLane *column; /* (n) */
} CpsiLanesQr;

/* out[i] = x[index[i]], and out[index[i]] = x[i] */
static inline void cpsi_lanes_permute(const CpsiLanesQr *qr, int n, CpsiIndexLane *index,
                                      CpsiLane *x, CpsiLane *out) {
    for (int i = 0; i < n; i++)
        for (int l = qr->from; l < qr->to; l++) out[i][l] = x[index[i][l]][l];
}
static inline void cpsi_lanes_permute_back(const CpsiLanesQr *qr, int n, CpsiIndexLane *index,
                                           CpsiLane *x, CpsiLane *out) {
    for (int i = 0; i < n; i++)
        for (int l = qr->from; l < qr->to; l++) out[index[i][l]][l] = x[i][l];
}

/* The largest entry of each row. */
CPSI_LANES_FUNCTION void qr_row_sizes(int m, int n, CpsiLane *restrict a, CpsiLane *restrict size) {
    for (int i = 0; i < m; i++) {
        CPSI_FOR_LANES(l) size[i][l] = 0;
        for (int j = 0; j < n; j++) CPSI_FOR_LANES(l) {
                const double entry = fabs(a[i * n + j][l]);
                size[i][l] = entry > size[i][l] ? entry : size[i][l];
            }
    }
}

/* Rows by decreasing size. scratch (m n) */
static inline void qr_sort_rows(CpsiLanesQr *qr, CpsiLane *size, CpsiLane *scratch) {
    const int m = qr->m, n = qr->n;
    qr_row_sizes(m, n, qr->a, size);
    memcpy(scratch, qr->a, (size_t)(m * n) * sizeof *scratch);
    for (int l = qr->from; l < qr->to; l++) {
        for (int i = 0; i < m; i++) {
            int k = i;
            for (; k > 0 && size[i][l] > size[qr->row[k - 1][l]][l]; k--)
                qr->row[k][l] = qr->row[k - 1][l];
            qr->row[k][l] = i;
        }
        for (int i = 0; i < m; i++)
            for (int j = 0; j < n; j++) qr->a[i * n + j][l] = scratch[qr->row[i][l] * n + j][l];
    }
}

/* |column j below row k|^2 */
CPSI_LANES_PART void qr_column_size(int m, int n, CpsiLane *restrict a, int k, int j,
                                    CpsiLane out) {
    CpsiLane sum = {0};
    for (int i = k; i < m; i++) CPSI_FOR_LANES(l) sum[l] += a[i * n + j][l] * a[i * n + j][l];
    CPSI_FOR_LANES(l) out[l] = sum[l];
}

/* The largest of the columns from k on, and the square of its size. */
CPSI_LANES_FUNCTION void qr_choose(int m, int n, CpsiLane *restrict a, int k, double *restrict best,
                                   double *restrict most) {
    CPSI_FOR_LANES(l) {
        best[l] = k;
        most[l] = -1;
    }
    for (int j = k; j < n; j++) {
        CpsiLane size;
        qr_column_size(m, n, a, k, j, size);
        CPSI_FOR_LANES(l) {
            best[l] = size[l] > most[l] ? j : best[l];
            most[l] = size[l] > most[l] ? size[l] : most[l];
        }
    }
}

/* Exchange columns k and j in the lanes where j is the best. */
CPSI_LANES_FUNCTION void qr_exchange(int m, int n, CpsiLane *restrict a, int k, int j,
                                     const double *restrict best) {
    for (int i = 0; i < m; i++) CPSI_FOR_LANES(l) {
            const double one = a[i * n + k][l], two = a[i * n + j][l];
            a[i * n + k][l] = best[l] == j ? two : one;
            a[i * n + j][l] = best[l] == j ? one : two;
        }
}

/* x -= beta v (v.x), v = (1, ..) from row k on, in column k of a; x with a stride */
CPSI_LANES_FUNCTION void qr_reflect(int m, int n, CpsiLane *restrict a, const double *restrict beta,
                                    int k, CpsiLane *restrict x, int stride) {
    CpsiLane sum;
    CPSI_FOR_LANES(l) sum[l] = x[k * stride][l];
    for (int i = k + 1; i < m; i++) CPSI_FOR_LANES(l) sum[l] += a[i * n + k][l] * x[i * stride][l];
    CPSI_FOR_LANES(l) sum[l] *= beta[l];
    CPSI_FOR_LANES(l) x[k * stride][l] -= sum[l];
    for (int i = k + 1; i < m; i++) CPSI_FOR_LANES(l) x[i * stride][l] -= sum[l] * a[i * n + k][l];
}

/* Column k becomes (r, v): the reflection I - beta v v' takes it to (r, 0, ..); `square` is that of
 * its size. */
CPSI_LANES_FUNCTION void qr_reflection(int m, int n, CpsiLane *restrict a, int k,
                                       const double *restrict square, double *restrict beta) {
    CpsiLane below;
    CPSI_FOR_LANES(l) {
        const double size = sqrt(square[l]), x = a[k * n + k][l], r = x > 0 ? -size : size;
        beta[l] = 1 - x / r;
        below[l] = x - r;
        a[k * n + k][l] = r;
    }
    for (int i = k + 1; i < m; i++) CPSI_FOR_LANES(l) a[i * n + k][l] /= below[l];
}

/* Factor the matrices in qr->a. singular[l]: the rank is less than n, or entries are not finite.
 * scratch (m n + m) */
static inline void cpsi_lanes_qr_factor(CpsiLanesQr *qr, bool singular[CPSI_LANES],
                                        CpsiLane *scratch) {
    const int m = qr->m, n = qr->n;
    CpsiLane best, most;
    qr_sort_rows(qr, scratch, scratch + m);
    for (int j = 0; j < n; j++) CPSI_FOR_LANES(l) qr->column[j][l] = j;
    CPSI_FOR_LANES(l) singular[l] = false;
    for (int k = 0; k < n; k++) {
        CpsiLane *trailing = qr->a;
        qr_choose(m, n, trailing, k, best, most);
        for (int j = k + 1; j < n; j++) qr_exchange(m, n, trailing, k, j, best);
        for (int l = qr->from; l < qr->to; l++) {
            const int chosen = (int)best[l], keep = qr->column[k][l];
            qr->column[k][l] = qr->column[chosen][l];
            qr->column[chosen][l] = keep;
            if (!(most[l] > 0) || !isfinite(most[l])) singular[l] = true;
        }
        qr_reflection(m, n, trailing, k, most, qr->beta[k]);
        /* column k, which is read, is none of the others */
        for (int j = k + 1; j < n; j++) qr_reflect(m, n, trailing, qr->beta[k], k, &trailing[j], n);
    }
}

/* x = Q'x, its rows in the order of the factor; and x = Q x */
static inline void cpsi_lanes_qr_to(const CpsiLanesQr *qr, CpsiLane *x) {
    for (int k = 0; k < qr->n; k++) qr_reflect(qr->m, qr->n, qr->a, qr->beta[k], k, x, 1);
}
static inline void cpsi_lanes_qr_from(const CpsiLanesQr *qr, CpsiLane *x) {
    for (int k = qr->n - 1; k >= 0; k--) qr_reflect(qr->m, qr->n, qr->a, qr->beta[k], k, x, 1);
}

/* x = R^-1 x; x = R^-T x; the unknowns in the order of the columns of the factor */
CPSI_LANES_FUNCTION void cpsi_lanes_qr_solve(int n, CpsiLane *restrict a, CpsiLane *restrict x) {
    for (int i = n - 1; i >= 0; i--) {
        for (int j = i + 1; j < n; j++) CPSI_FOR_LANES(l) x[i][l] -= a[i * n + j][l] * x[j][l];
        CPSI_FOR_LANES(l) x[i][l] /= a[i * n + i][l];
    }
}
CPSI_LANES_FUNCTION void cpsi_lanes_qr_solve_transposed(int n, CpsiLane *restrict a,
                                                        CpsiLane *restrict x) {
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < i; j++) CPSI_FOR_LANES(l) x[i][l] -= a[j * n + i][l] * x[j][l];
        CPSI_FOR_LANES(l) x[i][l] /= a[i * n + i][l];
    }
}

#endif
