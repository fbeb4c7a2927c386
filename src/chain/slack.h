/* SPDX-License-Identifier: BSD-3-Clause */
/* Elements of a solved program that have no tension. */
#ifndef CAPSTAN_SRC_CHAIN_SLACK_H
#define CAPSTAN_SRC_CHAIN_SLACK_H

#include <math.h>

#include "chain/elements.h"

/* Whether element i has no tension. Of tension and slack, whose product is 0 in a solution, the one
 * that is larger on its own scale counts; a tension that is the rounding of the unit of force is
 * none, also where the element is just as long as it may be. */
static inline bool cpsi_segment_is_slack(const CpsiSegment *segment, int i) {
    const double rounding = 1e-12, *s = segment->s[i], *z = segment->z[i];
    return z[0] < fmax(rounding, s[0] - sqrt(s[1] * s[1] + s[2] * s[2] + s[3] * s[3]));
}

#endif
