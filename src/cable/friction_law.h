/* SPDX-License-Identifier: BSD-3-Clause */
/* The set of friction forces of a node, in the axes of its contact: an ellipse or a box of
 * half-axes w r_1 and w r_2, with w the friction bound of the node and r the ratios of its two
 * coefficients to the larger one; or w times a given set. */
#ifndef CAPSTAN_SRC_CABLE_FRICTION_LAW_H
#define CAPSTAN_SRC_CABLE_FRICTION_LAW_H

#include "cable/friction_set.h"
#include "cable/line.h"

struct CpsiFrictionLaw {
    double friction; /* [-] the larger coefficient, 1 for a given set: w = friction R */
    double ratio[2]; /* of the coefficients along the two tangents to it, 0..1, the larger is 1 */
    bool box;
    const CpsiFrictionSet *given; /* NULL: ellipse or box */
};

/* The law of contact c of a line, by the obstacle that it is with and its place on the line. */
CpsiFrictionLaw cpsi_friction_law(const CpsiLine *line, int c);

/* Lay out line->friction_law, the law of every contact: when contacts have been detected or moved
 * along the line, once per round. */
void cpsi_line_lay_out_friction(CpsiLine *line);

/* phi(u) + <F, u> >= 0 [J], of a force F in the set and a way u, both in the tangent axes; without
 * cancellation but for a given set. */
double cpsi_friction_law_gap(const CpsiFrictionLaw *set, double bound, const double force[2],
                             const double slip[2]);
/* phi(u) [J]. */
double cpsi_friction_law_dissipation(const CpsiFrictionLaw *set, double bound,
                                     const double slip[2]);
/* The force, scaled back into the set of `bound` where it lies outside; for a given set from that
 * of the bound `within`, in which it is. */
void cpsi_friction_law_clip(const CpsiFrictionLaw *set, double within, double bound,
                            double force[2]);
/* How far the force may still grow in whatever direction before it leaves the set [N], a lower
 * bound; 0 for a given set. */
double cpsi_friction_law_margin(const CpsiFrictionLaw *set, double bound, const double force[2]);

#endif
