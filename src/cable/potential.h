/* SPDX-License-Identifier: BSD-3-Clause */
/* The potential of a program on a line (capstan/loads.h).
 *
 * A round of a step has its quadratic model at the place of the round before, a load and a
 * stiffness of each node: Newton's method on the energy with U. The place of the last round is the
 * answer: U is convex, so that a minimum of the energy with the force there as a given load is one
 * of the energy with U. */
#ifndef CAPSTAN_SRC_CABLE_POTENTIAL_H
#define CAPSTAN_SRC_CABLE_POTENTIAL_H

#include "cable/line.h"

/* Let load and stiffness of the nodes be those of the model at the positions x (n, 3). */
void cpsi_potential_model(CpsiLine *line, const double *x);
/* Let the force of the model at the position be a given load, and the stiffness that of the springs
 * alone; the energy is that at the position. */
void cpsi_potential_settle(CpsiLine *line);
/* [N] The sum of what its forces at the position and those of the model there differ by; 0 without
 * a potential, and 1e300 where it is concave or not finite. */
double cpsi_potential_change(const CpsiLine *line);
/* [N/m] Of node j at its position, where the forces are settled: its springs and the second
 * derivatives of the potential, xx, xy, yy, xz, yz, zz. For a line with a field. */
void cpsi_potential_stiffness(const CpsiLine *line, int j, double out[6]);
/* [J] Its energy at the positions x (n, 3). */
double cpsi_potential_energy(const CpsiLine *line, const double *x);

#endif
