/* SPDX-License-Identifier: BSD-3-Clause */
/* The minimum of a convex function with a continuous gradient and a band Hessian, by damped Newton
 * steps.
 *
 * Along a descent direction the slope of a convex function only rises, so a step is judged by
 * slopes alone: it is long enough and not too long where the slope has come down to a tenth.
 * Energies, whose differences drown in rounding near the minimum, are never compared. Where the
 * Hessian jumps (|x'| = 1, a node touching) the direction is that of one of its limits; the
 * function asked for keeps it definite by `damping`, which grows while steps have to be cut. */
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
    double damping_unit; /* what makes damping comparable with the Hessian's own terms */
} CpsiSmooth;

typedef struct CpsiNewton {
    /* in */
    double tolerance; /* done when no component of the gradient exceeds it */
    int max_iterations;
    /* out */
    bool converged;
    int iterations, evaluations; /* factorisations and gradients */
    double residual;             /* largest component of the gradient, NaN never */
} CpsiNewton;

/* Improve x (unknowns) until converged, the iteration limit, or no direction leads down any more.
 *   work   4*unknowns + unknowns*(band + 1) numbers
 * x always ends at a point with a finite gradient, not worse along each line searched than where it
 * began. */
void cpsi_newton_minimise(const CpsiSmooth *f, double *x, CpsiNewton *newton, double *work);

#endif
