/* SPDX-License-Identifier: BSD-3-Clause */
/* The check of ends and points that are held to sets, and the report on them
 * (capstan/constraint.h). */
#ifndef CAPSTAN_SRC_EVOLVE_CONSTRAINTS_H
#define CAPSTAN_SRC_EVOLVE_CONSTRAINTS_H

#include "evolve/state.h"

/* Check the constraints of a line whose start and ends have been checked. */
CpsStatus cpsi_constraints_check(const CpsLine *line, CpsError *err);
/* No line with a set ends at a point; and check the sets of points that have been checked. */
CpsStatus cpsi_constraints_check_points(const CpsScene *scene, CpsError *err);

/* Check what a stage does to such ends. */
CpsStatus cpsi_constraints_check_stage(const CpsScene *scene, const CpsStage *stage,
                                       const char *what, CpsError *err);

/* Prepare the sets that are given by expressions, of a scene whose places are relative to its
 * origin; and free them. */
CpsStatus cpsi_constraints_make(CpsEvolution *evolution, const CpsScene *scene, CpsError *err);
void cpsi_constraints_free(CpsEvolution *evolution);

/* Fill the sets of a line, but for what belongs to expressions. */
void cpsi_constraints_fill(CpsiLine *line, const CpsLine *given);
/* ... and those of the points of a scene. */
void cpsi_point_constraints_fill(CpsiPoints *points, const CpsScene *scene);

#endif
