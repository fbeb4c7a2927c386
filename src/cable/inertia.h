/* SPDX-License-Identifier: BSD-3-Clause */
/* The inertia of a line: what a step in time adds to a quasi-static one (docs/theory.md 9).
 *
 * With x* and v* of the scheme and k its span of time, the node moves with v = (x - x*)/k and has
 * the acceleration (v - v*)/k: beside all other forces there acts -m/k^2 (x - x* - k v*), a field
 * of the line (node_field.h). Friction is measured from x*, which is the reference of the step, and
 * on ground that turns from x* of where the ground has taken both places (contact_carry.h). */
#ifndef CAPSTAN_SRC_CABLE_INERTIA_H
#define CAPSTAN_SRC_CABLE_INERTIA_H

#include <stdbool.h>

#include "capstan/scene.h"

/* The internal damping of a line (damping.h). */
typedef struct CpsiDamping {
    double coefficient; /* [N s] BA >= 0; 0: none, and the arrays are NULL */
    double *elongation; /* (n) [-] d_n of each element, and d_{n-1} */
    double *before;
    double *rest;       /* (n) [-] r of the step; 0 after a quasi-static one */
    double *own_factor; /* (n) line->compliance_factor without damping */
} CpsiDamping;

/* The backward difference formula of second order for a step of length h, w = h over the length of
 * the step before:
 *
 *     x* = x_n + back (x_n - x_{n-1}),    back = w^2/(1 + 2 w),    k = h (1 + w)/(1 + 2 w),
 *
 * 1/3 and 2 h/3 after a step as long. Of an implicit Euler step back = 0 and k = h. */
typedef struct CpsiFormula {
    double length; /* [s] h > 0 */
    double ratio;  /* [-] w > 0 */
    double back;   /* [-] */
    double span;   /* [s] k */
} CpsiFormula;

static inline CpsiFormula cpsi_formula(double length, double ratio) {
    const double all = 1 + 2 * ratio;
    return (CpsiFormula){length, ratio, ratio * ratio / all, length * (1 + ratio) / all};
}

typedef struct CpsiInertia {
    bool is_moving; /* the last step, or the one under way, is one in time */
    double *mass;   /* (n) [kg] of the nodes */
    /* the step */
    double *span;           /* (n) [s] k */
    double *rest_velocity;  /* (n, 3) [m/s] v* */
    double *start;          /* (n, 3) [m] x_n, where it began */
    double *start_velocity; /* (n, 3) [m/s] v_n */
    double *velocity;       /* (n, 3) [m/s] v_{n+1} */
    double *before;         /* (n, 3) [m] x_{n-1}, of the next step x_n; changed where nodes bear */
    double *before_velocity; /* (n, 3) [m/s] v_{n-1}, likewise */
    double *past;            /* (n, 3) [m] x_{n-1} as it was */
    bool *restarts;          /* (n) the next step of the node is an Euler step */
    bool *late;              /* (n) scratch: this step was to be one */
    bool *is_euler;          /* (n) ... and whether it is one */
    bool velocity_given[2];  /* of ends A and B, by the caller */
    bool goes_too_far;       /* the step is too long for what it goes round, or past: no answer */
    bool moved_in_span;  /* the line's shifts and turns are those in the span, less than a step */
    CpsiFormula formula; /* of the nodes that take no Euler step */
    double error;        /* [m] that the step makes by itself, by its estimate (pace.h) */
    CpsiDamping damping;
    double kinetic;        /* [J] */
    double position_bound; /* [m] */
    bool settles;   /* the quasi-static step under way brings the line to rest (settling.h) */
    double settled; /* [J] ... and what its first part loses beside the kinetic energy */
    CpsMotionLedger ledger;
    int landed, changed, snatched; /* contacts, contacts, elements (CpsLineMotion) */
} CpsiInertia;

#endif
