/* SPDX-License-Identifier: BSD-3-Clause */
/* The ledger of a body in a step in time, from forces, places and rotations of a file. */
#ifndef CAPSTAN_CHECKER_BODY_LEDGER_H
#define CAPSTAN_CHECKER_BODY_LEDGER_H

#include "joint_motion.h"

/* Body k of the file after a step and before it, with the lines of the step, and the gravity per
 * that of the scene. */
typedef struct BodyLedger {
    const Source *source;
    const Bodies *bodies;
    const Record *line; /* (lines) */
    const double *gravity;
    const BodyState *now, *before;
    size_t k;
} BodyLedger;

/* The rotation vector from one quaternion to another. */
void body_turn(const double from[FOUR], const double to[FOUR], Real out[3]);

/* [J] The work of lines, weight, water, load and support on body k; and the sizes of its terms. */
Real body_ledger_work(const BodyLedger *of, double *sizes);

#endif
