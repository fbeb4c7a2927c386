/* SPDX-License-Identifier: BSD-3-Clause */
/* The claim "an element too long to go round an obstacle", by a point that every place of the
 * element has inside.
 *
 * The nodes of the element lie in two balls: about end A with the length of the elements before it
 * for a radius, about end B with that of the elements after it. The point that divides the element
 * in the ratio t : 1 - t then lies in the ball about the point that divides AB so, its radius
 * divided likewise. Where that ball lies wholly within the distance from the axis or centre that
 * elements must keep, the element cannot keep it. The search goes over t by grids, each about the
 * best point of the one before. */
#include "long_element.h"

#include <math.h>

enum { GRID = 400, GRIDS = 6 };

/* Distance from the axis or centre of the farthest point of the ball at the ratio t. */
static Real outermost(const Surface *s, const Record *r, Real before, Real after, Real t) {
    Real x[3], along = 0, square = 0;
    for (int k = 0; k < 3; k++) {
        x[k] = (1 - t) * r->held_position[0][k] + t * r->held_position[1][k] - s->point[k];
        along += x[k] * s->axis[k];
    }
    for (int k = 0; k < 3; k++) {
        if (s->kind == SURFACE_CYLINDER) x[k] -= along * s->axis[k];
        square += x[k] * x[k];
    }
    return sqrtl(square) + (1 - t) * before + t * after;
}

static Real least_outermost(const Surface *s, const Record *r, Real before, Real after) {
    Real best = 0.5L, width = 0.5L, least = INFINITY;
    for (int grid = 0; grid < GRIDS; grid++, width *= 2.0L / GRID) {
        const Real middle = best;
        for (int i = -GRID; i <= GRID; i++) {
            const Real t = fminl(1, fmaxl(0, middle + width * i / GRID)),
                       value = outermost(s, r, before, after, t);
            if (value < least) {
                least = value;
                best = t;
            }
        }
    }
    return least;
}

const char *long_element_contradiction(const Source *source, const Record *r, double *deep) {
    if (r->proof_obstacle < 0 || r->proof_obstacle >= (int)source->surfaces)
        return "its obstacle is unknown";
    const Surface *s = &source->surface[r->proof_obstacle];
    if (!surface_is_round(s)) return "its obstacle is a plane";
    if (s->gives > 0) return "its obstacle gives, and keeps no line out";
    if (r->end_kind[0] != END_HELD || r->end_kind[1] != END_HELD) return "an end is free";
    if (source->touching_only || !r->has_elements) return "elements are not kept out of obstacles";
    if (r->substeps != 1) return "it is of a substep";
    Real total = 0, before = 0;
    for (size_t i = 0; i < r->elements; i++) total += r->element_length[i];
    *deep = -INFINITY;
    for (size_t i = 0; i < r->elements; i++) {
        const double l = r->element_length[i];
        const Real kept = s->radius - surface_allowance(s, l), after = fmaxl(0, total - before - l);
        *deep = fmax(*deep, (double)(kept - least_outermost(s, r, before, after)));
        before += l;
    }
    return *deep > 0 ? NULL : "every element can go round the obstacle";
}
