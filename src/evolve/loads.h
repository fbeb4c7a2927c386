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
void cpsi_line_loads_fill(CpsiLine *line, const CpsScene *scene, const CpsLine *def,
                          const double origin[3], CpsCurrentRow *row, CpsiFlow *flow);

#endif
