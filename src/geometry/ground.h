/* SPDX-License-Identifier: BSD-3-Clause */
/* The surface through the points of a grid (capstan/ground.h; docs/theory.md 2.3). */
#ifndef CAPSTAN_SRC_GEOMETRY_GROUND_H
#define CAPSTAN_SRC_GEOMETRY_GROUND_H

#include "capstan/ground.h"

/* Height [m], slopes [-] and second derivatives [1/m] at a place. */
typedef struct CpsiHeight {
    double z, x, y, xx, xy, yy;
} CpsiHeight;

CpsiHeight cpsi_ground_height(const CpsGround *ground, double x, double y);
/* [-] The factor of friction there; beyond the edges that of the edge. */
double cpsi_ground_friction_factor(const CpsGround *ground, double x, double y);
/* Is the place on the grid, or the grid extended, but for `rounding` [m]? */
bool cpsi_ground_covers(const CpsGround *ground, double x, double y, double rounding);
/* [m] The smallest distance of two neighbouring points. */
double cpsi_ground_spacing(const CpsGround *ground);

#endif
