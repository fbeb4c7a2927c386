/* SPDX-License-Identifier: BSD-3-Clause */
/* The stiffness of lines at what moves, an end, a point or a body, while the free points to which
 * they lead follow (docs/theory.md 6c). */
#ifndef CAPSTAN_SRC_EVOLVE_FOLLOWING_H
#define CAPSTAN_SRC_EVOLVE_FOLLOWING_H

#include "capstan/stiffness.h"
#include "evolve/state.h"

/* What moves, by 3 displacements, or a body by 6 unknowns: an end of a line with the point at which
 * it is, of which the force on that line counts; a point, or a body, of which those on all lines
 * that end there do. */
typedef struct CpsiMoved {
    int line, end; /* line -1: all */
    int point;     /* or CPSI_NO_POINT */
    int body;      /* or -1 */
} CpsiMoved;

/* The derivative of the force on the lines by what moves: 3 x 3 numbers, of a body 6 x 6 with
 * moments and rotations about its reference point and the forces turning with it. The outcome and
 * `smooth` as in capstan/stiffness.h, of all lines that take part. */
typedef struct CpsiMovedStiffness {
    CpsStiffnessOutcome outcome;
    bool has_smooth;
    double matrix[36], smooth[36];
} CpsiMovedStiffness;

CpsiMovedStiffness cpsi_moved_stiffness(const CpsEvolution *evolution, const CpsiMoved *moved,
                                        CpsStiffnessKind kind);

/* The equation P K y + Q y = 0 of a point that follows by y, K y what the lines there lose, against
 * the step that its report is of; `size` [N/m]: of K. False where it is not known, or the point
 * does not follow: then it stays, Q = size. */
typedef struct CpsiFollowerRows {
    double p[3][3], q[3][3];
} CpsiFollowerRows;
bool cpsi_follower_rows(const CpsEvolution *evolution, bool is_static, int point, double size,
                        CpsiFollowerRows *out);

#endif
