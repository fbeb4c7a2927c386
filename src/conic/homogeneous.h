/* SPDX-License-Identifier: BSD-3-Clause */
/* A conic program in homogeneous self-dual form (Ye, Todd and Mizuno 1994), for the loop of ipm.h:
 *
 *     min c.x   s.t.  E x + h = 0,  A x + b in K
 *
 * with K a product of half-lines (dimension 1) and second-order cones. The form has an interior
 * start and ends in a solution or in a proof that there is none. With multipliers y of the
 * equations and tau, kappa >= 0:
 *
 *     s = A x + b tau in K,   z in K,         E x + h tau = 0,
 *     A'z + E'y = c tau,                      kappa = - c.x - b.z - h.y.
 *
 * tau > 0 in the limit: x/tau, y/tau, z/tau solve. tau = 0: b.z + h.y < 0 proves that nothing is
 * feasible, c.x < 0 that the objective falls without end. A and E are known to an operator only,
 * which the dense and the sparse program supply. Data should be of order one. */
#ifndef CAPSTAN_SRC_CONIC_HOMOGENEOUS_H
#define CAPSTAN_SRC_CONIC_HOMOGENEOUS_H

#include "base/arena.h"
#include "ipm/cones.h"
#include "ipm/program.h"

typedef enum CpsiConicOutcome {
    CPSI_CONIC_SOLVED,
    CPSI_CONIC_INFEASIBLE, /* y, z: A'z + E'y = 0, z in K, b.z + h.y = -1 */
    CPSI_CONIC_UNBOUNDED,  /* x: A x in K, E x = 0, c.x = -1 */
    CPSI_CONIC_FAILED      /* the residuals stayed above what the caller would accept */
} CpsiConicOutcome;

/* What came out; x, y, s, z are divided by what normalises the outcome and lie in the program's
 * arrays. */
typedef struct CpsiConicResult {
    CpsiConicOutcome outcome;
    int iterations;
    double gap;      /* s.z of the solution */
    double residual; /* largest |A x + b - s|, |E x + h| and |A'z + E'y - c| */
    const double *x, *y, *s, *z;
} CpsiConicResult;

typedef struct CpsiHomogeneous CpsiHomogeneous;

/* What a program knows of A, b, E and h. Vectors u and du are (x, y, tau). */
typedef struct CpsiConicOperator {
    /* out (rows) = A x + b tau + factor v */
    void (*multiply)(const CpsiHomogeneous *program, const double *u, double factor,
                     const double *v, double *out);
    /* at the iterate, into base.residual: A'z + E'y, E x, and gain + pull + kappa in the places of
     * x, y, tau; each program adds them up in an order of its own, which its last digits follow */
    void (*multiply_transposed)(CpsiHomogeneous *program, double gain, double pull);
    /* b.z + h.y */
    double (*offset)(const CpsiHomogeneous *program, const double *y, const double *z);
    /* A~ = sqrt(g) W^-1 A and b~ at the scaling of the cones */
    void (*scale)(CpsiHomogeneous *program);
    /* the system of a direction (dx, dy, dtau, w), w = W dz/sqrt(g): its factor, and its solution
     * in place of du */
    bool (*factor)(CpsiProgram *base);
    void (*solve)(CpsiProgram *base);
    bool keeps_negative_gaps; /* an iterate whose s.z is below 0 by rounding may be the best */
} CpsiConicOperator;

struct CpsiHomogeneous {
    CpsiProgram base; /* u = (x, y, tau); du = (dx, dy, dtau, w) */
    const CpsiConicOperator *operator;
    int unknowns, equations;
    const double *c, *h; /* (unknowns), (equations) the owner's */
    const double *b;     /* (rows) the owner's */
    CpsiCones cones;
    double kappa, d_kappa, q_tau;
    /* (size of u + 2 rows) u, s, z of the best iterate, as late steps may only add rounding */
    double *best;
    CpsiConicResult found; /* its judgement */
};

/* Place the arrays of a program of this size in the arena; c, h, b and cones.dim are set later. */
void cpsi_homogeneous_layout(CpsiHomogeneous *program, CpsiArena *arena,
                             const CpsiConicOperator *operator, int unknowns, int equations,
                             int rows, int cones, int largest_cone);

/* Before the loop runs, once or several times: no iterate is the best so far. */
void cpsi_homogeneous_begin(CpsiHomogeneous *program);

/* After it: the best iterate divided by what normalises its outcome, in base.u and cones. */
CpsiConicResult cpsi_homogeneous_result(CpsiHomogeneous *program);

static inline int cpsi_homogeneous_tau(const CpsiHomogeneous *program) {
    return program->unknowns + program->equations;
}

#endif
