/* SPDX-License-Identifier: BSD-3-Clause */
/* The factor L D L' of a sparse symmetric matrix, row by row of L ("up-looking", Davis 2005).
 *
 * Row k of L solves L y = column k of A above the diagonal. The nonzeros of y are the unknowns on
 * the paths in the elimination tree from the nonzeros of the column to the root k; the parent of i
 * is the row of the first nonzero below the diagonal in column i of L. */
#include "linalg/sparse_ldl.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

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
};

void cpsi_ldl_free(CpsiLdl *ldl) {
    if (!ldl) return;
    void *part[] = {ldl->place, ldl->column, ldl->row,    ldl->value, ldl->order,
                    ldl->start, ldl->index,  ldl->factor, ldl->pivot};
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
    ldl->pivot = calloc(2 * n + 1, sizeof *ldl->pivot);
    if (!ldl->place || !ldl->column || !ldl->row || !ldl->value || !ldl->start || !ldl->order ||
        !ldl->pivot)
        return false;
    ldl->parent = ldl->order + n;
    ldl->count = ldl->parent + n;
    ldl->path = ldl->count + n;
    ldl->mark = ldl->path + n;
    ldl->y = ldl->pivot + n;
    return true;
}

static bool allocate_factor(CpsiLdl *ldl) {
    if (ldl->factor_entries > SIZE_MAX / sizeof(double) - 1) return false;
    ldl->index = malloc((ldl->factor_entries + 1) * sizeof *ldl->index);
    ldl->factor = malloc((ldl->factor_entries + 1) * sizeof *ldl->factor);
    if (!ldl->index || !ldl->factor) return false;
    ldl->start[0] = 0;
    for (int k = 0; k < ldl->n; k++) ldl->start[k + 1] = ldl->start[k] + (size_t)ldl->count[k];
    return true;
}

CpsiLdl *cpsi_ldl_new(const CpsiPattern *pattern, size_t most, size_t *entries) {
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
        if (done && !allocate_factor(ldl)) {
            *entries = 0;
            done = false;
        }
    }
    if (done) return ldl;
    cpsi_ldl_free(ldl);
    return NULL;
}

/* The nonzeros of row k in path[top ..], each after those that it depends on; the row's right-hand
 * side in y. Returns the diagonal entry. */
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
        for (; ldl->mark[i] != k; i = ldl->parent[i]) {
            ldl->path[length++] = i;
            ldl->mark[i] = k;
        }
        while (length > 0) ldl->path[--*top] = ldl->path[--length];
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
        double pivot = scatter_row(ldl, k, &top);
        for (; top < ldl->n; top++) {
            const int i = ldl->path[top];
            const double y = ldl->y[i], l = y / ldl->pivot[i];
            const size_t begin = ldl->start[i], end = begin + (size_t)ldl->count[i];
            ldl->y[i] = 0;
            for (size_t e = begin; e < end; e++) ldl->y[ldl->index[e]] -= ldl->factor[e] * y;
            pivot -= l * y;
            ldl->index[end] = k;
            ldl->factor[end] = l;
            ldl->count[i]++;
        }
        const double s = sign[ldl->order[k]];
        if (!isfinite(pivot)) return false;
        ldl->pivot[k] = pivot * s >= least ? pivot : s * least;
    }
    return true;
}

void cpsi_ldl_solve(const CpsiLdl *ldl, double *x) {
    const int n = ldl->n;
    double *y = ldl->y;
    for (int k = 0; k < n; k++) y[k] = x[ldl->order[k]];
    for (int k = 0; k < n; k++)
        for (size_t e = ldl->start[k]; e < ldl->start[k + 1]; e++)
            y[ldl->index[e]] -= ldl->factor[e] * y[k];
    for (int k = n - 1; k >= 0; k--) {
        y[k] /= ldl->pivot[k];
        for (size_t e = ldl->start[k]; e < ldl->start[k + 1]; e++)
            y[k] -= ldl->factor[e] * y[ldl->index[e]];
    }
    for (int k = 0; k < n; k++) {
        x[ldl->order[k]] = y[k];
        y[k] = 0;
    }
}
