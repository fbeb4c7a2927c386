/* SPDX-License-Identifier: BSD-3-Clause */
/* The check of the shapes of obstacles. */
#ifndef CAPSTAN_SRC_EVOLVE_SHAPE_CHECK_H
#define CAPSTAN_SRC_EVOLVE_SHAPE_CHECK_H

#include "capstan/scene.h"

/* Place, direction, radius and sizes of what has a radius. */
CpsStatus cpsi_shape_check(const CpsObstacle *obstacle, CpsError *err);

#endif
