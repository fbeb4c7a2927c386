/* SPDX-License-Identifier: BSD-3-Clause */
/* From the values of a scene file to a ground. */
#ifndef CAPSTAN_SRC_IO_READ_SHAPES_GROUND_GROUND_BUILD_H
#define CAPSTAN_SRC_IO_READ_SHAPES_GROUND_GROUND_BUILD_H

#include "capstan/ground.h"
#include "io/read/document.h"
#include "io/schema/tables/scene_keys.h"

/* Read the files that an obstacle names, and make its ground, with one reference; on failure *out
 * is NULL. */
CpsStatus cpsi_ground_build(const CpsiDocument *d, const CpsiObstacleValues *values,
                            CpsGround **out);

#endif
