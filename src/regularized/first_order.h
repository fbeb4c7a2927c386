/* SPDX-License-Identifier: BSD-3-Clause */
/* P10.1 of S90 annex 5 as a convex function of the displacement, for given multipliers of friction
 * and contact.
 *
 * With x_R' = s t, the tension T_R = K (s - 1)^+ of the reference and e = (s - 1)^+, the
 * first-order tension (84) comes from
 *
 *    Q(u) = sum w_i [ T_R t.u' + (K/2s) (e |u'|^2 + (t.u')^2) ] - sum b_j.u_j
 *
 * and (90), (79)-(82) are its minimum plus sum A_j |u_T,j| over n.u_j + gap_j >= 0. Both are added
 * as augmented Lagrangians, with the friction q in the disc of radius A and the reaction R >= 0 as
 * multipliers:
 *
 *    q <- P_disc(q + r u_T),     R <- (R - r (n.u + gap))^+,     and a small k/2 |u - u_before|^2,
 *
 * so that each round minimises a strictly convex function with a continuous gradient. A load that
 * no force can balance shows as a force k (u - u_before) that does not decrease from round to
 * round. */
#ifndef CAPSTAN_SRC_REGULARIZED_FIRST_ORDER_H
#define CAPSTAN_SRC_REGULARIZED_FIRST_ORDER_H

#include "capstan/regularized.h"
#include "regularized/newton.h"
#include "regularized/step_data.h"

enum { CPSI_FIRST_ORDER_BAND = 5 };

typedef struct CpsiFirstOrder {
    const CpsiStep *step;
    int unknowns;           /* 3 per node that is free */
    double *tangent;        /* (m, 3) t */
    double *stretch;        /* (m) s = |x_R'| */
    double *strain;         /* (m) e; 0: slack, an element of D */
    double *gap;            /* (m + 1) [m] n.u >= -gap; INFINITY: no condition */
    double *u;              /* (m + 1, 3) [m] */
    double *before;         /* (m + 1, 3) [m] u of the preceding round */
    double *friction_force; /* (m + 1, 3) [N] q */
    double *push;           /* (m + 1) [N] R */
    double *gradient;       /* (m + 1, 3) [N] */
    double augment;         /* [N/m2] r per length */
    double anchor;          /* [N/m2] k per length */
} CpsiFirstOrder;

CpsiSmooth cpsi_first_order_smooth(CpsiFirstOrder *f);
void cpsi_first_order_store(CpsiFirstOrder *f, const double *u);

/* u' and (84) in an element */
void cpsi_first_order_slope(const CpsiFirstOrder *f, int element, double slope[3]);
void cpsi_first_order_tension(const CpsiFirstOrder *f, int element, double tension[3]);

/* The multipliers of a node updated for u. */
void cpsi_first_order_multipliers(const CpsiFirstOrder *f, int node, double friction_force[3],
                                  double *push);

#endif
