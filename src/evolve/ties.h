/* SPDX-License-Identifier: BSD-3-Clause */
/* Which ends of the lines of a scene are at which points, and what points and bodies need. */
#ifndef CAPSTAN_SRC_EVOLVE_TIES_H
#define CAPSTAN_SRC_EVOLVE_TIES_H

#include "capstan/scene.h"

/* At no point. */
enum { CPSI_NO_POINT = -1 };

/* The point of an end of a scene's line, or CPSI_NO_POINT. */
static inline int cpsi_point_of(const CpsLine *line, int end) {
    return line->end[end].kind == CPS_END_KIND_POINT ? line->end_point[end] : CPSI_NO_POINT;
}

/* [m] The length of the longest line that ends at a point; 0: none does. */
double cpsi_longest_line(const CpsScene *scene, int point);
/* ... and of each point (point_count). */
void cpsi_longest_lines(const CpsScene *scene, double *longest);

/* What is free, `what` 'name', needs friction on all obstacles that is the same in all directions.
 * Returns CPS_OK or CPS_ERR_ARGUMENT. */
CpsStatus cpsi_isotropy_check(const CpsScene *scene, const char *what, const char *name,
                              CpsError *err);

/* What `what` 'name' weighs, or what lifts it, changes with gravity and needs one. Returns CPS_OK
 * or CPS_ERR_ARGUMENT. */
CpsStatus cpsi_gravity_check(const CpsScene *scene, const char *what, const char *name,
                             bool has_weight, CpsError *err);

#endif
