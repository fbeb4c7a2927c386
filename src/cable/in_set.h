/* SPDX-License-Identifier: BSD-3-Clause */
/* An end of a line that is held to a convex set; what is done with it is in end_set.h. */
#ifndef CAPSTAN_SRC_CABLE_IN_SET_H
#define CAPSTAN_SRC_CABLE_IN_SET_H

#include <stdbool.h>

#include "geometry/place_set.h"

typedef struct CpsiEndSet {
    bool is_there;
    CpsiPlaceSet set;
    double reaction[3]; /* [N] on the end, in the axes of the set */
} CpsiEndSet;

#endif
