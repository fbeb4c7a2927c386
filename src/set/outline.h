/* SPDX-License-Identifier: BSD-3-Clause */
/* The outline of a planar set, followed once round the normal angle (outline.c).
 *
 * x(theta) attains h(theta) = max <w, x>, w = (cos theta, sin theta). Over an interval of angles
 * the boundary is one of
 *     corner   x is the same point at both ends, and therefore between them
 *     edge     both ends lie on one line of support: one corner up to its angle, then the other
 *     arc      a polynomial predicts x
 *     short    none of these, although the interval is as short as the tolerance
 * Intervals are halved until they are one of the four. The set may be replaced by its image under
 * an affine map `turn`, in which a thin set is round; corners and edges remain corners and
 * edges. */
#ifndef CAPSTAN_SRC_SET_OUTLINE_H
#define CAPSTAN_SRC_SET_OUTLINE_H

#include "set/set.h"

typedef enum CpsiPieceKind { CPSI_PIECE_CORNER, CPSI_PIECE_ARC, CPSI_PIECE_SHORT } CpsiPieceKind;

typedef struct CpsiOutlinePiece {
    CpsiPieceKind kind;
    double from, to;   /* angles */
    double x[2], y[2]; /* at from, at to */
    /* corner: length of the path from x to y through points that were taken for one; short: bound
     * for the distance of the boundary from the chord */
    double drift;
} CpsiOutlinePiece;

/* The set in its plane: point = centre + basis' (two numbers), x = turn (the two numbers). */
typedef struct CpsiWalk {
    const CpsSet *set;
    const double *centre, *basis;
    double turn[4];
    double *w, *point;       /* (n) scratch */
    double size;             /* unit of length for tolerances */
    double opening;          /* smallest range of angles of a corner */
    int looks;               /* number of supports evaluated so far */
    CpsiOutlinePiece *piece; /* freed by the caller */
    int count, capacity;
    bool exact;
    double gap;
    CpsSetOutcome outcome;
    CpsStatus status;
    CpsError *err;
} CpsiWalk;

/* Number of supports after which the remaining intervals count as short: a point known only to the
 * square root of its gap is nowhere smooth. */
enum { CPSI_MOST_LOOKS = 50000 };

/* Prepare for a set of dimension `facts->dimension`; outcome UNBOUNDED or EMPTY where there is no
 * outline. The caller frees *scratch. */
CpsStatus cpsi_walk_start(const CpsSet *set, double tolerance, CpsiWalk *walk, CpsSetFacts *facts,
                          double **scratch, CpsError *err);
/* x(theta); returns h. */
double cpsi_walk_visit(CpsiWalk *walk, double theta, double x[2]);
/* All pieces, counterclockwise. */
void cpsi_walk_round(CpsiWalk *walk);

#endif
