/* SPDX-License-Identifier: BSD-3-Clause */
/* A line that falls freely. */
#ifndef CAPSTAN_CHECKER_FALL_H
#define CAPSTAN_CHECKER_FALL_H

#include <stdbool.h>

#include "record.h"

/* Does the line, at its reference and from there on along v for ever, touch no obstacle of the
 * file? */
bool falls_clear(const Source *source, const Record *r, const Real *v);

/* Does v lead away from every obstacle, a plane, so steeply that no friction on it works against
 * that, wherever the line is and however large the reactions are? n.v >= mu |v_T| with the radius
 * mu of a disc that contains all coefficients. Frozen friction does not grow with the reactions:
 * there n.v >= 0 is enough, and *taken is the most that it can take. */
bool falls_off_planes(const Source *source, const Record *r, const Real *v, Real *taken);

#endif
