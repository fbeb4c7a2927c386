/* SPDX-License-Identifier: BSD-3-Clause */
/* The content of a CpsRegularized: the copied step, and the last solution with its cells. */
#ifndef CAPSTAN_SRC_REGULARIZED_HANDLE_H
#define CAPSTAN_SRC_REGULARIZED_HANDLE_H

#include "regularized/regularized.h"

struct CpsRegularized {
    CpsiStep step;
    CpsiArena arena; /* memory of the cells below */
    CpsiCells cells;
    int asked; /* number of cells as the caller asked for in the last solve, -1: none yet */
    CpsiRegularized f;
    double *unknown, *work, *tension;
};

/* [N] Reaction of the obstacle on the half element beside a held end of the last solution; 0 for an
 * end in the air. */
double cpsi_end_push(const CpsRegularized *regularized, int end);

/* [N] Tension of the last solution at an end, as in CpsEndReport. */
double cpsi_end_tension(const CpsRegularized *regularized, int end);

#endif
