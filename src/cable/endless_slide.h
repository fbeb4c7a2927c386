/* SPDX-License-Identifier: BSD-3-Clause */
/* A line that slides along itself without end: the proof that there is no equilibrium at any
 * position along its path. */
#ifndef CAPSTAN_SRC_CABLE_ENDLESS_SLIDE_H
#define CAPSTAN_SRC_CABLE_ENDLESS_SLIDE_H

#include "cable/line.h"

/* Under its loads, does the line slide along itself, from its reference on and without end? Used
 * for a step that has found no solution; contacts and axes are those of the reference, and
 * line->motion is 0. The power in the proof must exceed `margin` times the sum of the sizes of its
 * terms. If it does, line->motion is the velocity of the proof, and report.proof and proof_force
 * are set; else motion is 0. O(nodes). */
bool cpsi_line_slides_endlessly(CpsiLine *line, double margin);

#endif
