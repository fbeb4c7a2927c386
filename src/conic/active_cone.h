/* SPDX-License-Identifier: BSD-3-Clause */
/* How a cone binds a solution, and what Newton's method on the active constraints makes of it
 * (dense_polish.c, sparse_polish.c).
 *
 * Where the interior-point loop ends, s.z is rounding; s and z of a second-order cone are then
 * known to its root only. But how each cone is active is certain by then. The eigenvalues
 * x0 -+ |x1| of s and z are compared, small with large in pairs:
 *
 *     free   z is the smaller of both pairs      z = 0
 *     tip    s is the smaller of both pairs      s = 0,  z unknown
 *     ray    each is the smaller of one pair     s0 = |s1|,  z = l (1, -s1/|s1|),  l unknown
 *
 * A tip has its own dimension of equations and multipliers, a ray one of each, a free cone none. */
#ifndef CAPSTAN_SRC_CONIC_ACTIVE_CONE_H
#define CAPSTAN_SRC_CONIC_ACTIVE_CONE_H

#include <stdbool.h>
#include <stddef.h>

typedef enum CpsiActive { CPSI_FREE, CPSI_RAY, CPSI_TIP } CpsiActive;

/* Of a pair s, z (d). */
CpsiActive cpsi_active(const double *s, const double *z, int d);

/* What a cone is that Newton's steps have left: the side on which they did tells. */
CpsiActive cpsi_active_corrected(CpsiActive kind, const double *z, int d);

/* Equations, and multipliers. */
static inline int cpsi_active_count(CpsiActive kind, int d) {
    return kind == CPSI_FREE ? 0 : kind == CPSI_TIP ? d : 1;
}

/* z from its multipliers, which are its first entries, and s. Are both in the cone? */
bool cpsi_active_place(CpsiActive kind, const double *s, double *z, int d);

/* Minus the values of the equations. Returns how many. */
int cpsi_active_values(CpsiActive kind, const double *s, int d, double *out);

/* Their gradients, rows of n numbers `stride` apart: rows A of a tip, a0 - n'A1 of a ray; a (d, n).
 * Returns how many. */
int cpsi_active_gradients(CpsiActive kind, int n, const double *a, const double *s, int d,
                          size_t stride, double *out);

#endif
