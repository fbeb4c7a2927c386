/* SPDX-License-Identifier: BSD-3-Clause */
/* A load step of one line, in as many parts as it needs. */
#ifndef CAPSTAN_SRC_EVOLVE_SUBSTEPS_H
#define CAPSTAN_SRC_EVOLVE_SUBSTEPS_H

#include "cable/line_step.h"

/* What a load step does to a line: each end from a value to another of the same kind, obstacles by
 * an angle. */
typedef struct CpsiMove {
    CpsEnd from[2], to[2];
    const double *angle;                 /* (obstacles) [rad] */
    double weight_from[3], weight_to[3]; /* [N/m] per natural length */
} CpsiMove;

/* Room for the start of a part, and for what one part reached in one go. */
typedef struct CpsiSubsteps {
    double *reaction;     /* (contacts, n) */
    double *tension;      /* (n) */
    unsigned char *state; /* (contacts, n) */
    int *on;              /* (contacts, n) */
    CpsEndReport end[2];
    double *position; /* (n, 3) */
    double *trial;    /* (n, 4), NULL where the path's accuracy is not asked for */
    double *turn;     /* (obstacles) what line->turn points to */
} CpsiSubsteps;

void cpsi_substeps_layout(CpsiSubsteps *scratch, CpsiArena *arena, int n, int contacts,
                          bool path_tolerance);

/* Take the step. The line's report is that of the whole: sums of what adds up, the worst outcome,
 * else that of the last part; the views are those of the last part.
 *
 *   known   the forces at the ends are those of an equilibrium (cpsi_ledger_start) */
void cpsi_line_substeps(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                        const CpsiMove *move, CpsiSubsteps *scratch, bool known);

/* Statics: the first equilibrium of a line that is laid, without friction, from the shape that it
 * is given. Where that is far from any, the line goes there as overdamped motion first. */
void cpsi_line_place_statically(CpsiLine *line, CpsiChainProgram *program,
                                const CpsiStepOptions *options, CpsiSubsteps *scratch);

#endif
