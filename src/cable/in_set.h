/* SPDX-License-Identifier: BSD-3-Clause */
/* An end of a line that is held to a convex set; what is done with it is in end_set.h. */
#ifndef CAPSTAN_SRC_CABLE_IN_SET_H
#define CAPSTAN_SRC_CABLE_IN_SET_H

#include <stdbool.h>

#include "geometry/place_set.h"

struct CpsiPlaceForm;

typedef struct CpsiEndSet {
    bool is_there;
    CpsiPlaceSet set;           /* of a set that is given by an expression the axes alone */
    struct CpsiPlaceForm *form; /* of such a set (place_form.h); else NULL */
    double reaction[3];         /* [N] on the end, in the axes of the set */
} CpsiEndSet;

#endif
