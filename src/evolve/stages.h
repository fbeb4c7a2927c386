/* SPDX-License-Identifier: BSD-3-Clause */
/* Stages: what is imposed on the lines and obstacles in a load step.
 *
 * A stage of n steps takes each end that it changes from where it is (position, or force carried)
 * to the stage's value in n equal increments; so it does with gravity, and with the angles of
 * obstacles. */
#ifndef CAPSTAN_SRC_EVOLVE_STAGES_H
#define CAPSTAN_SRC_EVOLVE_STAGES_H

#include "evolve/state.h"

/* Memory for a stage of so many changes of ends, points and bodies, turns, grasps, shifts,
 * oscillations, and lengths paid out. */
void cpsi_stage_layout(CpsiEvolutionStage *stage, CpsiArena *arena, int changes, int points,
                       int bodies, int turns, int grasps, int shifts, int sways, size_t rows,
                       int pay_outs);

/* Fill it with what a checked stage changes, positions relative to `origin`; not its name. */
void cpsi_stage_fill(CpsiEvolutionStage *stage, const CpsStage *from, const double origin[3]);

/* The scene that a stage is checked against (stage_check.h, path_check.h): obstacles, and names and
 * lengths of lines. */
CpsScene cpsi_stage_scene(const CpsEvolution *evolution);

/* Check the straight paths of free ends that the stage grabs, which could not be checked with the
 * scene.
 *
 *   all    check those of held ends as well: they may be elsewhere than the scene's history says
 *   what   the subject of a message: "stage 'out'"
 *
 * Returns CPS_OK or CPS_ERR_ARGUMENT. */
CpsStatus cpsi_stage_check_paths(const CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                                 bool all, const char *what, CpsError *err);

/* Set what the lines and obstacles do in a portion of a stage, and the name of the step. The first
 * step finds where everything is. */
void cpsi_stage_plan(CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                     const CpsiPortion *portion);

/* The same of the step that places lines by statics: nothing changes. */
void cpsi_stage_plan_statics(CpsEvolution *evolution);

/* The same of a break: an end is let go, and nothing else changes. */
void cpsi_stage_plan_break(CpsEvolution *evolution, const CpsBreak *parts);

#endif
