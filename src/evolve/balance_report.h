/* SPDX-License-Identifier: BSD-3-Clause */
/* What a step reports on points and bodies (capstan/point.h, capstan/body.h). */
#ifndef CAPSTAN_SRC_EVOLVE_BALANCE_REPORT_H
#define CAPSTAN_SRC_EVOLVE_BALANCE_REPORT_H

#include "evolve/trial.h"

/* Of those that the search has found, in its last trial; the lines there are not certified where a
 * place is not found. */
void cpsi_report_found(CpsiBalance *balance);
/* Of those of a group that has none, where the step began, its lines reported on. */
void cpsi_report_no_place(CpsiBalance *balance);
/* Of those that are held, or on a body. */
void cpsi_report_held(CpsEvolution *evolution);

#endif
