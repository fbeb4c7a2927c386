/* SPDX-License-Identifier: BSD-3-Clause */
/* What a scene gives for steps in time: its check, and the masses of the nodes. */
#ifndef CAPSTAN_SRC_EVOLVE_TIME_CHECK_H
#define CAPSTAN_SRC_EVOLVE_TIME_CHECK_H

#include "cable/line.h"
#include "capstan/scene.h"

/* May steps of the scene have a duration? */
bool cpsi_is_in_time(const CpsScene *scene);

/* Check the numbers of the scene that concern time and inertia. */
CpsStatus cpsi_time_check(const CpsScene *scene, CpsError *err);

/* Check the duration of a stage or move. */
CpsStatus cpsi_stage_time_check(const CpsStage *stage, const char *what, CpsError *err);

/* Set the masses of the nodes and their first velocities; the line is placed. */
void cpsi_inertia_fill(CpsiLine *line, const CpsLine *def);

#endif
