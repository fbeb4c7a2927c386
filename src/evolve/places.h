/* SPDX-License-Identifier: BSD-3-Clause */
/* Positions of a scene beside its obstacles. */
#ifndef CAPSTAN_SRC_EVOLVE_PLACES_H
#define CAPSTAN_SRC_EVOLVE_PLACES_H

#include "base/vec3.h"
#include "capstan/scene.h"

/* [m] Distance of a point above the nearest obstacle, and its name; INFINITY without one. Those
 * that move are where the scene says only at its start, and left out later. */
double cpsi_scene_height(const CpsScene *scene, Vec3 x, bool at_start, const char **name);

/* [m] Tolerance for a position of a line: of a held end to the end of the initial shape, and of any
 * point below an obstacle. */
double cpsi_place_tolerance(const CpsLine *line, Vec3 x);

#endif
