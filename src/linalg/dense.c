/* SPDX-License-Identifier: BSD-3-Clause */
/* Small dense matrices (dense.h). The algorithms are those of Golub and Van Loan, Matrix
 * Computations, chapters 3 to 5; Gram-Schmidt with every projection done twice keeps orthogonality
 * to rounding (Giraud, Langou and Rozloznik 2005). */
#include "linalg/dense.h"

#include <math.h>
#include <string.h>

double cpsi_norm(int n, const double *a) {
    double largest = 0, sum = 0;
    for (int i = 0; i < n; i++) {
        const double size = fabs(a[i]);
        if (size > largest) largest = size;
    }
    if (largest > 1e-100 && largest < 1e100) return sqrt(cpsi_dot(n, a, a));
    if (largest == 0 || !isfinite(largest)) return largest;
    for (int i = 0; i < n; i++) sum += a[i] / largest * (a[i] / largest);
    return largest * sqrt(sum);
}

static void swap_rows(int n, double *a, double *b) {
    for (int i = 0; i < n; i++) {
        const double keep = a[i];
        a[i] = b[i];
        b[i] = keep;
    }
}

/* Number of columns factorised together, and number of columns of the remaining rows updated at
 * once, chosen so that the data that are read repeatedly stay in the cache. Every entry undergoes
 * the same operations in the same order as column by column. */
enum { PANEL = 32, TILE = 256 };

/* Subtract from columns from..to of one row the multiples of the pivot rows first..last. */
static void take_pivots(size_t w, double *a, size_t first, size_t last, size_t row, size_t from,
                        size_t to) {
    for (size_t k = first; k < last && k < row; k++) {
        const double l = a[row * w + k];
        if (l == 0) continue;
        for (size_t j = from; j < to; j++) a[row * w + j] -= l * a[k * w + j];
    }
}

bool cpsi_lu_factor(int n, double *a, int *pivot) {
    const size_t w = (size_t)n;
    for (size_t first = 0; first < w; first += PANEL) {
        const size_t last = first + PANEL < w ? first + PANEL : w;
        for (size_t k = first; k < last; k++) {
            size_t best = k;
            for (size_t i = k + 1; i < w; i++)
                if (fabs(a[i * w + k]) > fabs(a[best * w + k])) best = i;
            pivot[k] = (int)best;
            if (best != k) swap_rows(n, &a[k * w], &a[best * w]);
            const double d = a[k * w + k];
            if (!isfinite(d) || d == 0) return false;
            for (size_t i = k + 1; i < w; i++) {
                const double l = a[i * w + k] /= d;
                if (l == 0) continue;
                for (size_t j = k + 1; j < last; j++) a[i * w + j] -= l * a[k * w + j];
            }
        }
        for (size_t from = last; from < w; from += TILE)
            for (size_t i = first + 1; i < w; i++)
                take_pivots(w, a, first, last, i, from, from + TILE < w ? from + TILE : w);
    }
    return true;
}

void cpsi_lu_solve(int n, const double *lu, const int *pivot, double *x) {
    const size_t w = (size_t)n;
    for (int k = 0; k < n; k++) {
        const double keep = x[pivot[k]];
        x[pivot[k]] = x[k];
        x[k] = keep;
    }
    for (int i = 1; i < n; i++) x[i] -= cpsi_dot(i, &lu[(size_t)i * w], x);
    for (int i = n - 1; i >= 0; i--) {
        const double *row = &lu[(size_t)i * w];
        x[i] = (x[i] - cpsi_dot(n - 1 - i, &row[i + 1], &x[i + 1])) / row[i];
    }
}

bool cpsi_cholesky(int n, const double *a, double *l) {
    const size_t w = (size_t)n;
    memset(l, 0, w * w * sizeof *l);
    for (size_t i = 0; i < w; i++)
        for (size_t j = 0; j <= i; j++) {
            const double sum = a[i * w + j] - cpsi_dot((int)j, &l[i * w], &l[j * w]);
            /* a pivot that is only the rounding of its diagonal counts as zero */
            if (i == j && !(sum > 1e-14 * fabs(a[i * w + i]) && isfinite(sum))) return false;
            l[i * w + j] = i == j ? sqrt(sum) : sum / l[j * w + j];
        }
    return true;
}

void cpsi_lower_inverse(int n, const double *l, double *out) {
    const size_t w = (size_t)n;
    memset(out, 0, w * w * sizeof *out);
    for (size_t j = 0; j < w; j++) {
        out[j * w + j] = 1 / l[j * w + j];
        for (size_t i = j + 1; i < w; i++) {
            double sum = 0;
            for (size_t k = j; k < i; k++) sum -= l[i * w + k] * out[k * w + j];
            out[i * w + j] = sum / l[i * w + i];
        }
    }
}

/* row -= <row, q> q, and its right-hand side alike */
static void remove_along(int n, double *row, double *rhs, const double *q, const double *rhs_q) {
    const double c = cpsi_dot(n, row, q);
    for (int i = 0; i < n; i++) row[i] -= c * q[i];
    if (rhs) *rhs -= c * *rhs_q;
}

int cpsi_orthonormal_rows(int count, int n, double *rows, double *rhs, double tolerance) {
    const size_t w = (size_t)n;
    /* scale the rows to length one, so that the norm of a remainder is the share that remains */
    for (int i = 0; i < count; i++) {
        const double size = cpsi_norm(n, &rows[(size_t)i * w]);
        if (size == 0) continue;
        for (size_t j = 0; j < w; j++) rows[(size_t)i * w + j] /= size;
        if (rhs) rhs[i] /= size;
    }
    return cpsi_orthonormal_span(count, n, rows, rhs, tolerance);
}

int cpsi_orthonormal_span(int count, int n, double *rows, double *rhs, double tolerance) {
    const size_t w = (size_t)n;
    int rank = 0;
    for (; rank < count && rank < n; rank++) {
        int best = rank;
        double most = -1;
        for (int i = rank; i < count; i++) {
            const double size = cpsi_norm(n, &rows[(size_t)i * w]);
            if (size > most) {
                most = size;
                best = i;
            }
        }
        if (!(most > tolerance)) break;
        double *q = &rows[(size_t)rank * w], *rhs_q = rhs ? &rhs[rank] : NULL;
        if (best != rank) {
            swap_rows(n, q, &rows[(size_t)best * w]);
            if (rhs) swap_rows(1, rhs_q, &rhs[best]);
        }
        for (int k = 0; k < rank; k++)
            remove_along(n, q, rhs_q, &rows[(size_t)k * w], rhs ? &rhs[k] : NULL);
        const double size = cpsi_norm(n, q);
        for (size_t j = 0; j < w; j++) q[j] /= size;
        if (rhs) *rhs_q /= size;
        for (int i = rank + 1; i < count; i++)
            remove_along(n, &rows[(size_t)i * w], rhs ? &rhs[i] : NULL, q, rhs_q);
    }
    return rank;
}

void cpsi_next_row(int rank, int n, double *q) {
    /* The coordinate axis that is farthest from the span of the rows. The squared distance of each
     * axis is computed in the memory of the new row. */
    const size_t w = (size_t)n;
    double *row = &q[(size_t)rank * w];
    int best = 0;
    for (int i = 0; i < n; i++) row[i] = 1;
    for (int k = 0; k < rank; k++)
        for (size_t i = 0; i < w; i++) row[i] -= q[(size_t)k * w + i] * q[(size_t)k * w + i];
    for (int i = 1; i < n; i++)
        if (row[i] > row[best]) best = i;
    memset(row, 0, w * sizeof *row);
    row[best] = 1;
    for (int twice = 0; twice < 2; twice++)
        for (int k = 0; k < rank; k++) remove_along(n, row, NULL, &q[(size_t)k * w], NULL);
    const double size = cpsi_norm(n, row);
    for (size_t j = 0; j < w; j++) row[j] /= size;
}

void cpsi_complete_rows(int rank, int n, double *q) {
    for (; rank < n; rank++) cpsi_next_row(rank, n, q);
}
