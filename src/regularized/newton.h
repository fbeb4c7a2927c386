/* SPDX-License-Identifier: BSD-3-Clause */
/* The minimum of a convex function with a continuous gradient and a band Hessian, by damped Newton
 * steps.
 *
 * Along a descent direction the slope of a convex function is nondecreasing, so the line search
 * uses slopes only: a step is accepted where the slope has decreased to a tenth. Values of the
 * function are never compared, because near the minimum their differences are lost in rounding.
 * Where the Hessian is discontinuous (|x'| = 1, a node coming into contact) one of its limits is
 * used; the function that computes it keeps it positive definite with `damping`, which is increased
 * while steps have to be shortened. */
#ifndef CAPSTAN_SRC_REGULARIZED_NEWTON_H
#define CAPSTAN_SRC_REGULARIZED_NEWTON_H

#include <stdbool.h>

typedef struct CpsiSmooth {
    int unknowns, band;
    void *user; /* handed to both functions */
    /* g = gradient at x; x and g (unknowns) */
    void (*gradient)(void *user, const double *x, double *g);
    /* a = Hessian at x as a band matrix (zeroed before); damping >= 0 in units of `damping_unit` */
    void (*hessian)(void *user, const double *x, double damping, double *a);
    double damping_unit; /* unit of the damping, comparable with the Hessian's entries */
} CpsiSmooth;

typedef struct CpsiDampedNewton {
    /* in */
    double tolerance; /* converged when no component of the gradient is larger */
    int max_iterations;
    /* out */
    bool converged;
    int iterations, evaluations; /* factorisations and gradients */
    double residual;             /* largest component of the gradient, never NaN */
} CpsiDampedNewton;

/* Improve x (unknowns) until it has converged and has taken one step more, the iteration limit is
 * reached, or no direction of descent is found. work   4*unknowns + unknowns*(band + 1) numbers On
 * return x is a point with a finite gradient. It is no worse along each searched line than the
 * point where that search began. */
void cpsi_newton_minimise(const CpsiSmooth *f, double *x, CpsiDampedNewton *newton, double *work);

#endif
