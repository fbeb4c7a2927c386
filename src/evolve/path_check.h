/* SPDX-License-Identifier: BSD-3-Clause */
/* The straight paths of held ends must not lead through obstacles. */
#ifndef CAPSTAN_SRC_EVOLVE_PATH_CHECK_H
#define CAPSTAN_SRC_EVOLVE_PATH_CHECK_H

#include "base/vec3.h"
#include "capstan/scene.h"
#include "geometry/obstacle.h"

/* Depth below the surface that still counts as touching, per length of the line. */
#define CPSI_PATH_TOUCH 1e-9

/* [m] Depth of the straight path in the obstacle, if it exceeds `touch` and the depth of its first
 * point (a free end may lie below the surface with contact of the reference or frozen friction);
 * else 0. */
double cpsi_path_depth(const CpsiObstacle *obstacle, Vec3 from, Vec3 to, double touch);

/* Check the changes of a history whose initial points are known before anything is solved: those of
 * ends that are already held. The scene has passed all other checks. Returns CPS_OK,
 * CPS_ERR_ARGUMENT or CPS_ERR_MEMORY. */
CpsStatus cpsi_path_check(const CpsScene *scene, CpsError *err);

#endif
