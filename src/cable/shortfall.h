/* SPDX-License-Identifier: BSD-3-Clause */
/* Inextensible lines that are too short to reach round an obstacle from one held end to the
 * other. */
#ifndef CAPSTAN_SRC_CABLE_SHORTFALL_H
#define CAPSTAN_SRC_CABLE_SHORTFALL_H

#include "cable/line.h"
#include "cable/step_options.h"

typedef struct CpsiShortfall {
    int obstacle;   /* that it does not reach round: of several the worst */
    double missing; /* [m] > 0 */
    Vec3 leaves;    /* the direction in which the shortest way leaves end A */
} CpsiShortfall;

/* Is there no configuration with the ends at line->end, from the line's position?  Ends so far
 * apart that the straight way is too long are not looked at. A start laid by statics comes from no
 * side and has the shortest of all ways; strict contact keeps a line out of nothing. */
bool cpsi_line_falls_short(const CpsiLine *line, const CpsiStepOptions *options,
                           CpsiShortfall *out);

#endif
