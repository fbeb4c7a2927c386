/* SPDX-License-Identifier: BSD-3-Clause */
/* A program over a chain of scalars:
 *
 *     min   sum_g q_g y_g^2/2  +  sum_k |v_k|_P^2/2  -  load.(y, v)
 *     s.t.  G_k (y_g, y_g+1, v_k) + h_k in K_k      at each site k
 *
 * A site depends on at most two scalars, neighbours in the chain, and on at most three unknowns of
 * its own, v_k; K_k is a product of half-lines and second-order cones. The sites' own unknowns are
 * eliminated site by site, which leaves a tridiagonal matrix: time and memory are linear in the
 * number of sites. Solved by the loop of ipm.h. Data are dimensionless and of order one. */
#ifndef CAPSTAN_SRC_CHAIN_SCALAR_PROGRAM_H
#define CAPSTAN_SRC_CHAIN_SCALAR_PROGRAM_H

#include "ipm/cones.h"

enum { CPSI_SITE_OWN = 3, CPSI_SITE_SEEN = 2 + CPSI_SITE_OWN };

typedef struct CpsiSite {
    int scalar[2]; /* indices of the scalars it depends on, -1: none; two differ by one */
    int own;       /* unknowns of its own, 0..3 */
    int at;        /* index of the first of these in u */
    int row, rows; /* of G and h */
    int cone, cones;
    double weight[CPSI_SITE_OWN *
                  CPSI_SITE_OWN]; /* P (own, own) in the corner of (3, 3), symmetric >= 0 */
    double factor[CPSI_SITE_OWN * CPSI_SITE_OWN]; /* Cholesky factor of the condensed block */
    double couple[2 * CPSI_SITE_OWN]; /* (2, 3) the scalars' columns, solved with the factor */
} CpsiSite;

typedef struct CpsiScalarProgram {
    CpsiProgram base; /* u: the scalars, then the sites' own unknowns */
    int scalars, sites;
    int max_sites, max_rows, max_scalars;
    double *weight; /* (scalars) q_g >= 0 */
    CpsiSite *site;
    double (*g)[CPSI_SITE_SEEN]; /* (rows) */
    double *h;                   /* (rows) */
    int *dim;                    /* (cones) */
    CpsiCones cones;
    double *diagonal, *off, *pivot; /* (scalars) the matrix, and its factor */
} CpsiScalarProgram;

/* Place a program of at most so many scalars, sites and rows in the arena. */
void cpsi_scalar_program_layout(CpsiScalarProgram *program, CpsiArena *arena, int scalars,
                                int sites, int rows);

/* Start a new program with so many scalars and no sites, weights or loads. */
void cpsi_scalar_program_begin(CpsiScalarProgram *program, int scalars);

/* Add a site without rows. The scalars may be in any order, equal or -1 (the second is -1 then). */
CpsiSite *cpsi_scalar_program_site(CpsiScalarProgram *program, int first, int second, int own);

/* Add a cone of dimension `dim` to the last site. Its rows of G and h are consecutive and zero;
 * returns the first. */
int cpsi_scalar_program_cone(CpsiScalarProgram *program, int dim);

/* The program is complete: set u = 0. */
void cpsi_scalar_program_end(CpsiScalarProgram *program);

/* The same weight on all unknowns. */
void cpsi_scalar_program_weigh(CpsiScalarProgram *program, double weight);

/* Smallest distance of the rows of site k from the boundary of their cones, negative outside. */
double cpsi_scalar_program_margin(const CpsiScalarProgram *program, int k);

/* The sum of z.h: with load + G'z = 0 it is an upper bound of load.(y, v). The remaining residual
 * load + G'z and the weights are added with their values at the solution. */
double cpsi_scalar_program_bound(const CpsiScalarProgram *program);

#endif
