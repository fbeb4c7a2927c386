/* SPDX-License-Identifier: BSD-3-Clause */
/* What the elimination of a chain from both ends (block_tridiagonal.c) leaves to its solves
 * (chain_solve.c), and in which order both go along the chain. */
#ifndef CAPSTAN_SRC_CHAIN_CHAIN_FACTOR_H
#define CAPSTAN_SRC_CHAIN_CHAIN_FACTOR_H

#include "chain/chain_point.h"
#include "chain/chain_system.h"
#include "chain/halves.h"
#include "chain/residual.h"

/* The factor of one node of each half. */
typedef struct CpsiChainBlock {
    CpsiHalves c[9];  /* C_j, row by row */
    CpsiHalves y[3];  /* y/beta */
    CpsiHalves yt[3]; /* y'/beta */
    CpsiHalves tt;    /* 1/beta */
} CpsiChainBlock;

/* Of a second direction: f = w.(force on the node - v t) + corner g, and x gains column g, where
 * r.x - a f = g. */
typedef struct CpsiChainSecond {
    double w[3], v[3], column[3], corner;
    double pull; /* v'.column */
} CpsiChainSecond;

/* Of the element between the middle node and the half that begins with the last one: v, v' and
 * 1/beta. */
typedef struct CpsiChainJoint {
    double v[3], vt[3], tt;
} CpsiChainJoint;

typedef struct CpsiChainFactor {
    CpsiChainJoint joint;
    CpsiChainBlock *block;   /* (n/2 + 1, or n with points) by the number of nodes before it */
    CpsiChainSecond *second; /* (n) or NULL */
    CpsiChainPoint *point;   /* (n) or NULL */
    CpsiUnknowns scratch[2]; /* of a solve with points */
} CpsiChainFactor;

/* The middle node, and how many nodes the half behind it has; the half before it has as many or one
 * more. */
static inline int cpsi_chain_middle(const CpsiMatrix *a) { return a->share ? a->n - 1 : a->n / 2; }

static inline int cpsi_chain_behind(const CpsiMatrix *a) { return a->n - 1 - cpsi_chain_middle(a); }

/* Two places in the chain: a node, the node before it in the order of elimination, and the element
 * between with the sign of its direction. The half to which the place belongs is that in which
 * `passed` nodes come before it. */
typedef struct CpsiPlaces {
    int passed, half[2], node[2], before[2], element[2];
    CpsiHalves sign;
} CpsiPlaces;

/* The next node of each half or, with `both` false, that of the first half twice. */
CPSI_HALVES_FUNCTION CpsiPlaces cpsi_chain_next(const CpsiMatrix *a, int passed, const bool both) {
    const int j = both ? a->n - 1 - passed : passed;
    return (CpsiPlaces){.passed = passed,
                        .half = {0, both},
                        .node = {passed, j},
                        .before = {passed - 1, both ? j + 1 : j - 1},
                        .element = {passed, both ? j + 1 : j},
                        .sign = {1, both ? -1 : 1}};
}

/* The middle node as the next one of the last half, twice. */
CPSI_HALVES_FUNCTION CpsiPlaces cpsi_chain_joint_places(const CpsiMatrix *a) {
    const int middle = cpsi_chain_middle(a), j = middle + 1;
    return (CpsiPlaces){.passed = cpsi_chain_behind(a),
                        .half = {1, 1},
                        .node = {middle, middle},
                        .before = {j, j},
                        .element = {j, j},
                        .sign = {-1, -1}};
}

static inline bool cpsi_chain_has_second(const CpsiMatrix *a, int j) {
    return cpsi_second_is_set(a->second, j) && !a->held[j];
}

/* Neither axes of its own, second directions nor points: the loops are compiled for such a matrix
 * as well, without branches. */
static inline bool cpsi_chain_is_plain(const CpsiMatrix *a) {
    return !a->frame && !a->second && !a->share;
}

/* Forward elimination and back substitution (CpsiPass). */
void cpsi_chain_pass(const CpsiLinsys *self, const CpsiMatrix *a, const CpsiUnknowns *of);

#endif
