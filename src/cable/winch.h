/* SPDX-License-Identifier: BSD-3-Clause */
/* Winches at the ends of a line (capstan/winch.h). The mesh is a function of the lengths on the
 * drums alone. */
#ifndef CAPSTAN_SRC_CABLE_WINCH_H
#define CAPSTAN_SRC_CABLE_WINCH_H

#include "cable/line.h"

static inline bool cpsi_line_has_winch(const CpsiLine *line) {
    return line->drums.on[CPS_END_A] || line->drums.on[CPS_END_B];
}

/* Is element e on a drum? */
static inline bool cpsi_line_is_on_drum(const CpsiLine *line, int e) {
    return e < line->drums.nodes[CPS_END_A] || e >= line->n - 1 - line->drums.nodes[CPS_END_B];
}

/* Is node j on a drum, and not the one at which the line leaves it? */
static inline bool cpsi_line_is_node_on_drum(const CpsiLine *line, int j) {
    return j < line->drums.nodes[CPS_END_A] || j > line->n - 1 - line->drums.nodes[CPS_END_B];
}

/* Keep the whole line; its elements, factors and point masses are laid out. */
void cpsi_winch_keep(CpsiLine *line);

/* Set the lengths on the drums [m], each >= 0, and with them the mesh: element lengths, arc
 * lengths, weights and the length of the line. Of a line without winches nothing. */
void cpsi_winch_set(CpsiLine *line, const double stored[2]);

/* Wind what is due in this substep. */
void cpsi_winch_wind(CpsiLine *line);

/* Elements on drums carry nothing: their forces become 0. A program of several lines leaves in them
 * what is rounding beside the largest force of all. */
void cpsi_winch_unload(CpsiLine *line);

/* [N] What the winch at an end gains in energy per length that it pays out: T + W*(T), less half of
 * what raises an end element, and of what its other node has stored in what gives per length. That
 * is the pull on the drum of a line that does not stretch. `before`: with the weight and the
 * obstacles before the step. */
double cpsi_winch_pull(const CpsiLine *line, int end, bool before);

#endif
