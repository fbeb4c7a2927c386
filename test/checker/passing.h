/* SPDX-License-Identifier: BSD-3-Clause */
/* Whether a line that goes straight from its reference to its position passes an obstacle. */
#ifndef CAPSTAN_CHECKER_PASSING_H
#define CAPSTAN_CHECKER_PASSING_H

#include "record.h"

/* What is wrong about the way of a record that claims to pass obstacle proof_obstacle, or to be
 * solved; or NULL. What is solved must not pass an obstacle where friction and contact are those of
 * the reference, unless it was `laid` by statics; all else is led round obstacles. */
const char *passing_contradiction(const Source *source, const Record *record, bool laid);

#endif
