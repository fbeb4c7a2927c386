/* SPDX-License-Identifier: BSD-3-Clause */
/* One force shared among sets at least cost, as a conic program, which conjugate_sum.c solves
 * repeatedly.
 *
 *     min  sum of psi_i(t_i)    F_1 + F_2 + .. = F,   F_i in t_i C_i
 *
 * where the slope of each psi_i is piecewise linear between nodes of t, with jumps allowed: psi_i
 * is linear plus quadratic in the part of t that falls into each piece. The program is exact for
 * such psi. */
#ifndef CAPSTAN_SRC_LAW_INF_CONVOLUTION_H
#define CAPSTAN_SRC_LAW_INF_CONVOLUTION_H

#include "set/conic_form.h"

enum { CPSI_MOST_PIECES = 5 };

/* One psi and its set; t from node[0] to node[pieces] (which may be INFINITY, with one slope for
 * the last piece). */
typedef struct CpsiShare {
    const CpsiConicForm *form;
    double unit; /* > 0: order of magnitude of t */
    int pieces;
    double node[CPSI_MOST_PIECES + 1];
    double after[CPSI_MOST_PIECES],
        before[CPSI_MOST_PIECES]; /* slopes at the beginning and the end of each piece */
    double t;                     /* result */
    double *force;                /* result (n): F_i */
} CpsiShare;

/* Solve. energy > 0: the order of magnitude of the cost. velocity (n): minus the derivative of the
 * least cost by F. The outcome is ANSWERED where forces and velocity were found; the caller checks
 * their accuracy. OUTSIDE: no shares add up to F. */
CpsStatus cpsi_inf_convolution(int n, int count, CpsiShare *share, const double *force,
                               double energy, double *velocity, CpsSetOutcome *outcome,
                               CpsError *err);

#endif
