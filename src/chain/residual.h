/* SPDX-License-Identifier: BSD-3-Clause */
/* Solving the equations of chain_system.h where elements have points, with one step of iterative
 * refinement. */
#ifndef CAPSTAN_SRC_CHAIN_RESIDUAL_H
#define CAPSTAN_SRC_CHAIN_RESIDUAL_H

#include "chain/chain_system.h"

/* The unknowns, or the right-hand sides of their equations. */
typedef struct CpsiUnknowns {
    /* (2 n, 3) displacements of the nodes in their axes, then forces of the points in the axes of
     * their laws (point.h); or forces on the nodes, which include those on the points, and the
     * residuals of the laws of the points */
    double *x;
    double *t; /* (n) tensions; or h */
    double *f; /* (n) forces of the second directions; or the residuals of r.x - a f; NULL: there
                  are none */
} CpsiUnknowns;

/* Place the arrays for n nodes with points. */
static inline CpsiUnknowns cpsi_unknowns_layout(CpsiArena *arena, int n) {
    CpsiUnknowns unknowns;
    CPSI_PLACE(arena, unknowns.x, 6 * (size_t)n);
    CPSI_PLACE(arena, unknowns.t, n);
    CPSI_PLACE(arena, unknowns.f, n);
    return unknowns;
}

/* Subtract the left-hand sides at the unknowns from the right-hand sides; 0 at held nodes. */
void cpsi_linsys_residual(const CpsiMatrix *matrix, const CpsiUnknowns *unknowns,
                          const CpsiUnknowns *right);

/* A back end's solve with its factors: right-hand sides to unknowns, in place. */
typedef void CpsiPass(const CpsiLinsys *self, const CpsiMatrix *matrix, const CpsiUnknowns *of);

/* Where elements have points, several stiff directions may meet in a node and be nearly parallel.
 * Each then carries the rounding errors of the others, up to ten digits. Therefore the residual is
 * solved for as well. `found` is as x, t and f of CpsiLinsysOps. */
void cpsi_linsys_solve_points(const CpsiLinsys *self, const CpsiMatrix *matrix, CpsiPass *pass,
                              const CpsiUnknowns *found, const CpsiUnknowns scratch[2]);

#endif
