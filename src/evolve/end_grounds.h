/* SPDX-License-Identifier: BSD-3-Clause */
/* What the ground under points bears of the lines that end there. */
#ifndef CAPSTAN_SRC_EVOLVE_END_GROUNDS_H
#define CAPSTAN_SRC_EVOLVE_END_GROUNDS_H

#include "evolve/state.h"

/* Find it from the reports on the points, and report lengths, touchdown, uplift and angles of these
 * lines with it. */
void cpsi_end_grounds_report(CpsEvolution *evolution);

#endif
