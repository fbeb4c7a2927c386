/* SPDX-License-Identifier: BSD-3-Clause */
/* A line that slides along itself without end: the proof that there is no equilibrium at any place
 * along its way. */
#ifndef CAPSTAN_SRC_CABLE_ENDLESS_SLIDE_H
#define CAPSTAN_SRC_CABLE_ENDLESS_SLIDE_H

#include "cable/line.h"

/* Under its loads, does the line slide along itself, from its reference on and without end?  Asked
 * of a step that has found no answer; contacts and axes are those of the reference, and
 * line->motion is 0. The power that proves it must be more than `margin` of its terms' sizes. Where
 * it is, line->motion is the velocity of the proof, and report.proof and proof_value say so; else
 * motion is 0. O(nodes). */
bool cpsi_line_slides_endlessly(CpsiLine *line, double margin);

#endif
