/* SPDX-License-Identifier: BSD-3-Clause */
/* Capsules, tori, cones, boxes and insides, for the audit of rig.c. */
#ifndef CAPSTAN_TEST_RIG_SHAPE_H
#define CAPSTAN_TEST_RIG_SHAPE_H

#include "capstan/scene.h"

/* Is it one of these? */
bool rig_is_shape(const CpsObstacle *obstacle);
/* The distance of x, the normal towards the line and, unless NULL, the nearest point of the core.
 */
double rig_shape_distance(const CpsObstacle *obstacle, const double *x, double *normal,
                          double *core);
/* The way from foot to foot, as a tangent at its end. */
void rig_shape_path(const CpsObstacle *obstacle, const double *from, const double *to, double *out);

#endif
