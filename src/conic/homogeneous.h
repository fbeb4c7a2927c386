/* SPDX-License-Identifier: BSD-3-Clause */
/* A conic program in homogeneous self-dual form (Ye, Todd and Mizuno 1994), for the loop of
 * ipm.h:
 *
 *     min c.x   s.t.  E x + h = 0,  A x + b in K
 *
 * with K a product of half-lines (dimension 1) and second-order cones. The form has an interior
 * starting point and ends in a solution or in a proof that there is none. With multipliers y of the
 * equations and tau, kappa >= 0:
 *
 *     s = A x + b tau in K,   z in K,         E x + h tau = 0,
 *     A'z + E'y = c tau,                      kappa = - c.x - b.z - h.y.
 *
 * Where tau > 0 in the limit, x/tau, y/tau, z/tau are a solution. Where tau = 0, b.z + h.y < 0
 * proves that nothing is feasible, and c.x < 0 that the objective decreases without bound. A and E
 * are known only to an operator, which the dense and the sparse program supply. Data should be of
 * order one. */
#ifndef CAPSTAN_SRC_CONIC_HOMOGENEOUS_H
#define CAPSTAN_SRC_CONIC_HOMOGENEOUS_H

#include "base/arena.h"
#include "ipm/cones.h"
#include "ipm/program.h"

typedef enum CpsiConicOutcome {
    CPSI_CONIC_SOLVED,
    CPSI_CONIC_INFEASIBLE, /* y, z: A'z + E'y = 0, z in K, b.z + h.y = -1 */
    CPSI_CONIC_UNBOUNDED,  /* x: A x in K, E x = 0, c.x = -1 */
    CPSI_CONIC_FAILED      /* the residuals remained above what the caller accepts */
} CpsiConicOutcome;

/* The result. x, y, s, z are divided by the number that normalises the outcome, and are stored in
 * the program's arrays. */
typedef struct CpsiConicResult {
    CpsiConicOutcome outcome;
    int iterations;
    double gap;      /* s.z of the solution; of a sparse program in units of 1 + |c.x| */
    double residual; /* largest |A x + b - s|, |E x + h| and |A'z + E'y - c| */
    const double *x, *y, *s, *z;
} CpsiConicResult;

typedef struct CpsiHomogeneous CpsiHomogeneous;

/* The operations of a program with A, b, E and h. Vectors u and du are (x, y, tau). */
typedef struct CpsiConicOperator {
    /* out (rows) = A x + b tau + factor v */
    void (*multiply)(const CpsiHomogeneous *program, const double *u, double factor,
                     const double *v, double *out);
    /* At the iterate, into base.residual: A'z + E'y, E x, and gain + pull + kappa in the places of
     * x, y, tau. Each program adds in its own order, on which its last digits depend. */
    void (*multiply_transposed)(CpsiHomogeneous *program, double gain, double pull);
    /* b.z + h.y */
    double (*offset)(const CpsiHomogeneous *program, const double *y, const double *z);
    /* A~ = sqrt(g) W^-1 A and b~ at the scaling of the cones */
    void (*scale)(CpsiHomogeneous *program);
    /* The linear system of a direction (dx, dy, dtau, w), w = W dz/sqrt(g): its factorisation, and
     * its solution, which replaces du. */
    bool (*factor)(CpsiProgram *base);
    void (*solve)(CpsiProgram *base);
    /* whether an iterate whose s.z is negative by rounding may be the best */
    bool keeps_negative_gaps;
} CpsiConicOperator;

struct CpsiHomogeneous {
    CpsiProgram base; /* u = (x, y, tau); du = (dx, dy, dtau, w) */
    const CpsiConicOperator *operator;
    int unknowns, equations;
    const double *c, *h; /* (unknowns), (equations) belong to the program */
    const double *b;     /* (rows) belongs to the program */
    CpsiCones cones;
    double kappa, d_tau, d_kappa, q_tau;
    /* (size of u + 2 rows) u, s, z of the best iterate, since late steps may only add rounding */
    double *best;
    double best_kappa;     /* and its kappa */
    CpsiConicResult found; /* outcome and residuals of the best iterate */
};

/* Place the arrays of a program of this size in the arena; c, h, b and cones.dim are set later. */
void cpsi_homogeneous_layout(CpsiHomogeneous *program, CpsiArena *arena,
                             const CpsiConicOperator *operator, int unknowns, int equations,
                             int rows, int cones, int largest_cone);

/* To be called before the loop runs, once or several times: there is no best iterate yet. */
void cpsi_homogeneous_begin(CpsiHomogeneous *program);

/* To be called after the loop: the best iterate, divided by what normalises its outcome, in base.u
 * and cones. */
CpsiConicResult cpsi_homogeneous_result(CpsiHomogeneous *program);

/* To be called before the loop goes on: the best iterate itself becomes the present one. */
void cpsi_homogeneous_return(CpsiHomogeneous *program);

static inline int cpsi_homogeneous_tau(const CpsiHomogeneous *program) {
    return program->unknowns + program->equations;
}

#endif
