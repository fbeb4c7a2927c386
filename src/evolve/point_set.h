/* SPDX-License-Identifier: BSD-3-Clause */
/* Free points that are held to convex sets (capstan/constraint.h; docs/theory.md 6k). */
#ifndef CAPSTAN_SRC_EVOLVE_POINT_SET_H
#define CAPSTAN_SRC_EVOLVE_POINT_SET_H

#include "base/vec3.h"
#include "cable/in_set.h"

/* A point in a set: where it is, and what all but the set does to it. */
typedef struct CpsiInSet {
    CpsiEndSet *on; /* NULL: it is in none */
    Vec3 place, rest;
    double yields; /* [N/m] the stiffness with which the reaction is asked for */
    Vec3 reaction; /* [N] of the set, */
    double own[3]; /* ... and in the axes of the set */
} CpsiInSet;

/* The reaction of the set; returns what nothing balances then. */
Vec3 cpsi_in_set_hold(CpsiInSet *in);

/* How the place to which the set brings the point depends on where it would go without it: the
 * derivative of the projection, symmetric, with eigenvalues from 0 to 1. */
void cpsi_in_set_slopes(const CpsiInSet *in, double out[3][3]);

#endif
