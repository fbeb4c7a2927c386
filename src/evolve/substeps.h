/* SPDX-License-Identifier: BSD-3-Clause */
/* A load step of one line, in as many substeps (parts) as it needs. */
#ifndef CAPSTAN_SRC_EVOLVE_SUBSTEPS_H
#define CAPSTAN_SRC_EVOLVE_SUBSTEPS_H

#include "evolve/move.h"

/* Scratch memory for the state at the start of a part, and for the result of a part taken whole. */
typedef struct CpsiSubsteps {
    double *reaction;     /* (contacts, n) */
    double *normal;       /* (contacts, n, 3) with which shifted obstacles push as a part begins */
    double *tension;      /* (n) */
    unsigned char *state; /* (contacts, n) */
    int *obstacle_index;  /* (contacts, n) */
    CpsEndReport end[2];
    CpsGrasp grasp[CPS_MAX_GRASPS];
    double stored[2];       /* [m] on the drums of winches */
    double *position;       /* (n, 3) */
    double *trial;          /* (n, 4), NULL without a path tolerance */
    CpsiObstacle *obstacle; /* (obstacles) where they are at the end of a part */
} CpsiSubsteps;

void cpsi_substeps_layout(CpsiSubsteps *scratch, CpsiArena *arena, int n, int contacts,
                          bool own_axes, bool path_tolerance);

/* Take the step. The line's report is that of the whole step: sums of additive quantities, the
 * worst outcome, else the values of the last part; the fields are those of the last part.
 *
 *   known   the forces at the ends are those of an equilibrium (cpsi_ledger_start) */
void cpsi_line_substeps(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                        const CpsiMove *move, CpsiSubsteps *scratch, bool known);

/* Impose the part of the move from share `from` to share `to`. */
void cpsi_substeps_impose(CpsiLine *line, const CpsiMove *move, CpsiSubsteps *scratch, double from,
                          double to);

/* Save the state at the start of a part, and return to it. */
void cpsi_substeps_save(const CpsiLine *line, CpsiSubsteps *scratch);
void cpsi_substeps_restore(CpsiLine *line, const CpsiSubsteps *scratch);

#endif
