/* SPDX-License-Identifier: BSD-3-Clause */
/* From the values of a scene file to the scene's structs. */
#ifndef CAPSTAN_SRC_IO_READ_SCENE_SCENE_BUILD_H
#define CAPSTAN_SRC_IO_READ_SCENE_SCENE_BUILD_H

#include "io/read/document.h"
#include "io/read/scene/section_build.h"
#include "io/schema/tables/scene_keys.h"

/* Fill `scene` from the values of a file; arrays and names are allocated in `pool`, which outlives
 * the document. Returns CPS_OK, CPS_ERR_INPUT, CPS_ERR_LIMIT or CPS_ERR_MEMORY. */
CpsStatus cpsi_scene_build(const CpsiDocument *d, const CpsiSceneValues *values, CpsiPool *pool,
                           CpsScene *scene);

/* ---- rigid bodies: body_build.c ---- */

/* A rotation as a quaternion, of any length. */
void cpsi_rotation_build(const CpsiRotationValues *values, double out[4]);

/* Where a body is held after the preceding entry of the history. */
typedef struct CpsiHeldPose {
    bool is_known; /* false: it is free */
    double position[3], rotation[4];
} CpsiHeldPose;

/* The bodies of the scene; `held`: as many poses in which they begin, in memory of the document. */
CpsStatus cpsi_bodies_build(const CpsiMaterials *materials, const CpsiList *bodies, CpsScene *scene,
                            CpsiHeldPose **held);

/* The index of the body whose name is the node's text. */
CpsStatus cpsi_body_find(const CpsiDocument *d, const CpsScene *scene, const CpsiYaml *node,
                         int *index);

/* What an entry changes at a body, without its index; `held` becomes the pose after it. */
CpsStatus cpsi_body_change_build(const CpsiDocument *d, const CpsiBodyChangeValues *values,
                                 CpsiHeldPose *held, CpsBodyChange *change);

/* Give the lines with a pretension the lengths that have it; the scene has been built and
 * checked. */
CpsStatus cpsi_scene_find_lengths(const CpsiDocument *d, const CpsiSceneValues *values,
                                  CpsiPool *pool, CpsScene *scene);

#endif
