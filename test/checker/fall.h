/* SPDX-License-Identifier: BSD-3-Clause */
/* A line that falls freely. */
#ifndef CAPSTAN_CHECKER_FALL_H
#define CAPSTAN_CHECKER_FALL_H

#include <stdbool.h>

#include "record.h"

/* Does the line, at its reference and from there on along v for ever, touch no obstacle of the
 * file? */
bool falls_clear(const Source *source, const Record *r, const Real *v);

#endif
