/* SPDX-License-Identifier: BSD-3-Clause */
/* Inextensible lines that are too short to reach round an obstacle from one held end to the other,
 * or have an element that is too long for that. */
#ifndef CAPSTAN_SRC_CABLE_SHORTFALL_H
#define CAPSTAN_SRC_CABLE_SHORTFALL_H

#include "cable/line.h"
#include "cable/step_options.h"

typedef struct CpsiShortfall {
    int obstacle; /* the obstacle that it does not reach round; of several the worst */
    double
        missing; /* [m] > 0, of the length; or the depth in which an element stays beyond delta */
    Vec3 leaves; /* direction of the shortest path at end A; 0 0 0: an element is too long */
} CpsiShortfall;

/* Is there no configuration with the ends at line->end, from the line's position? Ends farther
 * apart than the line is long are not checked here (existence.c). An initial configuration by
 * statics may lie on any side and has the shortest of all paths; contact of the reference does not
 * keep a line out of obstacles. */
bool cpsi_line_falls_short(const CpsiLine *line, const CpsiStepOptions *options,
                           CpsiShortfall *out);

#endif
