/* SPDX-License-Identifier: BSD-3-Clause */
/* A system small enough for dense bases, in which the reduced law and the sets of all solutions are
 * written.
 *
 *     V = E W + N y         rows of N orthonormal, D N = 0, C N = 0;  D E = 1, C E = 0
 *     F = F0 + L t          rows of L orthonormal: the forces with N (B*F + load) = 0, in
 *                           equilibrium for some G,
 *     lambda */
#ifndef CAPSTAN_SRC_DRIVE_NULL_SPACE_H
#define CAPSTAN_SRC_DRIVE_NULL_SPACE_H

#include "drive/system.h"

typedef struct CpsiDense {
    int n, components, free, balanced; /* q rows of N, p rows of L */
    double *map;                       /* (components, n) B */
    double *kernel;                    /* (free, n) N */
    double *forces;                    /* (balanced, components) L */
    double *start;                     /* (components) F0 of least norm */
    bool contradiction;                /* nothing can balance the load: there is no F0 */
    double *all, *force_all;           /* memory of the bases */
} CpsiDense;

CpsStatus cpsi_dense_new(const CpsSystem *system, CpsiDense *out, CpsError *err);
void cpsi_dense_clear(CpsiDense *dense);

/* Set to zero what is rounding among products of size `size`; a set would treat it as a
 * direction. */
void cpsi_dense_round(size_t count, double size, double *a);

#endif
