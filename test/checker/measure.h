/* SPDX-License-Identifier: BSD-3-Clause */
/* Every quantity of a step problem, recomputed from a record. */
#ifndef CAPSTAN_CHECKER_MEASURE_H
#define CAPSTAN_CHECKER_MEASURE_H

#include <stdbool.h>

#include "record.h"

typedef struct Measures {
    const char *missing;     /* the first variable with a value that cannot be (NaN, infinite, negative), or NULL */
    double length;           /* [m] sum of the element lengths */
    double extent;           /* [m] largest coordinate */
    double primal, dual;     /* [J] */
    double gap;              /* [J] sum of |local gap| over segments, friction and contact */
    double overlong;         /* [J] part of the gap from inextensible elements longer than they may be */
    double identity;         /* [J] primal - dual - sum of local gaps + work of the imbalance: rounding only */
    double identity_noise;   /* [J] what rounding may leave there */
    double scale;            /* [J] S */
    double slid;             /* [J] sum of w |u_T| */
    double law, contact;     /* [J] parts of the gap */
    double force;            /* [N] largest imbalance on a node that is not held */
    double largest_force;    /* [N] */
    double friction_excess;  /* [N] max |F| - w */
    double friction_normal;  /* [N] max |F.n| */
    double reaction_least;   /* [N] */
    double stray_force;      /* [N] friction or reaction where there is no obstacle or the end is held */
    double penetration;      /* [m] max -(n.u + gap), >= 0 */
    bool watched;            /* contact is looked for at every node that has a normal and is not held */
    double normal_error;     /* [-] max | |n| - 1 | where there is a normal */
    double stretch;          /* [-] max |e| - 1 over inextensible elements */
    double strain_error;     /* [-] max |e| - 1 - c T beyond rounding: the tension must carry the elongation */
    double tension_least;    /* [N] */
    double tension_estimate; /* [N] max |T - |p|| */
    double tension_bound;    /* [N] sqrt(2 gap / (c L)), NaN for c = 0 */
    double held_error;       /* [m] how far a held end is from where it is imposed */
    double ends_distance;    /* [m] of two imposed ends, NaN otherwise */
    double rigid_fall;       /* [N] fall of the energy per metre along `proof`, NaN without a proof vector */
    double rigid_rise_least; /* [-] min n.proof over nodes that may touch */
} Measures;

Measures measure(const Record *record);

#endif
