/* SPDX-License-Identifier: BSD-3-Clause */
/* Points of elements (chain_system.h): the functions that both back ends use.
 *
 * With the point's force phi = D x_p as an unknown, in axes Q_p turned to where D is diagonal,
 *
 *     E x_p - (phi - c phi_z) = 0,     E the diagonal of D, c = skew/zz,
 *
 * each equation divided by its entry of E where that is larger than 1, so that D may be anything
 * from 0 up. */
#ifndef CAPSTAN_SRC_CHAIN_POINT_H
#define CAPSTAN_SRC_CHAIN_POINT_H

#include "chain/chain_system.h"

typedef struct CpsiPointLaw {
    double e[3], c[2]; /* E; c */
    double size[3];    /* the divisors of the equations */
    double axes[9];    /* Q_p */
    double turn[9];    /* rotates the point's own axes to Q_p */
} CpsiPointLaw;

/* The law of the point of element j. */
CpsiPointLaw cpsi_point_law(const CpsiMatrix *a, int j);

/* R (9): takes a vector in the axes of a point to those of node `node`. */
void cpsi_point_turn(const CpsiMatrix *a, int node, const double axes[9], double r[9]);

/* Distribute the forces on the points to their nodes; x (2 n, 3), 0 at the points on return. */
void cpsi_points_spread(const CpsiMatrix *a, double *x);

/* The displacements of the points from those of their nodes and from their forces: on entry x (2 n,
 * 3) holds phi at the points. In stiff directions the force determines the displacement more
 * accurately than the nodes do, in soft directions it is the other way round: (E + s) x_p = E x_p +
 * s x_p, the first by the force and the second by the nodes, with s the size of the forces over
 * that of the displacements. t (n) are the tensions. */
void cpsi_points_place(const CpsiMatrix *a, const double *t, double *x);

#endif
