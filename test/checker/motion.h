/* SPDX-License-Identifier: BSD-3-Clause */
/* Whether a velocity field proves that a line slides along itself without end. */
#ifndef CAPSTAN_CHECKER_MOTION_H
#define CAPSTAN_CHECKER_MOTION_H

#include "record.h"

/* What contradicts the claim, or NULL; *power is the least power that nothing can take, as far as
 * it was found [N]. */
const char *motion_contradiction(const Source *source, const Record *record, double *power);

#endif
