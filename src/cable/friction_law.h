/* SPDX-License-Identifier: BSD-3-Clause */
/* The friction law of a contact, in its axes: friction forces lie in an ellipse or a box of
 * half-axes w r_1 and w r_2, with w the friction bound and r the ratios of the two coefficients to
 * the larger one; or in w times a general set. */
#ifndef CAPSTAN_SRC_CABLE_FRICTION_LAW_H
#define CAPSTAN_SRC_CABLE_FRICTION_LAW_H

#include "cable/friction_set.h"

typedef struct CpsiFrictionLaw {
    double friction; /* [-] zone factor times the larger coefficient, or times 1: w = friction R */
    double ratio[2]; /* of the coefficients along the two tangents to it, 0..1, the larger is 1 */
    bool box;
    const CpsiFrictionSet *given; /* NULL: ellipse or box */
} CpsiFrictionLaw;

/* phi(u) + <F, u> >= 0 [J], of a force F in the set and a slip u, both in the tangent axes;
 * computed without cancellation except for a general set. */
double cpsi_friction_law_gap(const CpsiFrictionLaw *law, double bound, const double force[2],
                             const double slip[2]);
/* phi(u) [J]. */
double cpsi_friction_law_dissipation(const CpsiFrictionLaw *law, double bound,
                                     const double slip[2]);
/* Scale the force back into the set of `bound` where it lies outside; with a general set, scale it
 * from the set of the bound `within`, in which it lies. */
void cpsi_friction_law_clip(const CpsiFrictionLaw *law, double within, double bound,
                            double force[2]);
/* [N] Lower bound of the distance of the force from the boundary of the set; 0 for a general
 * set. */
double cpsi_friction_law_margin(const CpsiFrictionLaw *law, double bound, const double force[2]);

#endif
