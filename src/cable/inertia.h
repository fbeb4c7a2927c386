/* SPDX-License-Identifier: BSD-3-Clause */
/* The inertia of a line: what a step in time adds to a quasi-static one (docs/theory.md 9).
 *
 * With x* and v* of the scheme and k its span of time, the node moves with v = (x - x*)/k and has
 * the acceleration (v - v*)/k: beside all other forces there acts -m/k^2 (x - x* - k v*), a field
 * of the line (node_field.h). Friction is measured from x*, which is the reference of the step. */
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
    bool *restarts;          /* (n) the next step of the node is an Euler step */
    bool *late;              /* (n) scratch: this step was to be one */
    bool *is_euler;          /* (n) ... and whether it is one */
    CpsiDamping damping;
    double kinetic;        /* [J] */
    double position_bound; /* [m] */
    CpsMotionLedger ledger;
    int landed, changed, snatched; /* contacts, contacts, elements (CpsLineMotion) */
} CpsiInertia;

#endif
