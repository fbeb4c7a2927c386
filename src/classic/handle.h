/* SPDX-License-Identifier: BSD-3-Clause */
/* What a CpsClassic holds: the step copied, and the last solve on some cells. */
#ifndef CAPSTAN_SRC_CLASSIC_HANDLE_H
#define CAPSTAN_SRC_CLASSIC_HANDLE_H

#include "classic/regularized.h"

struct CpsClassic {
    CpsiStep step;
    CpsiArena arena; /* of the cells below */
    CpsiCells cells;
    int asked; /* cells of the last solve as asked for, -1: none yet */
    CpsiRegularized f;
    double *unknown, *work, *tension;
};

#endif
