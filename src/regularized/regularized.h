/* SPDX-License-Identifier: BSD-3-Clause */
/* The functional of S90 section 5 on cells, which P5.5 makes stationary, with its gradient and
 * Hessian.
 *
 *    I(y) = sum w_i (K/2) ((|u_i| - 1)^+)^2  -  sum b_j.y_j
 *           + sum A_j sqrt(delta^2 + |(y_j - x_R,j)_T|^2)
 *           + (1/2n) sum g_i |u_i - u_(i-1)|^2
 *           + (lambda/2) sum h_j ((n.(y_j - x_R,j) + gap_j)^-)^2
 *
 * with slopes u_i = (y_i - y_(i-1))/w_i, u_0 = 0, and y_0 held. It is convex; with 1/n > 0 strictly
 * so. The tension is the relaxed one, (45), as in (46). */
#ifndef CAPSTAN_SRC_REGULARIZED_REGULARIZED_H
#define CAPSTAN_SRC_REGULARIZED_REGULARIZED_H

#include "capstan/regularized.h"
#include "regularized/newton.h"
#include "regularized/step_data.h"

typedef struct CpsiRegularized {
    const CpsiStep *step;
    const CpsiCells *cells;
    CpsRegularizedParameters parameters;
    int unknowns;     /* 3 per place that is free: 1..m, or 1..m-1 where end B is held */
    double *place;    /* (m + 1, 3) positions set by the last call */
    double *gradient; /* (m + 1, 3) of I there */
} CpsiRegularized;

/* Half bandwidth: bending couples a place to the next and the next but one. */
enum { CPSI_REGULARIZED_BAND = 8 };

/* Its gradient and Hessian for newton.h, `user` being the CpsiRegularized. */
CpsiSmooth cpsi_regularized_smooth(CpsiRegularized *f);

/* Largest gradient that rounding causes where it should be 0, or 1e-10 of the step's forces if that
 * is larger [N]. */
double cpsi_regularized_limit(const CpsiRegularized *f);

/* Set the places from the unknowns; tension (45) of a cell there. */
void cpsi_regularized_store(CpsiRegularized *f, const double *x);
double cpsi_regularized_tension(const CpsiRegularized *f, int cell);

/* Energies, errors and residuals of the report at the present places. */
void cpsi_regularized_measure(const CpsiRegularized *f, CpsRegularizedReport *report);

#endif
