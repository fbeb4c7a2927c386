/* SPDX-License-Identifier: BSD-3-Clause */
/* What a CpsRegularized holds: the step copied, and the last solve on some cells. */
#ifndef CAPSTAN_SRC_REGULARIZED_HANDLE_H
#define CAPSTAN_SRC_REGULARIZED_HANDLE_H

#include "regularized/regularized.h"

struct CpsRegularized {
    CpsiStep step;
    CpsiArena arena; /* of the cells below */
    CpsiCells cells;
    int asked; /* cells of the last solve as asked for, -1: none yet */
    CpsiRegularized f;
    double *unknown, *work, *tension;
};

/* [N] What the obstacle pushes on the half element beside a held end of the last solution; 0 for
 * one that is in the air. */
double cpsi_end_push(const CpsRegularized *classic, int end);

#endif
