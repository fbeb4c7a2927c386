/* SPDX-License-Identifier: BSD-3-Clause */
/* The straight paths of held ends must not lead through obstacles. */
#ifndef CAPSTAN_SRC_EVOLVE_PATH_CHECK_H
#define CAPSTAN_SRC_EVOLVE_PATH_CHECK_H

#include <stdbool.h>

#include "capstan/scene.h"

/* Check the straight path on which a change takes a held end, or a free end that it grabs, from
 * where it is. A free end may lie below the surface with contact of the reference or frozen
 * friction; then its path may be as deep.
 *
 *   scene   its obstacles, and the names and lengths of its lines
 *   from    [m] in the coordinates of the scene
 *   what    the subject of the message: "stage 3"
 *
 * Returns CPS_OK or CPS_ERR_ARGUMENT. */
CpsStatus cpsi_path_check_change(const CpsScene *scene, const CpsChange *change,
                                 const double from[3], bool grabbed, const char *what,
                                 CpsError *err);

/* The same for a point that is to be held; `length` [m] is that of its longest line. */
CpsStatus cpsi_path_check_point(const CpsScene *scene, const CpsPointChange *change, double length,
                                const double from[3], bool grabbed, const char *what,
                                CpsError *err);

/* The same for a node that is held where it is, and moved from there. */
CpsStatus cpsi_path_check_grasp(const CpsScene *scene, const CpsGraspChange *change,
                                const double from[3], const char *what, CpsError *err);

/* Check the changes of a history whose initial points are known before anything is solved: those of
 * ends that are already held. The scene has passed all other checks. Returns CPS_OK,
 * CPS_ERR_ARGUMENT or CPS_ERR_MEMORY. */
CpsStatus cpsi_path_check(const CpsScene *scene, CpsError *err);

/* The same for points, in the scene as it was given: one that is free is at no known place. */
CpsStatus cpsi_path_check_points(const CpsScene *scene, CpsError *err);

#endif
