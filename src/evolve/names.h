/* SPDX-License-Identifier: BSD-3-Clause */
/* Names of lines, obstacles and points. */
#ifndef CAPSTAN_SRC_EVOLVE_NAMES_H
#define CAPSTAN_SRC_EVOLVE_NAMES_H

#include "capstan/base.h"

/* Names are file and column names elsewhere: a letter, then letters, digits, _ and -, 64 in all.
 * `what` and `index`, from 0, say whose it is. Returns CPS_OK or CPS_ERR_ARGUMENT. */
CpsStatus cpsi_name_check(const char *what, int index, const char *name, CpsError *err);

#endif
