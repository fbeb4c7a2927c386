/* SPDX-License-Identifier: BSD-3-Clause */
/* The outline of a planar set, by going once round the normal angle (outline.c).
 *
 * x(theta) attains h(theta) = max <w, x>, w = (cos theta, sin theta). Over an interval of angles
 * the boundary is one of
 *     a corner   x at both ends is the same point, and then in between as well
 *     an edge    both ends lie on one line of support: a corner up to its angle and the other after
 *                it
 *     an arc     a polynomial foretells x
 *     short      none of these, however small the interval gets (a tolerance)
 * Intervals are halved until they are one of the four. The walk may see the set through an affine
 * map `turn`, in which a thin set is round: what is a corner or an edge does not depend on it. */
#ifndef CAPSTAN_SRC_SET_OUTLINE_H
#define CAPSTAN_SRC_SET_OUTLINE_H

#include "set/set.h"

typedef enum CpsiPieceKind { CPSI_PIECE_CORNER, CPSI_PIECE_ARC, CPSI_PIECE_SHORT } CpsiPieceKind;

typedef struct CpsiOutlinePiece {
    CpsiPieceKind kind;
    double from, to;   /* angles */
    double x[2], y[2]; /* at from, at to */
    double drift; /* corner: length of the way from x to y through what was taken for one point;
                   * short: how far the boundary is from the chord at most */
} CpsiOutlinePiece;

/* The set seen in its plane: point = center + basis' (two numbers), x = turn (the two numbers). */
typedef struct CpsiWalk {
    const CpsSet *set;
    const double *center, *basis;
    double turn[4];
    double *w, *point;       /* (n) scratch */
    double size;             /* what a length x is relative to */
    double opening;          /* least angle of a corner */
    int looks;               /* made so far */
    CpsiOutlinePiece *piece; /* the caller's to free */
    int count, room;
    bool exact;
    double gap;
    CpsSetOutcome outcome;
    CpsStatus status;
    CpsError *err;
} CpsiWalk;

/* Supports to be asked for before what is left counts as short: a point known to its gap's root
 * only is smooth nowhere. */
enum { CPSI_MOST_LOOKS = 50000 };

/* Ready to look at a set of dimension `facts->dimension`; outcome UNBOUNDED or EMPTY where there is
 * no outline. *room is the caller's to free. */
CpsStatus cpsi_walk_start(const CpsSet *set, double tolerance, CpsiWalk *walk, CpsSetFacts *facts,
                          double **room, CpsError *err);
/* x(theta); returns h. */
double cpsi_walk_visit(CpsiWalk *walk, double theta, double x[2]);
/* All pieces, counterclockwise. */
void cpsi_walk_round(CpsiWalk *walk);

#endif
