/* SPDX-License-Identifier: BSD-3-Clause */
/* Nodes that are held to convex sets: by rows of their own (constraint.c), or by the conic form of
 * the set (conic_constraint.c). */
#ifndef CAPSTAN_SRC_CHAIN_CONSTRAINTS_H
#define CAPSTAN_SRC_CHAIN_CONSTRAINTS_H

#include <math.h>

#include "base/arena.h"

struct CpsiConicSet;

/* Rows A u + b of the node's displacement u in cones. */
enum { CPSI_CONSTRAINT_ROWS = 6, CPSI_CONE_ROWS = 4 };
typedef struct CpsiConstraint {
    int node, cones;
    int dim[CPSI_CONSTRAINT_ROWS]; /* (cones) 1 a half-line, > 1 second order, 0 an equation */
    double a[CPSI_CONSTRAINT_ROWS][3], b[CPSI_CONSTRAINT_ROWS]; /* A in the axes of the node */
    double s[CPSI_CONSTRAINT_ROWS], z[CPSI_CONSTRAINT_ROWS], q[CPSI_CONSTRAINT_ROWS];
    double ds[CPSI_CONSTRAINT_ROWS], dz[CPSI_CONSTRAINT_ROWS];
    double w[CPSI_CONSTRAINT_ROWS], g[CPSI_CONSTRAINT_ROWS];
} CpsiConstraint;

/* A node in { origin + P v : A v + b in K }, in space: v are unknowns of its own. */
typedef struct CpsiConicConstraint {
    int node;
    const struct CpsiConicSet
        *set;             /* P (3, unknowns), origin (3), in the caller's unit of length */
    double unit;          /* ... which this makes one of the program */
    double rows_per_unit; /* by how much rows change per the program's unit of length, roughly */
    double frame[3][3];   /* the common axes, each in the axes of the node */
    double at[3];         /* base - origin, in the program's unit of length */
    double force[3], d_force[3]; /* of the set on the node, in the common axes */
    double fixed[3]; /* the part of the direction of the force that du has no share in */
    double turn[9], compliance[3];   /* rows: eigenvectors of -du/d(force), and its eigenvalues */
    double *begin;                   /* (unknowns) v at the base, the caller's */
    double *v, *dv;                  /* (unknowns) */
    double *s, *z, *ds, *dz, *q, *w; /* (rows) */
    double *g;                       /* (cones) */
    double *basis, *factor;          /* (rows, unknowns), (unknowns, unknowns): M^1/2 A = Q R */
    double *reach;                   /* (unknowns, 3) R^-T P' */
    double *rest;                    /* (rows) M^1/2 g across the columns of Q */
    double *along, *missing;         /* (unknowns) y, and R^-T r in it */
    double *scratch;                 /* (4 rows) */
} CpsiConicConstraint;

typedef struct CpsiConstraints {
    int count, conic_count;
    CpsiConstraint item[2];        /* (count) */
    CpsiConicConstraint *conic[2]; /* (conic_count) the caller's */
} CpsiConstraints;

/* Place the arrays of a constraint by this set. */
void cpsi_conic_constraint_layout(CpsiConicConstraint *constraint, CpsiArena *arena,
                                  const struct CpsiConicSet *set);

/* e in ds = A du + rho + e dz, in units of the program (constraint.c). */
#define CPSI_YIELD 1e-9

/* A function of H^-1 = W^2/g: itself, the stiffness M = (H^-1 + e)^-1, or the root of that. */
typedef enum CpsiConePower {
    CPSI_CONE_COMPLIANCE,
    CPSI_CONE_STIFFNESS,
    CPSI_CONE_STIFFNESS_ROOT
} CpsiConePower;

static inline double cpsi_cone_power(double compliance, CpsiConePower power) {
    if (power == CPSI_CONE_COMPLIANCE) return compliance;
    const double stiffness = 1 / (compliance + CPSI_YIELD);
    return power == CPSI_CONE_STIFFNESS ? stiffness : sqrt(stiffness);
}

/* out = f(H^-1) x of a cone with the scaling (w, g); M has the eigenvectors of W, in which nothing
 * cancels. */
static inline void cpsi_cone_power_apply(double *out, const double *x, int dim, const double *w,
                                         double g, CpsiConePower power) {
    if (dim == 1) {
        out[0] = cpsi_cone_power(1 / g, power) * x[0];
        return;
    }
    double size = 0, along = 0;
    for (int r = 1; r < dim; r++) size += w[r] * w[r];
    size = sqrt(size);
    const double over = size > 0 ? 1 / size : 0;
    for (int r = 1; r < dim; r++) along += over * w[r] * x[r];
    const double wide = (w[0] + size) * (w[0] + size),
                 up = cpsi_cone_power(wide / g, power) * 0.5 * (x[0] + along),
                 down = cpsi_cone_power(1 / (wide * g), power) * 0.5 * (x[0] - along),
                 across = cpsi_cone_power(1 / g, power);
    out[0] = up + down;
    for (int r = 1; r < dim; r++) {
        const double n = over * w[r];
        out[r] = (up - down) * n + across * (x[r] - along * n);
    }
}

#endif
