/* SPDX-License-Identifier: BSD-3-Clause */
/* Inextensible lines that are caught between a sphere and a plane that it dips into. */
#ifndef CAPSTAN_SRC_CABLE_CAUGHT_H
#define CAPSTAN_SRC_CABLE_CAUGHT_H

#include "cable/line.h"
#include "cable/step_options.h"

typedef struct CpsiCatch {
    int ball, plane; /* obstacles between which the line is caught */
    double missing;  /* [m] > 0, of its length where its ends are to be */
    Vec3 gate;       /* unit vector from the centre: the half-line that the line cannot cross */
} CpsiCatch;

/* Is there no motion of the line that takes its ends straight to their places at line->end, from
 * the line's position (docs/theory.md 5)? Ends farther apart than the line is long are another case
 * (existence.h), and so is a line too short for any way round (shortfall.h). */
bool cpsi_line_is_caught(const CpsiLine *line, const CpsiStepOptions *options, CpsiCatch *out);

#endif
