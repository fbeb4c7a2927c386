/* SPDX-License-Identifier: BSD-3-Clause */
/* From the values of a scene file to a mesh. */
#ifndef CAPSTAN_SRC_IO_READ_SHAPES_MESH_MESH_BUILD_H
#define CAPSTAN_SRC_IO_READ_SHAPES_MESH_MESH_BUILD_H

#include "base/rotation.h"
#include "capstan/mesh.h"
#include "io/read/document.h"
#include "io/schema/tables/scene_keys.h"

/* Read the file that an obstacle names, scale and turn what is in it, and make its mesh, with one
 * reference; on failure *out is NULL. */
CpsStatus cpsi_mesh_build(const CpsiDocument *d, const CpsiObstacleValues *values, Rotation turn,
                          CpsMesh **out);

#endif
