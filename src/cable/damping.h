/* SPDX-License-Identifier: BSD-3-Clause */
/* The internal damping of a line that moves in time (docs/theory.md 9). */
#ifndef CAPSTAN_SRC_CABLE_DAMPING_H
#define CAPSTAN_SRC_CABLE_DAMPING_H

#include "cable/line.h"

static inline bool cpsi_line_has_damping(const CpsiLine *line) {
    return line->has_inertia && line->inertia.damping.coefficient > 0;
}

/* The elongations are those of the positions, and have been: a first step in time follows. */
void cpsi_line_begin_damping(CpsiLine *line);
/* Let the elements have the law of the step under way, whose spans are set; and again their own. */
void cpsi_line_damp(CpsiLine *line);
void cpsi_line_undamp(CpsiLine *line);

/* An element in the step that has been solved. */
typedef struct CpsiDamped {
    double stored;     /* [J] growth of its elastic energy */
    double damped;     /* [J] dissipated by its damping */
    double elongation; /* [-] d, now */
} CpsiDamped;
CpsiDamped cpsi_line_damped(const CpsiLine *line, int e);
/* [J] What the elements store beyond the energy of their strains: where a line goes slack its
 * elongations go back to 0 as if alone. */
double cpsi_line_kept_energy(const CpsiLine *line);
/* Go on from the step: it becomes the past. */
void cpsi_line_advance_damping(CpsiLine *line);

#endif
