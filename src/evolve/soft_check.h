/* SPDX-License-Identifier: BSD-3-Clause */
/* The check of obstacles that give (CpsObstacle.stiffness). */
#ifndef CAPSTAN_SRC_EVOLVE_SOFT_CHECK_H
#define CAPSTAN_SRC_EVOLVE_SOFT_CHECK_H

#include "capstan/scene.h"

/* An obstacle that gives, the first one; NULL: there is none. */
const CpsObstacle *cpsi_soft_obstacle(const CpsScene *scene);
/* Can obstacle `o` give as the scene says, beside all else that the scene has? */
CpsStatus cpsi_soft_obstacle_check(const CpsScene *scene, const CpsObstacle *o, CpsError *err);
/* Is the bearing area of a point one that an obstacle meets? */
CpsStatus cpsi_soft_point_check(const CpsScene *scene, int index, CpsError *err);
/* Has line i the width that it needs, and a start that says nothing of its reactions? */
CpsStatus cpsi_soft_line_check(const CpsScene *scene, const CpsLine *line, CpsError *err);

#endif
