/* SPDX-License-Identifier: BSD-3-Clause */
/* From the values of a scene file to the scene's structs. */
#ifndef CAPSTAN_SRC_IO_READ_SCENE_SCENE_BUILD_H
#define CAPSTAN_SRC_IO_READ_SCENE_SCENE_BUILD_H

#include "io/read/document.h"
#include "io/read/scene/parts/body_build.h"
#include "io/schema/tables/scene_keys.h"

/* Fill `scene` from the values of a file; arrays and names are allocated in `pool`, which outlives
 * the document. Returns CPS_OK, CPS_ERR_INPUT, CPS_ERR_LIMIT or CPS_ERR_MEMORY. */
CpsStatus cpsi_scene_build(const CpsiDocument *d, const CpsiSceneValues *values, CpsiPool *pool,
                           CpsScene *scene);

/* Fill the kind of an obstacle, and what its shape has, from its values: shape_build.c. */
void cpsi_shape_build(const CpsiObstacleValues *values, CpsObstacle *obstacle);

/* ---- the history: history_build.c ---- */

/* Where what the history moves is held after the preceding entry. */
typedef struct CpsiHeldBefore {
    bool (*released)[2]; /* (lines) ends that the history has let go so far */
    double (*end)[2][3]; /* (lines) [m] position of each end; NaN: not held, or not known */
    double (*point)[3];  /* (points) [m] likewise */
    CpsiHeldPose *body;  /* (bodies) likewise */
} CpsiHeldBefore;

/* The scene so far, which the history refers to. */
typedef struct CpsiHistoryBuild {
    const CpsiDocument *d;
    CpsiPool *pool; /* memory of the scene */
    CpsScene *scene;
    CpsObstacle *obstacle; /* of the scene: the history says which of them move */
    CpsiHeldBefore held;   /* before its first entry */
} CpsiHistoryBuild;

/* The stages of the scene. */
CpsStatus cpsi_history_build(const CpsiHistoryBuild *b, const CpsiList *history);

/* ---- lengths: pretension_build.c ---- */

/* Give the lines with a pretension the lengths that have it; the scene has been built and
 * checked. */
CpsStatus cpsi_scene_find_lengths(const CpsiDocument *d, const CpsiSceneValues *values,
                                  CpsiPool *pool, CpsScene *scene);

/* ---- floats: float_split.c ---- */

/* Divide the lines with floats at them, after what is above: the parts of a line `leg` are `leg-1`,
 * `leg-2`, .., the points at which they meet `leg-float-1`, .. . The first part is in the place of
 * the line, the others follow after all lines. */
CpsStatus cpsi_scene_split_floats(const CpsiDocument *d, const CpsiSceneValues *values,
                                  CpsiPool *pool, CpsScene *scene);

#endif
