/* SPDX-License-Identifier: BSD-3-Clause */
/* A line with a static and a dynamic stiffness (docs/theory.md 1). */
#ifndef CAPSTAN_SRC_CABLE_TWO_STIFFNESSES_H
#define CAPSTAN_SRC_CABLE_TWO_STIFFNESSES_H

#include "cable/line.h"

/* Put one of a line's stiffnesses in force: the dynamic one about the configuration that the other
 * has reached. A line that has one stiffness keeps it. */
void cpsi_line_use_stiffness(CpsiLine *line, bool is_dynamic);

/* Write what is in force by is_dynamic and rest_strain into the line's arrays. */
void cpsi_line_set_stiffness(CpsiLine *line);

#endif
