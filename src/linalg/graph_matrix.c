/* SPDX-License-Identifier: BSD-3-Clause */
/* Dense or sparse (graph_matrix.h). */
#include "linalg/graph_matrix.h"

#include <stdlib.h>
#include <string.h>

#include "linalg/dense.h"

/* Up to so many blocks on the diagonal the matrix is dense: its factor takes a few milliseconds,
 * and has pivots of the whole column. */
enum { DENSE = 100 };
/* Pairs of blocks off the diagonal of a sparse factor: 10 GB. */
static const size_t MOST = 64000000;

struct CpsiGraphMatrix {
    int count;              /* blocks in use */
    CpsiBlockLu *sparse;    /* NULL: dense */
    int *node;              /* (n) */
    double *value, *factor; /* dense: (3 count, 3 count) */
    int *pivot;
    double *x; /* sparse: (n, 3) */
};

CpsiGraphMatrix *cpsi_graph_matrix_new(int n, size_t edges, const int (*edge)[2]) {
    CpsiGraphMatrix *matrix = calloc(1, sizeof *matrix);
    if (!matrix) return NULL;
    const size_t unknowns = 3 * (size_t)n;
    bool done;
    if (n <= DENSE) {
        matrix->value = malloc((2 * unknowns * unknowns + 1) * sizeof *matrix->value);
        matrix->factor = matrix->value ? matrix->value + unknowns * unknowns : NULL;
        matrix->pivot = malloc((unknowns + 1) * sizeof *matrix->pivot);
        done = matrix->value && matrix->pivot;
    } else {
        matrix->sparse = cpsi_block_lu_new(n, edges, edge, MOST);
        matrix->node = malloc((size_t)n * sizeof *matrix->node);
        matrix->x = malloc(unknowns * sizeof *matrix->x);
        done = matrix->sparse && matrix->node && matrix->x;
    }
    if (done) return matrix;
    cpsi_graph_matrix_free(matrix);
    return NULL;
}

void cpsi_graph_matrix_free(CpsiGraphMatrix *matrix) {
    if (!matrix) return;
    cpsi_block_lu_free(matrix->sparse);
    free(matrix->node);
    free(matrix->value);
    free(matrix->pivot);
    free(matrix->x);
    free(matrix);
}

void cpsi_graph_matrix_use(CpsiGraphMatrix *matrix, int count, const int *node) {
    matrix->count = count;
    if (!matrix->sparse) return;
    memcpy(matrix->node, node, (size_t)count * sizeof *node);
    cpsi_block_lu_use(matrix->sparse, count, node);
}

static size_t unknowns(const CpsiGraphMatrix *matrix) { return 3 * (size_t)matrix->count; }

void cpsi_graph_matrix_clear(CpsiGraphMatrix *matrix) {
    if (matrix->sparse)
        cpsi_block_lu_clear(matrix->sparse);
    else
        memset(matrix->value, 0, unknowns(matrix) * unknowns(matrix) * sizeof *matrix->value);
}

CpsiGraphBlock cpsi_graph_matrix_block(CpsiGraphMatrix *matrix, int i, int j) {
    if (matrix->sparse)
        return (CpsiGraphBlock){cpsi_block_lu_at(matrix->sparse, matrix->node[i], matrix->node[j]),
                                3};
    const size_t n = unknowns(matrix);
    return (CpsiGraphBlock){&matrix->value[3 * (size_t)i * n + 3 * (size_t)j], n};
}

/* The entry of two unknowns. */
static double *entry(CpsiGraphMatrix *matrix, int i, int j) {
    const CpsiGraphBlock block = cpsi_graph_matrix_block(matrix, i / 3, j / 3);
    return &block.at[(size_t)(i % 3) * block.stride + (size_t)(j % 3)];
}

void cpsi_graph_matrix_add(CpsiGraphMatrix *matrix, const CpsiJointMap *to,
                           const CpsiJointMap *from, const double *k, int stride) {
    for (int i = 0; i < to->width; i++)
        for (int j = 0; j < from->width; j++) {
            double sum = 0;
            for (int a = 0; a < 3; a++)
                for (int b = 0; b < 3; b++)
                    sum += to->by[a][i] * k[stride * a + b] * from->by[b][j];
            *entry(matrix, to->first + i, from->first + j) += sum;
        }
}

void cpsi_graph_matrix_add_body(CpsiGraphMatrix *matrix, int first, const double stiffness[36]) {
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) *entry(matrix, first + i, first + j) += stiffness[6 * i + j];
}

/* The first block of row i, and the number of columns that follow it. */
static CpsiGraphBlock row_of(CpsiGraphMatrix *matrix, int i, int *blocks) {
    double *at;
    *blocks = matrix->count;
    if (!matrix->sparse) return cpsi_graph_matrix_block(matrix, i, 0);
    *blocks = cpsi_block_lu_row(matrix->sparse, matrix->node[i], &at);
    return (CpsiGraphBlock){at, 3};
}

void cpsi_graph_matrix_turn(CpsiGraphMatrix *matrix, int i, const double p[3][3]) {
    int blocks;
    const CpsiGraphBlock row = row_of(matrix, i, &blocks);
    const size_t next = matrix->sparse ? 9 : 3;
    for (int k = 0; k < blocks; k++)
        for (size_t j = 0; j < 3; j++) {
            double *at = &row.at[(size_t)k * next + j];
            const double old[3] = {at[0], at[row.stride], at[2 * row.stride]};
            for (size_t a = 0; a < 3; a++)
                at[a * row.stride] = p[a][0] * old[0] + p[a][1] * old[1] + p[a][2] * old[2];
        }
}

void cpsi_graph_matrix_fix(CpsiGraphMatrix *matrix, int i, int a) {
    int blocks;
    const CpsiGraphBlock row = row_of(matrix, i, &blocks);
    const size_t next = matrix->sparse ? 9 : 3;
    for (int k = 0; k < blocks; k++)
        memset(&row.at[(size_t)k * next + (size_t)a * row.stride], 0, 3 * sizeof *row.at);
    cpsi_graph_matrix_block(matrix, i, i).at[(size_t)a * row.stride + (size_t)a] = 1;
}

bool cpsi_graph_matrix_factor(CpsiGraphMatrix *matrix) {
    if (matrix->sparse) return cpsi_block_lu_factor(matrix->sparse);
    const size_t n = unknowns(matrix);
    memcpy(matrix->factor, matrix->value, n * n * sizeof *matrix->factor);
    return cpsi_lu_factor((int)n, matrix->factor, matrix->pivot);
}

void cpsi_graph_matrix_solve(CpsiGraphMatrix *matrix, double *x) {
    if (!matrix->sparse) {
        cpsi_lu_solve((int)unknowns(matrix), matrix->factor, matrix->pivot, x);
        return;
    }
    for (int k = 0; k < matrix->count; k++)
        memcpy(&matrix->x[3 * matrix->node[k]], &x[3 * k], 3 * sizeof *x);
    cpsi_block_lu_solve(matrix->sparse, matrix->x);
    for (int k = 0; k < matrix->count; k++)
        memcpy(&x[3 * k], &matrix->x[3 * matrix->node[k]], 3 * sizeof *x);
}
