/* SPDX-License-Identifier: BSD-3-Clause */
/* Anchors: held points with a holding capacity (capstan/point.h). One that drags takes part in the
 * search for the places of free points, as a point that stays in a plane and has friction of a
 * given bound there: trial.c and newton_step.c treat it as one that slides on an obstacle. */
#ifndef CAPSTAN_SRC_EVOLVE_ANCHORS_H
#define CAPSTAN_SRC_EVOLVE_ANCHORS_H

#include "evolve/state.h"

/* Of the plane in which a held point bears: that on which it lies, or a level one. */
Vec3 cpsi_anchor_normal(const CpsEvolution *evolution, int point);

/* What of its capacity and limit a held point uses, from what holds it in all. */
void cpsi_anchor_use(const CpsEvolution *evolution, int point, Vec3 support,
                     CpsPointReport *report);

#endif
