/* SPDX-License-Identifier: BSD-3-Clause */
/* Whether a line that goes straight from its reference to its position passes an obstacle on the
 * way. */
#ifndef CAPSTAN_CHECKER_WAY_H
#define CAPSTAN_CHECKER_WAY_H

#include "record.h"

/* What is wrong about the way of a record that claims to pass obstacle proof_obstacle, or to be
 * solved; or NULL. What is solved must not pass an obstacle where friction and contact are those of
 * the reference, unless it was `laid` by statics; all else is led round obstacles. */
const char *way_contradiction(const Source *source, const Record *record, bool laid);

#endif
