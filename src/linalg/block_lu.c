/* SPDX-License-Identifier: BSD-3-Clause */
/* The factor L D U, one row of L and one column of U at a time ("up-looking", as sparse_ldl.c).
 *
 * Column k of U above the diagonal solves L y = column k of A, row k of L solves z U = row k of A,
 * U_ik = D_i^-1 y_i and L_ki = z_i D_i^-1, and D_k = A_kk less the sum of z_i U_ik. As the pattern
 * is symmetric, both have blocks at the same i: the unknowns on the paths in the elimination tree
 * from the neighbours of k to k. */
#include "linalg/block_lu.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "linalg/sparse_ldl.h"

enum { BLOCK = 9 };

struct CpsiBlockLu {
    int n;
    /* the matrix by rows, in the caller's order: columns in rising order */
    size_t *row;   /* (n + 1) first entries */
    int *column;   /* (row[n]) */
    size_t *twin;  /* (row[n]) the entry of the block across the diagonal */
    double *value; /* (row[n], 9) */
    /* the order */
    int *order, *place; /* (n) the unknown of each place, and the place of each unknown */
    int *parent;        /* (n) in the elimination tree, of places; -1: none */
    int *count, *path, *mark;
    unsigned char *used;  /* (n) of places */
    int used_count, *use; /* (used_count) the places in use, in rising order */
    /* the factor: column k of L, and row k of U, have blocks at the same places beyond k */
    size_t *start;  /* (n + 1) */
    size_t *filled; /* (n) where the next block of a column goes */
    int *index;
    double *lower, *upper;   /* (start[n], 9) */
    double *inverse;         /* (n, 9) of D */
    double *y, *z;           /* (n, 9) */
    double *right, *improve; /* (n, 3) */
};

/* blocks --------------------------------------------------------------------------------------- */

/* c -= a b */
static inline void subtract(double *restrict c, const double *restrict a,
                            const double *restrict b) {
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            c[3 * i + j] -= a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
}
/* c = a b */
static inline void multiply(double *restrict c, const double *restrict a,
                            const double *restrict b) {
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            c[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
}
/* y -= a x */
static inline void subtract_from(double *restrict y, const double *restrict a,
                                 const double *restrict x) {
    for (int i = 0; i < 3; i++) y[i] -= a[3 * i] * x[0] + a[3 * i + 1] * x[1] + a[3 * i + 2] * x[2];
}

/* The inverse by Gauss-Jordan with the largest pivot of all that is left, so that a block whose
 * rows and columns differ by many orders of size keeps the accuracy of each. */
static bool invert(const double a[BLOCK], double out[BLOCK]) {
    double m[3][6] = {{a[0], a[1], a[2], 1}, {a[3], a[4], a[5], 0, 1}, {a[6], a[7], a[8], 0, 0, 1}};
    int column_of[3];
    bool done[3] = {false, false, false}, taken[3] = {false, false, false};
    for (int k = 0; k < 3; k++) {
        int r = -1, c = -1;
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                if (!done[i] && !taken[j] && (r < 0 || fabs(m[i][j]) > fabs(m[r][c]))) {
                    r = i;
                    c = j;
                }
        const double pivot = m[r][c];
        if (!(fabs(pivot) > 0) || !isfinite(pivot)) return false;
        done[r] = taken[c] = true;
        column_of[r] = c;
        for (int j = 0; j < 6; j++) m[r][j] /= pivot;
        for (int i = 0; i < 3; i++) {
            const double by = m[i][c];
            if (i != r)
                for (int j = 0; j < 6; j++) m[i][j] -= by * m[r][j];
        }
    }
    for (int r = 0; r < 3; r++) memcpy(&out[3 * column_of[r]], &m[r][3], 3 * sizeof *out);
    for (int i = 0; i < BLOCK; i++)
        if (!isfinite(out[i])) return false;
    return true;
}

/* pattern -------------------------------------------------------------------------------------- */

static int by_number(const void *a, const void *b) {
    const int x = *(const int *)a, y = *(const int *)b;
    return (x > y) - (x < y);
}

static bool counts(const int edge[2]) { return edge[0] >= 0 && edge[1] >= 0 && edge[0] != edge[1]; }

/* The rows of the pattern, each neighbour once. */
static bool lay_rows(CpsiBlockLu *lu, size_t edges, const int (*edge)[2]) {
    const int n = lu->n;
    size_t *row = lu->row = calloc((size_t)n + 2, sizeof *row);
    if (!row) return false;
    for (int i = 0; i < n; i++) row[i + 1] = 1;
    for (size_t e = 0; e < edges; e++)
        for (int k = 0; k < 2 && counts(edge[e]); k++) row[edge[e][k] + 1]++;
    for (int i = 0; i < n; i++) row[i + 1] += row[i];
    int *column = lu->column = malloc((row[n] + 1) * sizeof *column);
    size_t *at = malloc(((size_t)n + 1) * sizeof *at);
    if (!column || !at) {
        free(at);
        return false;
    }
    for (int i = 0; i < n; i++) {
        at[i] = row[i];
        column[at[i]++] = i;
    }
    for (size_t e = 0; e < edges; e++)
        for (int k = 0; k < 2 && counts(edge[e]); k++) column[at[edge[e][k]]++] = edge[e][1 - k];
    free(at);
    size_t kept = 0;
    for (int i = 0; i < n; i++) {
        const size_t begin = row[i], end = row[i + 1];
        qsort(&column[begin], end - begin, sizeof *column, by_number);
        row[i] = kept;
        for (size_t e = begin; e < end; e++)
            if (e == begin || column[e] != column[e - 1]) column[kept++] = column[e];
    }
    row[n] = kept;
    return true;
}

/* The entry in row i and column j, which is in the pattern. */
static size_t find(const CpsiBlockLu *lu, int i, int j) {
    size_t low = lu->row[i], high = lu->row[i + 1];
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (lu->column[middle] <= j)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* The upper triangle by columns: by symmetry the left part of each row. */
static void lay_pattern(const CpsiBlockLu *lu, size_t *start, int *index) {
    size_t at = 0;
    for (int i = 0; i < lu->n; i++) {
        start[i] = at;
        for (size_t e = lu->row[i]; lu->column[e] < i; e++) index[at++] = lu->column[e];
    }
    start[lu->n] = at;
}

static bool choose_order(CpsiBlockLu *lu) {
    const int n = lu->n;
    size_t *start = malloc(((size_t)n + 1) * sizeof *start);
    int *index = malloc((lu->row[n] + 1) * sizeof *index);
    bool done = false;
    if (start && index) {
        lay_pattern(lu, start, index);
        done = cpsi_sparse_order(&(CpsiPattern){.n = n, .start = start, .index = index}, lu->order);
    }
    free(start);
    free(index);
    if (!done) return false;
    for (int k = 0; k < n; k++) lu->place[lu->order[k]] = k;
    return true;
}

/* The elimination tree and the blocks of each column of L; returns how many there are in all. */
static size_t count_factor(CpsiBlockLu *lu) {
    size_t total = 0;
    for (int k = 0; k < lu->n; k++) {
        const int own = lu->order[k];
        lu->parent[k] = -1;
        lu->mark[k] = k;
        lu->count[k] = 0;
        for (size_t e = lu->row[own]; e < lu->row[own + 1]; e++)
            for (int i = lu->place[lu->column[e]]; i < k && lu->mark[i] != k; i = lu->parent[i]) {
                if (lu->parent[i] < 0) lu->parent[i] = k;
                lu->count[i]++;
                total++;
                lu->mark[i] = k;
            }
    }
    return total;
}

static bool allocate_order(CpsiBlockLu *lu) {
    const size_t n = (size_t)lu->n + 1, entries = lu->row[lu->n] + 1;
    lu->twin = malloc(entries * sizeof *lu->twin);
    lu->value = calloc(entries, BLOCK * sizeof *lu->value);
    lu->order = malloc(7 * n * sizeof *lu->order);
    lu->used = calloc(n, 1);
    lu->start = malloc(2 * n * sizeof *lu->start);
    lu->inverse = malloc(3 * n * BLOCK * sizeof *lu->inverse);
    lu->right = malloc(6 * n * sizeof *lu->right);
    if (!lu->twin || !lu->value || !lu->order || !lu->used || !lu->start || !lu->inverse ||
        !lu->right)
        return false;
    int **part[] = {&lu->place, &lu->parent, &lu->count, &lu->path, &lu->mark, &lu->use};
    for (size_t k = 0; k < sizeof part / sizeof *part; k++) *part[k] = lu->order + (k + 1) * n;
    lu->y = lu->inverse + n * BLOCK;
    lu->z = lu->y + n * BLOCK;
    lu->improve = lu->right + 3 * n;
    lu->filled = lu->start + n;
    return true;
}

static bool allocate_factor(CpsiBlockLu *lu, size_t blocks) {
    if (blocks > SIZE_MAX / (2 * BLOCK * sizeof(double)) - 1) return false;
    lu->index = malloc((blocks + 1) * sizeof *lu->index);
    lu->lower = malloc((blocks + 1) * BLOCK * sizeof *lu->lower);
    lu->upper = malloc((blocks + 1) * BLOCK * sizeof *lu->upper);
    lu->start[0] = 0;
    for (int k = 0; k < lu->n; k++) lu->start[k + 1] = lu->start[k] + (size_t)lu->count[k];
    return lu->index && lu->lower && lu->upper;
}

static void use_all(CpsiBlockLu *lu) {
    lu->used_count = lu->n;
    for (int k = 0; k < lu->n; k++) {
        lu->use[k] = k;
        lu->used[k] = 1;
        for (int a = 0; a < BLOCK; a++) lu->y[BLOCK * k + a] = lu->z[BLOCK * k + a] = 0;
    }
}

CpsiBlockLu *cpsi_block_lu_new(int n, size_t edges, const int (*edge)[2], size_t most) {
    CpsiBlockLu *lu = calloc(1, sizeof *lu);
    if (!lu) return NULL;
    lu->n = n;
    bool done = lay_rows(lu, edges, edge) && allocate_order(lu) && choose_order(lu);
    if (done) {
        for (int i = 0; i < n; i++)
            for (size_t e = lu->row[i]; e < lu->row[i + 1]; e++)
                lu->twin[e] = find(lu, lu->column[e], i);
        const size_t blocks = count_factor(lu);
        done = blocks <= most && allocate_factor(lu, blocks);
    }
    if (!done) {
        cpsi_block_lu_free(lu);
        return NULL;
    }
    use_all(lu);
    return lu;
}

void cpsi_block_lu_free(CpsiBlockLu *lu) {
    if (!lu) return;
    void *part[] = {lu->row,   lu->column,  lu->twin,  lu->value, lu->order, lu->used,
                    lu->start, lu->inverse, lu->right, lu->index, lu->lower, lu->upper};
    for (size_t k = 0; k < sizeof part / sizeof *part; k++) free(part[k]);
    free(lu);
}

/* the matrix ----------------------------------------------------------------------------------- */

void cpsi_block_lu_use(CpsiBlockLu *lu, int count, const int *used) {
    for (int k = 0; k < lu->used_count; k++) lu->used[lu->use[k]] = 0;
    lu->used_count = count;
    for (int k = 0; k < count; k++) {
        lu->use[k] = lu->place[used[k]];
        lu->used[lu->use[k]] = 1;
    }
    qsort(lu->use, (size_t)count, sizeof *lu->use, by_number);
}

void cpsi_block_lu_clear(CpsiBlockLu *lu) {
    for (int k = 0; k < lu->used_count; k++) {
        const int i = lu->order[lu->use[k]];
        memset(&lu->value[BLOCK * lu->row[i]], 0,
               (lu->row[i + 1] - lu->row[i]) * BLOCK * sizeof *lu->value);
    }
}

double *cpsi_block_lu_at(CpsiBlockLu *lu, int i, int j) {
    return &lu->value[BLOCK * find(lu, i, j)];
}

int cpsi_block_lu_row(CpsiBlockLu *lu, int i, double **blocks) {
    *blocks = &lu->value[BLOCK * lu->row[i]];
    return (int)(lu->row[i + 1] - lu->row[i]);
}

size_t cpsi_block_lu_size(const CpsiBlockLu *lu) { return lu->start[lu->n]; }

/* the factor ----------------------------------------------------------------------------------- */

/* Take row and column k of the matrix into z and y, and the places at which they have blocks, in
 * the order of the tree, into path from the number returned on. */
static int reach(CpsiBlockLu *lu, int k, double pivot[BLOCK]) {
    const int own = lu->order[k];
    int top = lu->n;
    lu->mark[k] = k;
    for (size_t e = lu->row[own]; e < lu->row[own + 1]; e++) {
        const int at = lu->place[lu->column[e]];
        if (!lu->used[at] || at > k) continue;
        if (at == k) {
            memcpy(pivot, &lu->value[BLOCK * e], BLOCK * sizeof *pivot);
            continue;
        }
        memcpy(&lu->z[BLOCK * at], &lu->value[BLOCK * e], BLOCK * sizeof *lu->z);
        memcpy(&lu->y[BLOCK * at], &lu->value[BLOCK * lu->twin[e]], BLOCK * sizeof *lu->y);
        /* the new part of the path, before that which is known */
        int length = 0;
        for (int i = at; i != k && lu->mark[i] != k; i = lu->parent[i]) {
            lu->count[length++] = i;
            lu->mark[i] = k;
        }
        while (length > 0) lu->path[--top] = lu->count[--length];
    }
    return top;
}

/* Row k of L and column k of U. */
static bool eliminate(CpsiBlockLu *lu, int k) {
    size_t *filled = lu->filled;
    double pivot[BLOCK];
    for (int at = reach(lu, k, pivot); at < lu->n; at++) {
        const int i = lu->path[at];
        if (!lu->used[i]) continue;
        double y[BLOCK], z[BLOCK];
        memcpy(y, &lu->y[BLOCK * i], sizeof y);
        memcpy(z, &lu->z[BLOCK * i], sizeof z);
        memset(&lu->y[BLOCK * i], 0, sizeof y);
        memset(&lu->z[BLOCK * i], 0, sizeof z);
        const size_t end = filled[i];
        for (size_t e = lu->start[i]; e < end; e++) {
            subtract(&lu->y[BLOCK * lu->index[e]], &lu->lower[BLOCK * e], y);
            subtract(&lu->z[BLOCK * lu->index[e]], z, &lu->upper[BLOCK * e]);
        }
        lu->index[end] = k;
        multiply(&lu->lower[BLOCK * end], z, &lu->inverse[BLOCK * i]);
        multiply(&lu->upper[BLOCK * end], &lu->inverse[BLOCK * i], y);
        subtract(pivot, &lu->lower[BLOCK * end], y);
        filled[i]++;
    }
    filled[k] = lu->start[k];
    return invert(pivot, &lu->inverse[BLOCK * k]);
}

bool cpsi_block_lu_factor(CpsiBlockLu *lu) {
    for (int i = 0; i < lu->n; i++) lu->mark[i] = -1;
    for (int k = 0; k < lu->used_count; k++)
        if (!eliminate(lu, lu->use[k])) {
            memset(lu->y, 0, 2 * ((size_t)lu->n + 1) * BLOCK * sizeof *lu->y);
            return false;
        }
    return true;
}

/* x = A^-1 x with the factor alone, x in the caller's order. */
static void solve_once(const CpsiBlockLu *lu, double *x) {
    for (int s = 0; s < lu->used_count; s++) {
        const int k = lu->use[s];
        const double *own = &x[3 * lu->order[k]];
        for (size_t e = lu->start[k]; e < lu->filled[k]; e++)
            subtract_from(&x[3 * lu->order[lu->index[e]]], &lu->lower[BLOCK * e], own);
    }
    for (int s = lu->used_count - 1; s >= 0; s--) {
        const int k = lu->use[s];
        double *own = &x[3 * lu->order[k]], sum[3] = {0};
        subtract_from(sum, &lu->inverse[BLOCK * k], own);
        for (int a = 0; a < 3; a++) own[a] = -sum[a];
        for (size_t e = lu->start[k]; e < lu->filled[k]; e++)
            subtract_from(own, &lu->upper[BLOCK * e], &x[3 * lu->order[lu->index[e]]]);
    }
}

void cpsi_block_lu_solve(CpsiBlockLu *lu, double *x) {
    double *right = lu->right, *improve = lu->improve;
    for (int s = 0; s < lu->used_count; s++) {
        const int i = lu->order[lu->use[s]];
        memcpy(&right[3 * i], &x[3 * i], 3 * sizeof *right);
    }
    solve_once(lu, x);
    for (int s = 0; s < lu->used_count; s++) {
        const int i = lu->order[lu->use[s]];
        memcpy(&improve[3 * i], &right[3 * i], 3 * sizeof *right);
        for (size_t e = lu->row[i]; e < lu->row[i + 1]; e++)
            if (lu->used[lu->place[lu->column[e]]])
                subtract_from(&improve[3 * i], &lu->value[BLOCK * e], &x[3 * lu->column[e]]);
    }
    solve_once(lu, improve);
    for (int s = 0; s < lu->used_count; s++) {
        const int i = lu->order[lu->use[s]];
        for (int a = 0; a < 3; a++) x[3 * i + a] += improve[3 * i + a];
    }
}
