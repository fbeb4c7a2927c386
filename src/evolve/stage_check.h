/* SPDX-License-Identifier: BSD-3-Clause */
/* The check of what a stage changes, apart from the paths of held ends (path_check.h). */
#ifndef CAPSTAN_SRC_EVOLVE_STAGE_CHECK_H
#define CAPSTAN_SRC_EVOLVE_STAGE_CHECK_H

#include "capstan/scene.h"

/* Check a stage of a scene, or one that is taken now.
 *
 *   scene   its obstacles have been checked, and the names and lengths of its lines
 *   what    the subject of a message: "stage 3"
 *
 * Returns CPS_OK, CPS_ERR_ARGUMENT or CPS_ERR_LIMIT; the place of an error is relative to the
 * stage. */
CpsStatus cpsi_stage_check(const CpsScene *scene, const CpsStage *stage, const char *what,
                           CpsError *err);

#endif
