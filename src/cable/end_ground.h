/* SPDX-License-Identifier: BSD-3-Clause */
/* The ground under the point at which a line ends. Such an end has no contact of its own: the point
 * bears what obstacles do to the half element beside it (line.h), and a part of that rests on the
 * ground as the rest of the line does. */
#ifndef CAPSTAN_SRC_CABLE_END_GROUND_H
#define CAPSTAN_SRC_CABLE_END_GROUND_H

#include "geometry/obstacle.h"

typedef struct CpsiEndGround {
    const CpsiObstacle *obstacle; /* NULL: none */
    double part;                  /* 0 .. 1 of the half element, that lies on it */
    bool slips;                   /* it has been drawn along with the point */
    /* the share of what the end presses on a held point that the ground bears, and its normal */
    double borne, normal[3];
} CpsiEndGround;

#endif
