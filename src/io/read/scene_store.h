/* SPDX-License-Identifier: BSD-3-Clause */
/* From a validated mapping of a scene file into its struct, as the rows of its table say. */
#ifndef CAPSTAN_SRC_IO_READ_SCENE_STORE_H
#define CAPSTAN_SRC_IO_READ_SCENE_STORE_H

#include "io/base/pool.h"
#include "io/schema/scene_keys.h"

/* Store every value of `node` whose row has a place in `out`, the struct that the rows of `object` speak of; what is not given stays as it is.
 * Texts are copied into the pool. False: no memory. */
bool cpsi_scene_store(CpsiObject object, const CpsiYaml *node, CpsiPool *pool, void *out);

#endif
