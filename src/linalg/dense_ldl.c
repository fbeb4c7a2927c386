/* SPDX-License-Identifier: BSD-3-Clause */
/* Panels of columns, each eliminated within itself and then, packed by four rows, from all columns
 * behind it: so most of the work are products of small blocks that stay in registers. */
#include "linalg/dense_ldl.h"

#include <math.h>

enum { ROWS = CPSI_DENSE_ROWS, PANEL = CPSI_DENSE_PANEL };

/* What all steps share. */
typedef struct DenseLdl {
    int n;
    double *m, *pivot, *terms;
    const signed char *sign;
    double least, share;
} DenseLdl;

/* Subtract from column j what the panel's columns from `first` on contribute, and find its pivot.
 */
static bool finish_column(const DenseLdl *a, int first, int j) {
    const size_t n = (size_t)a->n;
    double *own = &a->m[(size_t)j * n];
    for (int b = first; b < j; b++) {
        const double *column = &a->m[(size_t)b * n], l = column[j], y = l * a->pivot[b];
        for (int i = j; i < a->n; i++) own[i] -= column[i] * y;
        a->terms[j] += fabs(l * y);
    }
    const double s = a->sign[j], smallest = fmax(a->least, a->share * a->terms[j]);
    if (!isfinite(own[j])) return false;
    const double pivot = own[j] * s >= smallest ? own[j] : s * smallest;
    a->pivot[j] = pivot;
    for (int i = j + 1; i < a->n; i++) own[i] /= pivot;
    return true;
}

/* The rows of the panel from `end` on: L four rows at a time, and D L' alike. */
static void pack(const DenseLdl *a, int first, int end, double *l, double *y) {
    const size_t n = (size_t)a->n;
    for (int i = end; i < a->n; i += ROWS)
        for (int b = first; b < end; b++)
            for (int r = 0; r < ROWS; r++) {
                *l = a->m[(size_t)b * n + (size_t)(i + r)];
                *y = *l * a->pivot[b];
                a->terms[i + r] += fabs(*l++ * *y++);
            }
}

/* out -= the product of four rows and four columns of a packed panel of `width`. */
static inline void subtract_block(int width, const double *restrict l, const double *restrict y,
                                  double *restrict out, size_t n) {
    double sum[ROWS][ROWS] = {{0}};
    for (int b = 0; b < width; b++, l += ROWS, y += ROWS)
        for (int c = 0; c < ROWS; c++)
            for (int r = 0; r < ROWS; r++) sum[c][r] += l[r] * y[c];
    for (int c = 0; c < ROWS; c++)
        for (int r = 0; r < ROWS; r++) out[(size_t)c * n + (size_t)r] -= sum[c][r];
}

bool cpsi_dense_ldl(int n, double *m, double *pivot, double *terms, const signed char *sign,
                    double least, double share, double *scratch) {
    const DenseLdl a = {n, m, pivot, terms, sign, least, share};
    double *l = scratch, *y = scratch + (size_t)PANEL * (size_t)n;
    for (int first = 0; first < n; first += PANEL) {
        const int end = first + PANEL < n ? first + PANEL : n, width = end - first;
        for (int j = first; j < end; j++)
            if (!finish_column(&a, first, j)) return false;
        pack(&a, first, end, l, y);
        for (int j = end; j < n; j += ROWS)
            for (int i = j; i < n; i += ROWS)
                subtract_block(width, &l[(size_t)(i - end) * (size_t)width],
                               &y[(size_t)(j - end) * (size_t)width],
                               &m[(size_t)j * (size_t)n + (size_t)i], (size_t)n);
    }
    return true;
}
