/* SPDX-License-Identifier: BSD-3-Clause */
/* Whether free bodies that lines connect are stable together, recomputed from a file. */
#ifndef CAPSTAN_CHECKER_BODIES_TOGETHER_H
#define CAPSTAN_CHECKER_BODIES_TOGETHER_H

#include "body_stiffness.h"

/* Of a matrix (n, n), symmetric, per its largest entry: are all pivots positive, 1, or is one
 * negative, -1; 0: one is too small to say. It is overwritten. */
int pivots_of(Real *m, size_t n);

/* `sign` (bodies) of each body by itself, in that sense, the others staying: set to that of it
 * together with all that are positive among those to which lines lead from it, also by way of free
 * points and bodies; -1 of all of them where one of their motions is not held. 0: not known. */
void bodies_together(const StiffnessStep *step, const BodyState *all, const Junction *point,
                     const double *arm, int *sign);

#endif
