/* SPDX-License-Identifier: BSD-3-Clause */
/* Nodes between the ends of lines that stages and moves hold, pull and let go (capstan/grasp.h). */
#ifndef CAPSTAN_SRC_EVOLVE_GRASPS_H
#define CAPSTAN_SRC_EVOLVE_GRASPS_H

#include "evolve/state.h"

/* Check what a stage changes at nodes; `what` is the subject of a message. Returns CPS_OK,
 * CPS_ERR_ARGUMENT or CPS_ERR_LIMIT. */
CpsStatus cpsi_grasp_changes_check(const CpsScene *scene, const CpsStage *stage, const char *what,
                                   CpsError *err);

/* Check what could not be checked with the scene: how many nodes are held or pulled at a time, and
 * the straight paths of those that are held, in the scene with obstacles and lengths of lines. */
CpsStatus cpsi_grasps_check(const CpsEvolution *evolution, const CpsScene *scene,
                            const CpsiEvolutionStage *stage, const char *what, CpsError *err);

/* What is imposed at `part` of the `steps` of a stage, from one value to another of its kind. */
CpsEnd cpsi_stage_value(const CpsEnd *from, const CpsEnd *to, double share);

/* What is imposed on nodes in step `part` of a stage. */
void cpsi_grasps_plan(CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                      const CpsiPortion *portion);

/* Is what a saved state says of the nodes of a line sound? */
bool cpsi_grasps_are_sound(const CpsiLine *line);

#endif
