/* SPDX-License-Identifier: BSD-3-Clause */
/* Passing an obstacle (passing.h), by the distance of an element from its axis or centre in time.
 *
 * The ends of an element go straight and at constant speed, u and v, while t goes from 0 to 1. Its
 * distance from a point or an axis changes by no more than max(|u|, |v|) per unit of t, since each
 * of its points goes by a mean of u and v. So from a distance d it takes at least
 * (d - near)/max(|u|, |v|) until the element is as near as `near`, and t can advance by that. An
 * element passes where it comes as near as half of the radius, or half of its distance before. */
#include "passing.h"

#include <math.h>

/* Parts of the nearest distance: the solver ends within two thousandths of it, and what is solved
 * must not be a hundredth nearer. */
static const Real CLAIMED = 1.003L, CLEARLY = 0.99L;
/* The least advance, as a part of `near`: what is nearer by less than this may be overlooked. */
static const Real ADVANCE = 1e-4L;

typedef Real Triple[3];

static Real dot(const Real *a, const Real *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static Real size(const Real *a) { return sqrtl(dot(a, a)); }

/* x relative to the axis or centre, at time t of its path. */
static void arm(const Surface *s, const double *from, const double *to, Real t, Real *out) {
    for (int k = 0; k < 3; k++) out[k] = (1 - t) * from[k] + t * to[k] - s->point[k];
    const Real along = s->kind == SURFACE_CYLINDER ? dot(out, s->axis) : 0;
    for (int k = 0; k < 3; k++) out[k] -= along * s->axis[k];
}

/* Distance of element i from the axis or centre at time t. */
static Real distance_at(const Surface *s, const Record *r, size_t i, Real t) {
    Triple a, b, chord;
    arm(s, r->reference[i], r->position[i], t, a);
    arm(s, r->reference[i + 1], r->position[i + 1], t, b);
    for (int k = 0; k < 3; k++) chord[k] = b[k] - a[k];
    const Real whole = dot(chord, chord), part = whole > 0 ? -dot(a, chord) / whole : 0;
    if (!(part > 0)) return size(a);
    if (part >= 1) return size(b);
    for (int k = 0; k < 3; k++) a[k] += part * chord[k];
    return size(a);
}

static Real travel(const Record *r, size_t j) {
    Triple u;
    for (int k = 0; k < 3; k++) u[k] = (Real)r->position[j][k] - (Real)r->reference[j][k];
    return size(u);
}

/* Does element i come as near to the surface's middle as this part of the nearest distance? */
static bool comes_near(const Surface *s, const Record *r, size_t i, Real part) {
    const Real speed = fmaxl(travel(r, i), travel(r, i + 1)),
               near = part * fminl(s->radius, distance_at(s, r, i, 0)) / 2;
    if (!(near > 0 && speed > 0)) return false;
    for (Real t = 0; t < 1;) {
        const Real distance = distance_at(s, r, i, t);
        if (distance <= near) return true;
        t += fmaxl(distance - near, ADVANCE * near) / speed;
    }
    return distance_at(s, r, i, 1) <= near;
}

static bool passes(const Surface *s, const Record *r, Real part) {
    if (!surface_is_round(s)) return false;
    for (size_t i = 0; i < r->elements; i++)
        if (comes_near(s, r, i, part)) return true;
    return false;
}

static const char *claim_contradiction(const Source *source, const Record *r) {
    if (!source->touching_only)
        return "passes an obstacle, but contact is not that of the reference";
    if (r->proof_obstacle < 0 || r->proof_obstacle >= (int)source->surfaces)
        return "passes an obstacle, but it does not say which";
    if (!passes(&source->surface[r->proof_obstacle], r, CLAIMED))
        return "passes an obstacle, but its path is clear of it";
    return NULL;
}

const char *passing_contradiction(const Source *source, const Record *r, bool laid) {
    if (r->outcome == OUTCOME_PASSES) return claim_contradiction(source, r);
    if (laid || !source->touching_only || !source->follows) return NULL;
    for (size_t k = 0; k < source->surfaces; k++)
        if (passes(&source->surface[k], r, CLEARLY)) return "certified, but it passes an obstacle";
    return NULL;
}
