/* SPDX-License-Identifier: BSD-3-Clause */
/* Where a solved step leaves its line slack, and what may move there without changing the energy.
 *
 * A slack element carries no tension. A node between two of them is loose when it bears no friction
 * bound: it may go anywhere within its plane that its elements reach. Between the nodes that stay a
 * line falls into pieces; the interior nodes of a piece are loose, and so is its last or first node
 * where that is a free end. */
#ifndef CAPSTAN_SRC_SOLUTIONS_SLACK_H
#define CAPSTAN_SRC_SOLUTIONS_SLACK_H

#include "base/vec3.h"
#include "capstan/solutions.h"

/* An element closer to its length than this is at its length [-]. */
#define CPSI_FULL 1e-9

/* Elements first..last, between the nodes first and last + 1. */
typedef struct CpsiPiece {
    int first, last;
    bool slack;
    bool open[2];     /* its node first, last + 1 is a free end that may move as well */
    bool grounded;    /* its loose nodes lie on an obstacle: they keep to that plane */
    Vec3 normal;      /* of that plane, or any unit vector across the chord */
    double height[2]; /* [m] of the nodes first and last + 1 above the plane; 0 without one */
    Vec3 foot[2];     /* their feet on the plane */
} CpsiPiece;

/* What forces are compared with [N]: the largest tension, or all loads together. */
double cpsi_slack_force(const CpsLineView *step);

/* The piece that begins with an element; one that is not slack is a piece by itself. */
CpsiPiece cpsi_piece_at(const CpsLineView *step, int element, double force);

/* [m] Of element i of a piece, what its length reaches within the plane. */
double cpsi_piece_reach(const CpsLineView *step, const CpsiPiece *piece, int i);

/* May nodes of the piece move and leave a solution? Where it is straight at its length between two
 * nodes that stay they may not. */
bool cpsi_piece_moves(const CpsLineView *step, const CpsiPiece *piece);

/* |x'| of element i of a configuration. */
double cpsi_element_stretch(const CpsLineView *step, const double *position, int i);

#endif
