/* SPDX-License-Identifier: BSD-3-Clause */
/* Capsules, tori, cones, boxes, and what lines are inside of, as the checker sees them: written
 * from docs/theory.md 2.3a. */
#ifndef CAPSTAN_CHECKER_SHAPE_H
#define CAPSTAN_CHECKER_SHAPE_H

#include <stddef.h>
#include <stdio.h>

#include "surface.h"

/* Read what the file says of the shape of obstacle k, whose kind, axis and radius are known. 0, or
 * -1 after one sentence on log. */
int shape_read(int nc, size_t k, Surface *surface, FILE *log);

/* Is the surface one of these? */
bool shape_is(const Surface *surface);
/* [m] above the surface on the side of the lines; `normal`, which may be NULL, points there. */
Real shape_distance(const Surface *surface, const Real *x, Real *normal);
/* The way between the feet of two points, as the tangent with which it arrives. */
void shape_slip(const Surface *surface, const Real *from, const Real *to, Real *out);
/* Where between a (0) and b (1) the straight way has the least distance; false: at an end. */
bool shape_facing(const Surface *surface, const Real *a, const Real *b, Real *share);

#endif
