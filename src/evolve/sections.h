/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines whose weight, stiffness and breaking load differ along them, and what hangs on their nodes.
 */
#ifndef CAPSTAN_SRC_EVOLVE_SECTIONS_H
#define CAPSTAN_SRC_EVOLVE_SECTIONS_H

#include "cable/line.h"
#include "capstan/scene.h"

/* Check sections and point weights of a line whose length and elements have been checked; of a line
 * without sections, weight, stiffness and breaking load. */
CpsStatus cpsi_sections_check(const CpsScene *scene, const CpsLine *def, CpsError *err);

/* Has it sections or point weights? Is it elastic? */
bool cpsi_has_sections(const CpsLine *def);
bool cpsi_is_elastic(const CpsLine *def);

/* Has it, or a section of it, a breaking load? */
bool cpsi_has_breaking_load(const CpsLine *def);
bool cpsi_has_break_at(const CpsLine *def);

/* Has it, or a section of it, a dynamic stiffness? */
bool cpsi_has_dynamic_stiffness(const CpsLine *def);

/* The number of springs beside the stiffness of its elements (base/element_law.h), by tables of the
 * static or the dynamic stiffness. */
int cpsi_spring_count(const CpsLine *def, bool is_dynamic);

/* [1/N] 1/EA without tension, of a line of sections the mean over its length. */
double cpsi_mean_compliance(const CpsLine *def);
/* [N/m] weight per length; of a line of sections or with point weights all of them over the length,
 * those of buoys counted as if they hung. */
double cpsi_mean_weight(const CpsLine *def);

/* Write the factors and lengths of a line with sections or point weights, and breaking loads and
 * springs where there are any; its mesh is set. */
void cpsi_sections_fill(CpsiLine *line, const CpsLine *def);

#endif
