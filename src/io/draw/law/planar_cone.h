/* SPDX-License-Identifier: BSD-3-Clause */
/* A closed convex cone of the plane as a range of directions: the empty range, a ray, a line, a
 * sector, a half-plane, the whole plane. */
#ifndef CAPSTAN_SRC_IO_DRAW_LAW_PLANAR_CONE_H
#define CAPSTAN_SRC_IO_DRAW_LAW_PLANAR_CONE_H

#include "capstan/set.h"

typedef struct CpsiPlanarCone {
    int dimension;      /* 0: only 0, or not known */
    bool line;          /* for dimension 1: whether both directions belong to it */
    double start, turn; /* angles from `start` on, counterclockwise, turn from 0 to 2 pi */
} CpsiPlanarCone;

CpsStatus cpsi_planar_cone(const CpsSet *cone, CpsiPlanarCone *out, CpsError *err);

#endif
