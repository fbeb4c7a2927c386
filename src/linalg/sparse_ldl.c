/* SPDX-License-Identifier: BSD-3-Clause */
/* The factor L D L' of a sparse symmetric matrix, row by row of L ("up-looking", Davis 2005).
 *
 * Row k of L solves L y = column k of A above the diagonal. The nonzeros of y are the unknowns on
 * the paths in the elimination tree from the nonzeros of the column to the root k; the parent of i
 * is the row of the first nonzero below the diagonal in column i of L.
 *
 * Neighbouring columns often have their nonzeros in the same rows (a supernode), each its first one
 * in the next column. Up to four of them are used at once, so that each row is looked up once for
 * all four.
 *
 * The last columns have their nonzeros in nearly all rows below them. Once the columns before them
 * have been eliminated from them, they are taken as a dense matrix (dense_ldl.c), with what zeros
 * they have, from the column on from which that is the least work. */
#include "linalg/sparse_ldl.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/lanes.h"
#include "linalg/dense_ldl.h"

struct CpsiLdl {
    int n;
    size_t entries, factor_entries;
    size_t *place;       /* (entries) position in `value` of each entry of the caller's */
    size_t *column;      /* (n + 1) first entries of the columns of the reordered matrix */
    int *row;            /* (entries) */
    double *value;       /* (entries) */
    int *order, *parent; /* (n) */
    /* (n + 1) first entries of the columns of L, whose unit diagonal is not stored */
    size_t *start;
    int *index;               /* (factor_entries) */
    double *factor;           /* (factor_entries) */
    double *pivot;            /* (n) */
    double *y;                /* (n) one row */
    int *count, *path, *mark; /* (n) */
    bool *joined; /* (n) the column before has its nonzeros in the same rows and in this one */
    int dense;    /* the first of the columns that are factorised as a dense matrix; n: none are */
    CpsiDenseLdl end;
};

/* A product in the columns before the dense matrix takes as long as so many in it. The least number
 * of columns for a dense matrix. */
static const double SLOWER = 12;
enum { LEAST_DENSE = 64 };

/* A pivot is a difference of terms, each of them rounded, as often is what they are made of: it is
 * known to about this share of their sum. Taken from below that, it would be a number without
 * digits, and the entries of its column, which are rounding as well, would grow by their ratio to
 * it. */
static const double PIVOT_ROUNDING = 4 * DBL_EPSILON;

/* Columns of a supernode that are used at once, and the nonzeros from which on that pays. */
enum { MOST_TOGETHER = 4, LONG = 12 };

/* Neighbouring columns with their nonzeros in the same `length` rows beyond the columns
 * themselves. */
typedef struct Supernode {
    int first, width;
    size_t length;
    const int *row;                      /* (length) */
    const double *factor[MOST_TOGETHER]; /* (length) each; beyond `width` those of the last */
} Supernode;

void cpsi_ldl_free(CpsiLdl *ldl) {
    if (!ldl) return;
    cpsi_dense_ldl_free(&ldl->end);
    void *part[] = {ldl->place, ldl->column, ldl->row,    ldl->value, ldl->order,
                    ldl->start, ldl->index,  ldl->factor, ldl->pivot, ldl->joined};
    for (size_t k = 0; k < sizeof part / sizeof *part; k++) free(part[k]);
    free(ldl);
}

/* The upper triangle in the new order; `inverse` (n) is scratch. */
static void permute(CpsiLdl *ldl, const CpsiPattern *pattern, int *inverse) {
    const int n = ldl->n;
    for (int k = 0; k < n; k++) inverse[ldl->order[k]] = k;
    for (int pass = 0; pass < 2; pass++) {
        for (int j = 0; j < n; j++)
            for (size_t e = pattern->start[j]; e < pattern->start[j + 1]; e++) {
                const int a = inverse[pattern->index[e]], b = inverse[j], high = a > b ? a : b;
                if (pass == 0) {
                    ldl->column[high + 1]++;
                    continue;
                }
                const size_t at = ldl->column[high]++;
                ldl->place[e] = at;
                ldl->row[at] = a > b ? b : a;
            }
        /* First turn counts into first entries. Filling has then advanced each of them by one
         * column, which is undone. */
        if (pass == 0)
            for (int j = 0; j < n; j++) ldl->column[j + 1] += ldl->column[j];
        else
            for (int j = n; j > 0; j--) ldl->column[j] = ldl->column[j - 1];
    }
    ldl->column[0] = 0;
}

/* Elimination tree and column counts. Returns the number of entries of L. */
static size_t count_factor(CpsiLdl *ldl) {
    size_t total = 0;
    for (int k = 0; k < ldl->n; k++) {
        ldl->parent[k] = -1;
        ldl->mark[k] = k;
        ldl->count[k] = 0;
        for (size_t e = ldl->column[k]; e < ldl->column[k + 1]; e++)
            for (int i = ldl->row[e]; ldl->mark[i] != k; i = ldl->parent[i]) {
                if (ldl->parent[i] < 0) ldl->parent[i] = k;
                ldl->count[i]++;
                total++;
                ldl->mark[i] = k;
            }
    }
    return total;
}

static bool allocate_matrix(CpsiLdl *ldl) {
    const size_t n = (size_t)ldl->n, m = ldl->entries;
    ldl->place = malloc((m + 1) * sizeof *ldl->place);
    ldl->column = calloc(n + 2, sizeof *ldl->column);
    ldl->row = malloc((m + 1) * sizeof *ldl->row);
    ldl->value = malloc((m + 1) * sizeof *ldl->value);
    ldl->start = malloc((n + 1) * sizeof *ldl->start);
    ldl->order = malloc((5 * n + 1) * sizeof *ldl->order);
    ldl->pivot = calloc(2 * n + CPSI_LANES, sizeof *ldl->pivot); /* y to whole lanes */
    ldl->joined = calloc(n + 1, sizeof *ldl->joined);
    if (!ldl->place || !ldl->column || !ldl->row || !ldl->value || !ldl->start || !ldl->order ||
        !ldl->pivot || !ldl->joined)
        return false;
    ldl->parent = ldl->order + n;
    ldl->count = ldl->parent + n;
    ldl->path = ldl->count + n;
    ldl->mark = ldl->path + n;
    ldl->y = ldl->pivot + n;
    return true;
}

/* The first of the columns that are taken as a dense matrix: the one from which on the products of
 * all columns take the least time. */
static int first_dense(const CpsiLdl *ldl) {
    double before = 0, behind = 0, least = INFINITY;
    int first = ldl->n;
    for (int k = 0; k < ldl->n; k++) before += SLOWER * ldl->count[k] * (double)ldl->count[k];
    for (int k = ldl->n; k >= 0; k--) {
        const double below = ldl->n - k;
        if (before + behind < least && (k == ldl->n || below >= LEAST_DENSE)) {
            least = before + behind;
            first = k;
        }
        if (k == 0) break;
        before -= SLOWER * ldl->count[k - 1] * (double)ldl->count[k - 1];
        behind += below * below;
    }
    return first;
}

static bool allocate_factor(CpsiLdl *ldl, int *width) {
    if (ldl->factor_entries > SIZE_MAX / sizeof(double) - 1) return false;
    ldl->dense = first_dense(ldl);
    ldl->start[0] = 0;
    for (int k = 0; k < ldl->n; k++) {
        const bool sparse = k < ldl->dense;
        ldl->start[k + 1] = ldl->start[k] + (sparse ? (size_t)ldl->count[k] : 0);
        ldl->joined[k] = sparse && k > 0 && ldl->parent[k - 1] == k &&
                         ldl->count[k - 1] == ldl->count[k] + 1 && ldl->count[k] >= LONG;
    }
    const size_t entries = ldl->start[ldl->n];
    ldl->index = malloc((entries + 1) * sizeof *ldl->index);
    ldl->factor = malloc((entries + 1) * sizeof *ldl->factor);
    return ldl->index && ldl->factor &&
           (ldl->dense == ldl->n || cpsi_dense_ldl_new(&ldl->end, ldl->n - ldl->dense, width));
}

CpsiLdl *cpsi_ldl_new(const CpsiPattern *pattern, size_t most, int *width, size_t *entries) {
    *entries = 0;
    CpsiLdl *ldl = calloc(1, sizeof *ldl);
    if (!ldl) return NULL;
    ldl->n = pattern->n;
    ldl->entries = pattern->start[pattern->n];
    bool done = allocate_matrix(ldl) && cpsi_sparse_order(pattern, ldl->order);
    if (done) {
        permute(ldl, pattern, ldl->path);
        *entries = ldl->factor_entries = count_factor(ldl);
        done = *entries <= most;
        if (done && !allocate_factor(ldl, width)) {
            *entries = 0;
            done = false;
        }
    }
    if (done) return ldl;
    cpsi_ldl_free(ldl);
    return NULL;
}

/* The nonzeros of row k before the dense columns in path[top ..], each after those that it depends
 * on; the row's right-hand side in y. Returns the diagonal entry. */
static double scatter_row(CpsiLdl *ldl, int k, int *top) {
    double diagonal = 0;
    *top = ldl->n;
    ldl->mark[k] = k;
    for (size_t e = ldl->column[k]; e < ldl->column[k + 1]; e++) {
        int i = ldl->row[e], length = 0;
        if (i == k) {
            diagonal += ldl->value[e];
            continue;
        }
        ldl->y[i] += ldl->value[e];
        for (; i < ldl->dense && ldl->mark[i] != k; i = ldl->parent[i]) {
            ldl->path[length++] = i;
            ldl->mark[i] = k;
        }
        while (length > 0) ldl->path[--*top] = ldl->path[--length];
    }
    return diagonal;
}

/* The columns from `first` on, `width` of them. `length`: how many nonzeros the first one has. */
static inline Supernode columns_of(const CpsiLdl *ldl, int first, int width, size_t length) {
    Supernode columns = {.first = first, .width = width, .length = length - (size_t)(width - 1)};
    for (int a = 0; a < MOST_TOGETHER; a++) {
        const int c = a < width ? a : width - 1;
        columns.factor[a] = &ldl->factor[ldl->start[first + c] + (size_t)(width - 1 - c)];
    }
    columns.row = &ldl->index[ldl->start[first] + (size_t)(width - 1)];
    return columns;
}

/* L of column b of the columns, in the row of their column a > b. */
static inline double between(const Supernode *columns, int a, int b) {
    return columns->factor[b][a - columns->width];
}

/* Finish y in the columns themselves, each in turn, and subtract their multiples from y in the rows
 * beyond. x: y of the columns, 0 beyond `width`. */
static inline void eliminate(const Supernode *columns, double *y, double x[MOST_TOGETHER]) {
    for (int a = 0; a < MOST_TOGETHER; a++) {
        x[a] = a < columns->width ? y[columns->first + a] : 0;
        for (int b = 0; b < a && a < columns->width; b++) x[a] -= between(columns, a, b) * x[b];
    }
    const double *const *f = columns->factor;
    if (columns->width == 1)
        for (size_t e = 0; e < columns->length; e++) y[columns->row[e]] -= f[0][e] * x[0];
    else
        for (size_t e = 0; e < columns->length; e++)
            y[columns->row[e]] -=
                (f[0][e] * x[0] + f[1][e] * x[1]) + (f[2][e] * x[2] + f[3][e] * x[3]);
}

/* Eliminate the columns before the dense ones from row k, which is in y. Returns what is left of
 * its diagonal entry, and adds the terms of that to *terms. */
static double eliminate_row(CpsiLdl *ldl, int k, int top, double diagonal, double *terms) {
    *terms = fabs(diagonal);
    while (top < ldl->n) {
        const int i = ldl->path[top];
        int width = 1;
        while (width < MOST_TOGETHER && top + width < ldl->n && ldl->joined[i + width] &&
               ldl->path[top + width] == i + width)
            width++;
        double y[MOST_TOGETHER];
        const Supernode columns = columns_of(ldl, i, width, (size_t)ldl->count[i]);
        eliminate(&columns, ldl->y, y);
        for (int a = 0; a < width; a++) {
            const double l = y[a] / ldl->pivot[i + a];
            const size_t end = ldl->start[i + a] + (size_t)ldl->count[i + a]++;
            ldl->y[i + a] = 0;
            diagonal -= l * y[a];
            *terms += fabs(l * y[a]);
            ldl->index[end] = k;
            ldl->factor[end] = l;
        }
        top += width;
    }
    return diagonal;
}

bool cpsi_ldl_factor(CpsiLdl *ldl, const double *values, const signed char *sign, double least) {
    for (size_t e = 0; e < ldl->entries; e++) ldl->value[ldl->place[e]] = values[e];
    for (int k = 0; k < ldl->n; k++) {
        ldl->count[k] = 0;
        ldl->mark[k] = -1;
        ldl->y[k] = 0;
    }
    for (int k = 0; k < ldl->n; k++) {
        int top;
        double terms;
        const double diagonal = scatter_row(ldl, k, &top),
                     pivot = eliminate_row(ldl, k, top, diagonal, &terms);
        const signed char s = sign[ldl->order[k]];
        if (k >= ldl->dense) {
            double *row = &ldl->y[ldl->dense];
            const int i = k - ldl->dense;
            row[i] = pivot;
            cpsi_dense_ldl_row(&ldl->end, i, row, terms, s);
            memset(row, 0, ((size_t)i + 1) * sizeof *row);
            continue;
        }
        if (!isfinite(pivot)) return false;
        const double smallest = fmax(least, PIVOT_ROUNDING * terms);
        ldl->pivot[k] = pivot * s >= smallest ? pivot : s * smallest;
    }
    return ldl->dense == ldl->n || cpsi_dense_ldl_factor(&ldl->end, least, PIVOT_ROUNDING);
}

/* As many columns as may be used at once from k on. */
static inline Supernode columns_from(const CpsiLdl *ldl, int k) {
    int width = 1;
    while (width < MOST_TOGETHER && k + width < ldl->dense && ldl->joined[k + width]) width++;
    return columns_of(ldl, k, width, ldl->start[k + 1] - ldl->start[k]);
}

/* Subtract from y in the columns what y in the rows beyond contributes, then each from those before
 * it. */
static inline void substitute(const CpsiLdl *ldl, const Supernode *columns, double *y) {
    double x[MOST_TOGETHER] = {0};
    const double *const *f = columns->factor;
    if (columns->width == 1)
        for (size_t e = 0; e < columns->length; e++) x[0] += f[0][e] * y[columns->row[e]];
    else
        for (size_t e = 0; e < columns->length; e++) {
            const double there = y[columns->row[e]];
            for (int a = 0; a < MOST_TOGETHER; a++) x[a] += f[a][e] * there;
        }
    for (int b = columns->width - 1; b >= 0; b--) {
        double *own = &y[columns->first + b];
        *own = *own / ldl->pivot[columns->first + b] - x[b];
        for (int a = b + 1; a < columns->width; a++)
            *own -= between(columns, a, b) * y[columns->first + a];
    }
}

void cpsi_ldl_solve(const CpsiLdl *ldl, double *x) {
    const int n = ldl->n;
    double *y = ldl->y, own[MOST_TOGETHER];
    for (int k = 0; k < n; k++) y[k] = x[ldl->order[k]];
    for (int k = 0; k < ldl->dense;) {
        const Supernode columns = columns_from(ldl, k);
        eliminate(&columns, y, own);
        for (int a = 0; a < columns.width; a++) y[k + a] = own[a];
        k += columns.width;
    }
    if (ldl->dense < n) {
        cpsi_dense_ldl_forward(&ldl->end, &y[ldl->dense]);
        cpsi_dense_ldl_backward(&ldl->end, &y[ldl->dense]);
    }
    for (int k = ldl->dense; k > 0;) {
        int first = k - 1;
        while (k - first < MOST_TOGETHER && ldl->joined[first]) first--;
        const Supernode columns =
            columns_of(ldl, first, k - first, ldl->start[first + 1] - ldl->start[first]);
        substitute(ldl, &columns, y);
        k = first;
    }
    for (int k = 0; k < n; k++) {
        x[ldl->order[k]] = y[k];
        y[k] = 0;
    }
}
