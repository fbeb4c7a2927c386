/* SPDX-License-Identifier: BSD-3-Clause */
/* A conic program as the interior-point loop sees it: unknowns, elements by kind, and a linear
 * system.
 *
 *     min  sum of the elements' energies - load.u
 *         over u, each element holding its own cones and private unknowns
 *
 * Iterate: every cone has an interior pair (s, z), s primal and z dual. The loop (ipm.c) knows
 * nothing else; a program of one shape (chain_program.h) supplies the kinds of its elements and the
 * linear system that fits them. Kinds work on arrays: one call per kind and pass, none per
 * element. */
#ifndef CAPSTAN_SRC_IPM_PROGRAM_H
#define CAPSTAN_SRC_IPM_PROGRAM_H

#include <stdbool.h>

#include "ipm/interrupt.h"

typedef struct CpsiProgram CpsiProgram;

/* What a pass over the elements of one kind adds up. Step lengths are kept as inverses: the largest
 * bounds the step. */
typedef struct CpsiSums {
    double inverse_step; /* 1/alpha of the nearest boundary */
    double weight;       /* sum of weights */
    double sz;           /* sum of w (s.z) */
    double residual;     /* largest |rho| */
    double scale;        /* sum w s0 z0 over the cones */
    double bound;        /* sum of w z0 of bounded cones: what a dual ray leaves out */
    double largest;      /* largest dual */
    double
        ray; /* minus what the duals, as a ray, ask of the primal: > 0 speaks for infeasibility */
    double
        ray_cost; /* sum of w c z0^2: > 0 where an element's quadratic energy grows with the ray */
} CpsiSums;

/* One kind of element. `keep` is the share of the residuals that a direction is to remove. */
typedef struct CpsiKind {
    /* a centred pair (s, z) near the iterate u, s o z = mu e, s about `margin` inside */
    void (*start)(CpsiProgram *program, double mu, double margin);
    /* add the elements' forces to program->residual; add up s.z and residuals */
    void (*measure)(CpsiProgram *program, CpsiSums *sums);
    /* scaling; add the condensed stiffness to the matrix; right-hand side q of the predictor, s o z
     * -> 0 */
    void (*scale)(CpsiProgram *program);
    /* add to du, the right-hand side, the forces that q and the residuals put on the unknowns */
    void (*load)(CpsiProgram *program, double keep);
    /* direction (ds, dz) from du; step to the boundary; a predictor may leave its second-order term
     * in q */
    void (*direct)(CpsiProgram *program, double keep, bool predictor, CpsiSums *sums);
    /* q of the corrector: s o z -> target e, less the second-order term of the predictor just
     * taken */
    void (*correct)(CpsiProgram *program, double target);
    /* q of a step to the centre, s o z -> target e, without a predictor; NULL where the loop is not
     * asked to centre */
    void (*centre)(CpsiProgram *program, double target);
    /* s += alpha ds, z += alpha dz */
    void (*advance)(CpsiProgram *program, double alpha);
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
    /* the largest residual of an unknown that is free to move */
    double (*imbalance)(const CpsiProgram *program);
    CpsiInterrupt *interrupt; /* looked at in each iteration; NULL: none */
};

#endif
