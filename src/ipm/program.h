/* SPDX-License-Identifier: BSD-3-Clause */
/* A conic program as the interior-point loop sees it: unknowns, elements by kind, and a linear
 * system.
 *
 *     min  sum of the elements' energies - load.u
 *         over u, each element holding its own cones and private unknowns
 *
 * In an iterate every cone has an interior pair (s, z), s primal and z dual. The loop (ipm.c) knows
 * nothing else; a program for one structure (chain_program.h) supplies the kinds of its elements
 * and the linear system that fits them. Kinds work on arrays: there is one call per kind and pass,
 * none per element. */
#ifndef CAPSTAN_SRC_IPM_PROGRAM_H
#define CAPSTAN_SRC_IPM_PROGRAM_H

#include <stdbool.h>

#include "ipm/interrupt.h"

typedef struct CpsiProgram CpsiProgram;

/* Sums of a pass over the elements of one kind. Step lengths are stored as inverses, the largest of
 * which limits the step. */
typedef struct CpsiSums {
    double inverse_step; /* 1/alpha of the nearest boundary */
    double weight;       /* sum of weights */
    double sz;           /* sum of w (s.z) */
    double residual;     /* largest |rho| */
    double scale;        /* sum w s0 z0 over the cones */
    /* sum of w z0 of cones with bounds, which the test of a dual ray neglects */
    double bound;
    double largest; /* largest dual */
    double
        /* minus the work of the duals, as a ray, on the primal data: > 0 indicates infeasibility */
        ray;
    /* u'K u and the sum of |K u| over what resists any motion with the stiffness K */
    double curved, pulled;
    double
        ray_cost; /* sum of w c z0^2: > 0 where an element's quadratic energy grows with the ray */
} CpsiSums;

/* What a direction aims at: q, the right-hand side of the linearised complementarity. */
typedef enum CpsiIpmAimKind {
    CPSI_IPM_AIM_PREDICT, /* s o z -> 0 */
    CPSI_IPM_AIM_CORRECT, /* s o z -> target e, less the second-order term of the predictor before
                           */
    CPSI_IPM_AIM_CENTRE,  /* s o z -> target e, without one */
    CPSI_IPM_AIM_GIVEN    /* q as it stands */
} CpsiIpmAimKind;

typedef struct CpsiIpmAim {
    CpsiIpmAimKind kind;
    double target; /* of CPSI_IPM_AIM_CORRECT and CPSI_IPM_AIM_CENTRE */
    double keep;   /* the share of the residuals that the direction is to remove */
} CpsiIpmAim;

/* One kind of element. A pass in which a kind has nothing to do is NULL. */
typedef struct CpsiKind {
    /* a centred pair (s, z) near the iterate u, with s o z = mu e and s at a distance of about
     * `margin` from the boundary */
    void (*start)(CpsiProgram *program, double mu, double margin);
    /* s += alpha ds, z += alpha dz, unless alpha is 0, when there may be no direction; then add the
     * elements' forces to program->residual, and add up s.z and residuals */
    void (*measure)(CpsiProgram *program, double alpha, CpsiSums *sums);
    /* the scaling; adds the condensed stiffness to the matrix */
    void (*scale)(CpsiProgram *program);
    /* q of the aim; add to du, the right-hand side, the forces of q and of the residuals on the
     * unknowns */
    void (*load)(CpsiProgram *program, const CpsiIpmAim *aim);
    /* direction (ds, dz) of this aim from du; step to the boundary; a predictor may store its
     * second-order term in q */
    void (*direct)(CpsiProgram *program, const CpsiIpmAim *aim, CpsiSums *sums);
} CpsiKind;

struct CpsiProgram {
    int size;         /* unknowns */
    double *load;     /* (size) */
    double *u;        /* (size) the iterate */
    double *du;       /* (size) right-hand side, then direction */
    double *residual; /* (size) imbalance of forces */
    int kind_count;
    const CpsiKind *const *kind; /* (kind_count) */
    /* the linear system: clear its matrix before `scale`; factorise after it; solve for du in
     * place */
    void (*clear)(CpsiProgram *program);
    bool (*factor)(CpsiProgram *program);
    void (*solve)(CpsiProgram *program);
    /* the largest residual of an unknown that is not held */
    double (*imbalance)(const CpsiProgram *program);
    CpsiInterrupt *interrupt; /* checked in each iteration; NULL: none */
};

#endif
