/* SPDX-License-Identifier: BSD-3-Clause */
/* The factor L D L' of a large dense symmetric quasi-definite matrix, by blocks.
 *
 * The lower triangle lies in panels of CPSI_DENSE_PANEL columns, one after the other, each from its
 * first column's row on. The rows of a panel are taken eight at a time (base/lanes.h): of each
 * eight rows the panel's columns follow one another, and of each column the eight numbers. */
#ifndef CAPSTAN_SRC_LINALG_DENSE_LDL_H
#define CAPSTAN_SRC_LINALG_DENSE_LDL_H

#include <stdbool.h>
#include <stddef.h>

enum { CPSI_DENSE_PANEL = 96 };

typedef struct CpsiDenseLdl CpsiDenseLdl;

/* Loops over lanes, compiled once for each width of registers (base/width.h). */
typedef struct CpsiDenseLoops {
    bool (*factor)(const CpsiDenseLdl *ldl, double least, double share);
    void (*forward)(const CpsiDenseLdl *ldl, double *x);
    void (*backward)(const CpsiDenseLdl *ldl, double *x);
} CpsiDenseLoops;

extern const CpsiDenseLoops cpsi_dense_loops_128, cpsi_dense_loops_256, cpsi_dense_loops_512;

struct CpsiDenseLdl {
    int given, n; /* size, and that rounded up to whole lanes */
    void *block;
    double *matrix; /* panels, at a place in `block` */
    double *pivot;  /* (n) D */
    /* (n) the sum of the absolute values of the terms of each diagonal entry so far, to which those
     * of the elimination are added */
    double *terms;
    double *scratch;   /* (CPSI_DENSE_PANEL^2) */
    signed char *sign; /* (n) */
    const CpsiDenseLoops *loops;
};

/* Number of columns of the panel that begins with column `first`. */
static inline int cpsi_dense_width(const CpsiDenseLdl *ldl, int first) {
    return ldl->n - first < CPSI_DENSE_PANEL ? ldl->n - first : CPSI_DENSE_PANEL;
}

/* Where the panel begins whose first column is `first`. */
static inline double *cpsi_dense_panel(const CpsiDenseLdl *ldl, int first) {
    const size_t before = (size_t)first, n = (size_t)ldl->n;
    return &ldl->matrix[before * n - before * (before - (size_t)CPSI_DENSE_PANEL) / 2];
}

/* Allocate for a matrix of this size. *width: as cpsi_width_once keeps it. Returns false when
 * memory does not suffice. */
bool cpsi_dense_ldl_new(CpsiDenseLdl *ldl, int size, int *width);
void cpsi_dense_ldl_free(CpsiDenseLdl *ldl);

/* Set row i of the lower triangle from `row` (i + 1); `terms` belongs to its diagonal entry. */
void cpsi_dense_ldl_row(CpsiDenseLdl *ldl, int i, const double *row, double terms,
                        signed char sign);

/* Replace the matrix by its factor. A pivot is at least `least`, and at least that share of its
 * terms, in the direction of its sign, as in cpsi_ldl_factor. Returns false where one is not
 * finite.
 */
bool cpsi_dense_ldl_factor(CpsiDenseLdl *ldl, double least, double share);

/* x (n) = L^-1 x, and x = L'^-1 D^-1 x. */
void cpsi_dense_ldl_forward(const CpsiDenseLdl *ldl, double *x);
void cpsi_dense_ldl_backward(const CpsiDenseLdl *ldl, double *x);

#endif
