/* SPDX-License-Identifier: BSD-3-Clause */
/* Sets of the plane or of space, {origin + P v : A v + b in K}, K a product of half-lines and
 * second-order cones, in long double: support and distance, with bounds of their own. */
#ifndef CAPSTAN_CHECKER_CONIC_H
#define CAPSTAN_CHECKER_CONIC_H

#include <stdbool.h>
#include <stddef.h>

typedef long double Real;

typedef struct Conic {
    size_t space, unknowns, rows; /* space: 2 or 3 */
    size_t *cone;                 /* (rows) rows of the cone that begins here, 0: none begins */
    Real *a, *b;                  /* (rows, unknowns), (rows) */
    Real *map;                    /* (space, unknowns) P */
    Real *centre;                 /* (unknowns) inside every cone: conic_prepare */
    Real origin[3], reach;        /* reach: of P v, roughly */
} Conic;

/* Room for a set, zeroed; NULL: no memory. Its owner fills it and frees it. */
Conic *conic_create(size_t space, size_t unknowns, size_t rows);
void conic_free(Conic *set);

/* Find a point inside; where the cones leave no margin, they are widened by 1e-13 of their data.
 * False: there is none, or no memory. */
bool conic_prepare(Conic *set);

/* An upper bound of max <d, F> over the set, above it by no more than 1e-14 of reach |d|; where
 * rounding stops before, 1e-10. NAN: not found. */
Real conic_support(const Conic *set, const Real *d);
/* An upper bound of the distance of F from the set, as tight. NAN: no memory. */
Real conic_distance(const Conic *set, const Real *F);

#endif
