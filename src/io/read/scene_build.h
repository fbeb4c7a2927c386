/* SPDX-License-Identifier: BSD-3-Clause */
/* From a validated tree to the scene's structs. */
#ifndef CAPSTAN_SRC_IO_READ_SCENE_BUILD_H
#define CAPSTAN_SRC_IO_READ_SCENE_BUILD_H

#include "capstan/io.h"
#include "io/base/yaml.h"

/* Fill `scene` from a tree that cpsi_scene_validate has passed; arrays and names go into the pool.
 * Returns CPS_OK, CPS_ERR_INPUT (a move without a known position), CPS_ERR_LIMIT or CPS_ERR_MEMORY. */
CpsStatus cpsi_scene_build(const char *file, const CpsiYaml *root, const CpsReadLimits *limits, CpsiPool *pool,
                           CpsScene *scene, CpsError *err);

#endif
