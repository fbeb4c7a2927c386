/* SPDX-License-Identifier: BSD-3-Clause */
/* From the values of a scene file to the scene's structs. */
#ifndef CAPSTAN_SRC_IO_READ_SCENE_SCENE_BUILD_H
#define CAPSTAN_SRC_IO_READ_SCENE_SCENE_BUILD_H

#include "io/read/document.h"
#include "io/schema/tables/scene_keys.h"

/* Fill `scene` from the values of a file; arrays and names are allocated in `pool`, which outlives
 * the document. Returns CPS_OK, CPS_ERR_INPUT, CPS_ERR_LIMIT or CPS_ERR_MEMORY. */
CpsStatus cpsi_scene_build(const CpsiDocument *d, const CpsiSceneValues *values, CpsiPool *pool,
                           CpsScene *scene);

#endif
