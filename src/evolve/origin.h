/* SPDX-License-Identifier: BSD-3-Clause */
/* A local origin for scenes that lie far from that of their coordinates (UTM, say): the difference
 * of two coordinates keeps no more digits than they have, so everything is computed from a place
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

/* The scene is checked. Every coordinate of the copy is the given one less the origin, exactly
 * wherever the place is as near to the lines as the lines are to each other. Returns CPS_OK or
 * CPS_ERR_MEMORY. */
CpsStatus cpsi_local_scene(const CpsScene *scene, CpsiLocalScene *out, CpsError *err);
void cpsi_local_scene_free(CpsiLocalScene *local);

/* [m] What rounding of coordinates as large as those of x may leave between places that were meant
 * to agree; 0 up to as many lengths of its line as need no local origin. */
double cpsi_place_rounding(double length, Vec3 x);

#endif
