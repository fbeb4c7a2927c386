/* SPDX-License-Identifier: BSD-3-Clause */
/* The steps of a run in pictures: their colours, widths and list, and the range of all their
 * tensions. */
#ifndef CAPSTAN_SRC_IO_DRAW_RUN_STEPS_H
#define CAPSTAN_SRC_IO_DRAW_RUN_STEPS_H

#include "io/draw/svg.h"
#include "io/history.h"

/* The list of steps to the right of a frame: names with colours, or a bar where there are many. */
void cpsi_step_list(const CpsResults *results, const CpsiFrame *frame, FILE *out);
CpsiColour cpsi_step_colour(const CpsResults *results, int snapshot);
/* Width of a step's curve: earlier ones are wider, so that they are visible under later ones. */
double cpsi_step_width(const CpsResults *results, int snapshot);
/* "81 steps", or "81 steps, 42 of them drawn" */
void cpsi_step_note(const CpsResults *results, char *out, size_t size);

/* Range of the tension over all snapshots [N]. */
void cpsi_tension_range(const CpsResults *results, double range[2]);

#endif
