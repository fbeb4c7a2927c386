/* SPDX-License-Identifier: BSD-3-Clause */
/* Rigid bodies: from the values of a scene file to the scene's structs. */
#ifndef CAPSTAN_SRC_IO_READ_SCENE_PARTS_BODY_BUILD_H
#define CAPSTAN_SRC_IO_READ_SCENE_PARTS_BODY_BUILD_H

#include "io/read/scene/parts/section_build.h"

/* As a quaternion. */
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

/* Add to the pose the displacement, and turn it by the rotation vector [rad], of an oscillation. */
void cpsi_held_pose_sway(CpsiHeldPose *held, const double by[6]);

/* What an entry changes at a body, without its index; `held` becomes the pose after it. */
CpsStatus cpsi_body_change_build(const CpsiDocument *d, const CpsiBodyChangeValues *values,
                                 CpsiHeldPose *held, CpsBodyChange *change);

#endif
