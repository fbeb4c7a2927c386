/* SPDX-License-Identifier: BSD-3-Clause */
/* What a scene gives of the surface of the water, and of what floats. */
#ifndef CAPSTAN_SRC_EVOLVE_WATER_CHECK_H
#define CAPSTAN_SRC_EVOLVE_WATER_CHECK_H

#include "capstan/scene.h"

/* Gravity in a scene with a surface; `what` names the stage that it belongs to, or is "gravity". */
CpsStatus cpsi_water_check(const CpsScene *scene, const double gravity[3], const char *what,
                           CpsError *err);

/* A point of the scene: what it displaces, and its height. */
CpsStatus cpsi_water_point_check(const CpsScene *scene, const CpsPoint *point, CpsError *err);

#endif
