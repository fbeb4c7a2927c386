/* SPDX-License-Identifier: BSD-3-Clause */
/* Where the line is slack in a solved step, and what can move there without changing the energy.
 *
 * A slack element carries no tension. A node between two of them is loose when its friction bound
 * is zero: it can be anywhere within its plane that its elements reach. The nodes that remain in
 * place divide a line into pieces. The interior nodes of a piece are loose, and so is its last or
 * first node where that is a free end. */
#ifndef CAPSTAN_SRC_SOLUTIONS_SLACK_H
#define CAPSTAN_SRC_SOLUTIONS_SLACK_H

#include "base/vec3.h"
#include "capstan/evolve.h"

/* An element whose stretch is less than this below 1 counts as stretched to its length [-]. */
#define CPSI_FULL 1e-9

/* Elements first..last, between the nodes first and last + 1. */
typedef struct CpsiSlackPiece {
    int first, last;
    bool slack;
    bool open[2];  /* its node first, or last + 1, is a free end that can move as well */
    bool grounded; /* its loose nodes lie on an obstacle, and remain in that plane */
    Vec3 normal;   /* normal of that plane, or any unit vector across the chord */
    /* [m] heights of the nodes first and last + 1 above the plane; 0 without one */
    double height[2];
    Vec3 foot[2]; /* their projections onto the plane */
} CpsiSlackPiece;

/* Unit of force for tolerances [N]: the largest tension, or all loads together. */
double cpsi_slack_force(const CpsLineView *step);

/* The piece that begins with an element; an element that is not slack is a piece by itself. */
CpsiSlackPiece cpsi_piece_at(const CpsLineView *step, int element, double force);

/* [m] Reach of element i of a piece within the plane. */
double cpsi_piece_reach(const CpsLineView *step, const CpsiSlackPiece *piece, int i);

/* Whether nodes of the piece can move with a solution as the result. They cannot where the piece is
 * straight, at its full length, between two nodes that remain in place. */
bool cpsi_piece_moves(const CpsLineView *step, const CpsiSlackPiece *piece);

/* |x'| of element i of a configuration. */
double cpsi_element_stretch(const CpsLineView *step, const double *position, int i);

#endif
