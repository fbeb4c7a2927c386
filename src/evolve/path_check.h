/* SPDX-License-Identifier: BSD-3-Clause */
/* The straight ways along which held ends are moved must not lead through obstacles. */
#ifndef CAPSTAN_SRC_EVOLVE_PATH_CHECK_H
#define CAPSTAN_SRC_EVOLVE_PATH_CHECK_H

#include "base/vec3.h"
#include "capstan/scene.h"
#include "geometry/obstacle.h"

/* How far below the surface still counts as touching, per length of the line. */
#define CPSI_PATH_TOUCH 1e-9

/* [m] How deep the straight way goes into the obstacle, where it goes deeper than `touch` and
 * deeper than it begins (a free end may lie below the surface with strict contact or frozen
 * friction); else 0. */
double cpsi_path_depth(const CpsiObstacle *obstacle, Vec3 from, Vec3 to, double touch);

/* The moves of a history whose beginnings are known before anything is solved: those of ends that
 * are held already. The scene has passed all other checks. Returns CPS_OK, CPS_ERR_ARGUMENT or
 * CPS_ERR_MEMORY. */
CpsStatus cpsi_path_check(const CpsScene *scene, CpsError *err);

#endif
