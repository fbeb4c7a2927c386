/* SPDX-License-Identifier: BSD-3-Clause */
/* The chain's elimination of a node whose element has a point (chain_system.h).
 *
 * With the point's force phi = D x_p as unknowns beside the tension, in the axes Q_p of point.h,
 * and R = Q_j Q_p^T, the block of node j reads
 *
 *     S_j = [ X  V ; V'^T  -B ],    V = P + k C N,   V' = P' + k C^T N',   B = A + N'^T C N
 *
 * P and N hold the forces of the unknowns (t, phi) on node j and on the node before, P = [m, b R],
 * N = [-m, (1 - b) R]; P' and N' hold the coefficients of these nodes in the equations of the
 * unknowns. The equations of the point are, with E the diagonal of D and c = skew/zz,
 *
 *     E x_p - (phi - c phi_z) = 0
 *         each divided by its entry of E where that is larger than 1, so that D may be anything
 *         from 0 up
 *
 * S_j is inverted as a whole, with row exchanges; the second direction of the node, if it has one,
 * is an eighth unknown. */
#ifndef CAPSTAN_SRC_CHAIN_CHAIN_POINT_H
#define CAPSTAN_SRC_CHAIN_CHAIN_POINT_H

#include "chain/chain_system.h"

/* Unknowns of a block: x_j (3), t_j, phi (3), f of the second direction. */
enum { CPSI_CHAIN_POINT = 8 };

typedef struct CpsiChainPoint {
    double inverse[CPSI_CHAIN_POINT * CPSI_CHAIN_POINT];
} CpsiChainPoint;

/* Invert the block of node j. x (9): X; c (9): C of the node before, and m (3), in the axes of node
 * j. False where a pivot is 0 or not finite. */
bool cpsi_chain_point_factor(CpsiChainPoint *point, const CpsiMatrix *a, int j, const double x[9],
                             const double c[9], const double m[3]);

/* C_j. */
void cpsi_chain_point_compliance(const CpsiChainPoint *point, double c[9]);

/* x_j, t_j, phi and f of the second direction for the force f on the node, h of its element and the
 * place `before` of the node before, all in the axes of node j; phi (3) in those of the point. On
 * entry phi and *second hold the right-hand sides of their equations. */
void cpsi_chain_point_solve(const CpsiChainPoint *point, const CpsiMatrix *a, int j,
                            const double f[3], double h, const double before[3], double x[3],
                            double *t, double phi[3], double *second);

/* The change of the unknowns of the block for a change of the force on node j. */
void cpsi_chain_point_add(const CpsiChainPoint *point, const double force[3],
                          double more[CPSI_CHAIN_POINT]);

/* Subtract the force of the point of element j + 1 on node j from `pull`, in the axes of node j. */
void cpsi_chain_point_pull(const CpsiMatrix *a, int j, const double phi[3], double pull[3]);

#endif
