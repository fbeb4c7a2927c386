/* SPDX-License-Identifier: BSD-3-Clause */
/* Free points that are held to convex sets (capstan/constraint.h; docs/theory.md 6k). */
#ifndef CAPSTAN_SRC_EVOLVE_POINT_SET_H
#define CAPSTAN_SRC_EVOLVE_POINT_SET_H

#include "evolve/trial.h"

/* The reaction of the set of a point, and what nothing balances then, from the forces `rest` that
 * all else leaves on it. `soft`: the least stiffness [N/m] that is asked with, of the size of a
 * force over a length. */
void cpsi_point_set_hold(CpsiFree *at, double soft);

/* How the place to which the set brings the point depends on where it would go without it: the
 * derivative of the projection, symmetric, with eigenvalues from 0 to 1. */
void cpsi_point_set_derivative(const CpsiFree *at, double out[3][3]);

/* Is the point in its set and in no obstacle? True of one without a set. */
bool cpsi_point_set_is_kept(const CpsiBalance *balance, const CpsiFree *at);

/* The set of point `index`, NULL: none. */
CpsiEndSet *cpsi_set_of_point(const CpsEvolution *evolution, int index);

#endif
