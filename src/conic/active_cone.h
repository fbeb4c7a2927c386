/* SPDX-License-Identifier: BSD-3-Clause */
/* How a cone constrains a solution, and its equations for Newton's method on the active constraints
 * (dense_polish.c, sparse_polish.c).
 *
 * At the end of the interior-point loop s.z is rounding, so s and z of a second-order cone are
 * known only to the square root of rounding. How each cone is active is certain by then. The
 * eigenvalues x0 -+ |x1| of s and z are compared, small with large in pairs:
 *
 *     free   z is the smaller of both pairs      z = 0
 *     tip    s is the smaller of both pairs      s = 0,  z unknown
 *     ray    each is the smaller of one pair     s0 = |s1|,  z = l (1, -s1/|s1|),  l unknown
 *
 * A tip has as many equations and multipliers as its dimension, a ray one of each, a free cone
 * none. */
#ifndef CAPSTAN_SRC_CONIC_ACTIVE_CONE_H
#define CAPSTAN_SRC_CONIC_ACTIVE_CONE_H

#include <stdbool.h>
#include <stddef.h>

typedef enum CpsiActive { CPSI_FREE, CPSI_RAY, CPSI_TIP } CpsiActive;

/* The activity of a pair s, z (d). */
CpsiActive cpsi_active(const double *s, const double *z, int d);

/* The activity to assume for a cone that Newton's steps have left, from the side on which they left
 * it. */
CpsiActive cpsi_active_corrected(CpsiActive kind, const double *z, int d);

/* Number of equations, which is the number of multipliers. */
static inline int cpsi_active_count(CpsiActive kind, int d) {
    return kind == CPSI_FREE ? 0 : kind == CPSI_TIP ? d : 1;
}

/* Compute z from its multipliers, which are its first entries, and from s. Returns whether both are
 * in the cone. */
bool cpsi_active_place(CpsiActive kind, const double *s, double *z, int d);

/* Minus the values of the equations. Returns their number. */
int cpsi_active_values(CpsiActive kind, const double *s, int d, double *out);

/* Their gradients, rows of n numbers `stride` apart: rows A of a tip, a0 - n'A1 of a ray; a (d, n).
 * Returns their number. */
int cpsi_active_gradients(CpsiActive kind, int n, const double *a, const double *s, int d,
                          size_t stride, double *out);

#endif
