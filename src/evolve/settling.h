/* SPDX-License-Identifier: BSD-3-Clause */
/* What a line that moved loses as a quasi-static step brings it to rest.
 *
 * From the first part of such a step on its forces are those of an equilibrium, and before it they
 * were not: there all forces do their work at their values after the part, on the displacement D of
 * it, as in a step in time (time_ledger.h). With p the forces of the elements and E the elastic
 * energy
 *
 *     settling = kinetic energy before  +  sum (p . D) - increase of E
 *                - [work of reactions and friction on D, less what is dissipated, or done by the
 *                   ground's way]
 *
 * where the second difference is at least 0 because E is convex, and so is the work of a reaction
 * on what lands. */
#ifndef CAPSTAN_SRC_EVOLVE_SETTLING_H
#define CAPSTAN_SRC_EVOLVE_SETTLING_H

#include "cable/line.h"

/* The line is to be brought to rest in the quasi-static step that begins, and its next step in time
 * is an Euler step. Its kinetic energy is lost, and noted in its ledger of motion. */
void cpsi_line_stop(CpsiLine *line);

/* [J] The elastic energy that elements keep beyond that of their strain, as they go back from where
 * internal damping has left them. */
double cpsi_settling_stored(const CpsiLine *line);

/* [J] The loss beside the kinetic energy in a part of the step that is solved, whose other entries
 * are in `ledger`. */
double cpsi_settling_loss(const CpsiLine *line, const CpsLedger *ledger);

/* The step is taken: its ledger of motion. */
void cpsi_settling_close(CpsiLine *line);

#endif
