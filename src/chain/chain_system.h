/* SPDX-License-Identifier: BSD-3-Clause */
/* The contract of a linear system: one matrix over a chain of nodes, quasi-definite up to a
 * coupling inside each node.
 *
 * Unknowns: x_j in R^3 at the nodes j = 0..n-1, in the node's own axes Q_j, and one tension t_i for
 * each element i = 1..n-1 (element i joins node i-1 and node i; index 0 of element arrays is
 * unused). With d_i = Q_i^T x_i - Q_{i-1}^T x_{i-1}:
 *
 *     node j:       D_j x_j + Q_j (k_j d_j + m_j t_j - k_{j+1} d_{j+1} - m_{j+1} t_{j+1}) = f_j
 *         (terms beyond the ends absent)
 *     element i:    m_i . d_i - a_i t_i = h_i
 *     held node:    x_j = 0, its equation is dropped
 *
 * An element may have a point, at the share 0 < b_i < 1 of its length, in axes Q_{n+i} of its own.
 * It moves with the element, and its force acts on the nodes,
 *
 *     point i:      x_{n+i} = Q_{n+i} ((1 - b_i) Q_{i-1}^T x_{i-1} + b_i Q_i^T x_i),
 *         f_{n+i} - D_{n+i} x_{n+i} on the point,
 *                   (1 - b_i) of it on node i-1 and b_i on node i
 *
 * The third axis of a node is the one that may be stiffest, an obstacle's normal. D_j is symmetric
 * >= 0, plus `skew` in the column z of its rows x and y (friction coupled to the reaction), plus c
 * r^T/a of a `second` direction r that may be as stiff (the normal of another obstacle, a >= 0 its
 * compliance, c = r + the friction coupled to that reaction); k_i >= 0; a_i > 0, or a_i < 0 as long
 * as k_i I + m_i m_i^T/a_i >= 0 (an element softer along itself than across). Without skew,
 * eliminating the tensions would leave a positive definite matrix, so no pivot vanishes in the
 * orders used. Keeping the tension t_i as an unknown keeps stiff elements exact: a_i may be as
 * small as 0+ beside k_i of order one, where the condensed stiffness m m^T/a would swamp everything
 * else by rounding. D of a point, whose skew is 0 unless its xz and yz are, may be as stiff in any
 * direction: its force is an unknown of its own. */
#ifndef CAPSTAN_SRC_CHAIN_CHAIN_SYSTEM_H
#define CAPSTAN_SRC_CHAIN_CHAIN_SYSTEM_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"

/* The part c r^T/a of each D_j, stored separately because its 1/a may swamp all else by rounding;
 * f_j = r.x_j/a is an unknown of its own. */
typedef struct CpsiMatrixSecond {
    double *column;     /* (n, 3) c */
    double *row;        /* (n, 3) r; 0: there is none */
    double *compliance; /* (n) a */
} CpsiMatrixSecond;

static inline bool cpsi_second_is_set(const CpsiMatrixSecond *second, int j) {
    return second &&
           (second->row[3 * j] != 0 || second->row[3 * j + 1] != 0 || second->row[3 * j + 2] != 0);
}

/* The matrix; arrays belong to the caller. */
typedef struct CpsiMatrix {
    int n;                     /* nodes >= 1 */
    const unsigned char *held; /* (n) 1: x_j = 0 */
    double *diagonal;          /* (n, or 2 n with points, 6) D_j as xx, xy, yy, xz, yz, zz */
    double *skew;              /* (n, or 2 n, 2) added to D_j at xz and yz, not at zx and zy */
    double *stiffness;         /* (n) k_i */
    double *direction;         /* (n, 3) m_i, in the common axes */
    double *compliance;        /* (n) a_i */
    const double *frame; /* (n, or 2 n, 9) Q_j, its rows orthonormal (frame.h); NULL: the common
                            axes everywhere; not with points */
    const CpsiMatrixSecond *second; /* NULL: none */
    const double *share;            /* (n) b_i, 0 where element i has no point; NULL: none has */
} CpsiMatrix;

/* Has element i a point? */
static inline bool cpsi_point_is_set(const CpsiMatrix *matrix, int i) {
    return matrix->share && matrix->share[i] > 0;
}

typedef struct CpsiLinsys CpsiLinsys;

typedef struct CpsiLinsysOps {
    const char *name;
    /* Place the factor's storage for at most n nodes in the arena, with second directions and
     * points or without. From *scratch of the arena on it holds what `factor` writes and `solve`
     * reads: between the last solve and the next factor that memory may serve others. */
    CpsiLinsys *(*layout)(CpsiArena *arena, int n, bool second, bool points, size_t *scratch);
    /* Factorise; false when a pivot is not finite (the matrix holds NaN or infinities). */
    bool (*factor)(CpsiLinsys *self, const CpsiMatrix *matrix);
    /* Solve with the last factor. In: x = f (n, or 2 n, 3), t = h (n). Out: the solution; x = 0 at
     * held nodes, t[0] = 0; of a point to the accuracy in D x that rounding permits, 0 where there
     * is none; f (n) of the second directions, NULL where there are none. */
    void (*solve)(const CpsiLinsys *self, const CpsiMatrix *matrix, double *x, double *t,
                  double *f);
} CpsiLinsysOps;

extern const CpsiLinsysOps cpsi_linsys_chain; /* block tridiagonal, cost linear in n */
extern const CpsiLinsysOps
    cpsi_linsys_dense; /* all unknowns in one matrix, cost cubic: small n and tests */

#endif
