/* SPDX-License-Identifier: BSD-3-Clause */
/* Springs, forces and drag of the lines of a scene (capstan/loads.h). */
#ifndef CAPSTAN_SRC_EVOLVE_LOADS_H
#define CAPSTAN_SRC_EVOLVE_LOADS_H

#include "cable/line.h"
#include "capstan/scene.h"

CpsStatus cpsi_line_loads_check(const CpsScene *scene, const CpsLine *line, CpsError *err);
CpsStatus cpsi_current_check(const CpsScene *scene, CpsError *err);
/* No inextensible line with a potential ends at a point. */
CpsStatus cpsi_potential_ends_check(const CpsScene *scene, CpsError *err);

/* Has the line springs; given forces; a potential; drag in the scene's current? */
bool cpsi_has_springs(const CpsLine *line);
bool cpsi_has_potential(const CpsLine *line);
bool cpsi_has_forces(const CpsLine *line);
bool cpsi_has_drag(const CpsScene *scene, const CpsLine *line);

/* Fill the arrays of the line, which is where it starts, with coordinates from `origin`; `row`
 * (row_count of the current) is where the current is kept, and `flow` what drag needs. */
/* The rows of the current about an origin. */
void cpsi_current_fill(const CpsCurrent *current, const double origin[3], CpsCurrentRow *row);
void cpsi_line_loads_fill(CpsiLine *line, const CpsScene *scene, const CpsLine *def,
                          const double origin[3], CpsCurrentRow *row, CpsiFlow *flow);
/* Take over the function of a load along it, from which its layout follows. */
void cpsi_line_loads_take(CpsiLine *line, const CpsLine *def);
/* Impose the load that a function gives along the line at a time [s], where there is one. */
void cpsi_line_loads_impose(CpsiLine *line, double time);

#endif
