/* SPDX-License-Identifier: BSD-3-Clause */
/* A local origin for scenes far from the origin of their coordinates (UTM, for instance):
 * differences of large coordinates lose digits, so all positions are taken relative to a point
 * among the lines. */
#ifndef CAPSTAN_SRC_EVOLVE_ORIGIN_H
#define CAPSTAN_SRC_EVOLVE_ORIGIN_H

#include "base/vec3.h"
#include "capstan/scene.h"

/* A scene about its local origin: itself where that is 0 0 0, else a copy that owns `block`. */
typedef struct CpsiLocalScene {
    CpsScene scene;
    double origin[3]; /* [m] */
    void *block;
} CpsiLocalScene;

/* The scene has been checked. Every coordinate of the copy is the given one less the origin. The
 * difference is exact wherever the point is as near to the lines as the lines are to each other.
 * Returns CPS_OK or CPS_ERR_MEMORY. */
CpsStatus cpsi_local_scene(const CpsScene *scene, CpsiLocalScene *out, CpsError *err);
void cpsi_local_scene_free(CpsiLocalScene *local);

/* [m] Distance that rounding of coordinates of the size of x may cause between points meant to be
 * equal; 0 within the range in which a line needs no local origin. */
double cpsi_place_rounding(double length, Vec3 x);

#endif
