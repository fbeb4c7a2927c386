/* SPDX-License-Identifier: BSD-3-Clause */
/* The check of points that are anchors (anchors.h). */
#ifndef CAPSTAN_SRC_EVOLVE_ANCHOR_CHECK_H
#define CAPSTAN_SRC_EVOLVE_ANCHOR_CHECK_H

#include "capstan/scene.h"

/* What concerns anchors of a point of the scene whose longest line has this length [m]. */
CpsStatus cpsi_anchor_check(const CpsScene *scene, const CpsPoint *point, double length,
                            CpsError *err);

#endif
