/* SPDX-License-Identifier: BSD-3-Clause */
/* The set of friction forces of a node, in the axes of its contact: an ellipse or a box of
 * half-axes w r_1 and w r_2, with w the friction bound of the node and r the ratios of its two
 * coefficients to the larger one; or w times a given set. */
#ifndef CAPSTAN_SRC_CABLE_FRICTION_LAW_H
#define CAPSTAN_SRC_CABLE_FRICTION_LAW_H

#include "cable/friction_set.h"
#include "cable/line.h"

typedef struct CpsiFrictionLaw {
    double friction; /* [-] the larger coefficient, 1 for a given set: w = friction R */
    double ratio[2]; /* of the coefficients along the two tangents to it, 0..1, the larger is 1 */
    bool box;
    const CpsiFrictionSet *given; /* NULL: ellipse or box */
} CpsiFrictionLaw;

/* The factor of the friction zones at contact c: that of its node, or between those of its
 * element's nodes. */
static inline double cpsi_line_factor(const CpsiLine *line, int c) {
    const int e = cpsi_line_element(line, c);
    if (!line->friction_factor) return 1;
    if (e < 0) return line->friction_factor[cpsi_line_node(line, c)];
    return (1 - line->beta[e]) * line->friction_factor[e] +
           line->beta[e] * line->friction_factor[e + 1];
}

/* That of contact c of a line. */
static inline CpsiFrictionLaw cpsi_friction_law(const CpsiLine *line, int c) {
    const CpsiObstacle *obstacle = cpsi_line_obstacle(line, c);
    const double factor = cpsi_line_factor(line, c);
    const CpsiFrictionSet *given =
        obstacle && obstacle->has_set ? line->friction_set[obstacle - line->obstacle] : NULL;
    if (!obstacle || (obstacle->has_set && !given)) return (CpsiFrictionLaw){.ratio = {1, 1}};
    if (obstacle->has_set) return (CpsiFrictionLaw){.friction = factor, .given = given};
    const double *mu = obstacle->friction, friction = fmax(mu[0], mu[1]),
                 by = friction > 0 ? 1 / friction : 0;
    return (
        CpsiFrictionLaw){.friction = factor * friction,
                         .ratio = {friction > 0 ? mu[0] * by : 1, friction > 0 ? mu[1] * by : 1},
                         .box = obstacle->shape == CPS_FRICTION_BOX};
}

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
