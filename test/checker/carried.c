/* SPDX-License-Identifier: BSD-3-Clause */
/* Where an obstacle has taken what the slip of a line is measured from (carried.h).
 *
 * Friction knows the velocity of a node relative to the matter of the obstacle. Let y be the place
 * of a node in that matter, told as the place where that matter is at the end of the step: y_{n+1}
 * is x_{n+1}, y_n is x_n carried along for the step, y_{n-1} is x_{n-1} carried along for both.
 * The velocity at the end of the parabola through these is (y_{n+1} - y*)/k, y* = y_n + b (y_n -
 * y_{n-1}), which is 0 of what has not moved on the obstacle. In a straight line y* is x* = x_n +
 * b (x_n - x_{n-1}) carried along for k; where the obstacle turns it is not, and the slip is from
 * y*. The obstacle goes on as in the step before wherever a step is by this formula. */
#include "carried.h"

#include <math.h>

#include "formula.h"
#include "inertia.h"

void carried_begin(Record *r, const Record *before, const Record *older) {
    r->start = r->past = NULL;
    r->length_before = 0;
    if (!before || !in_time(r) || !in_time(before)) return;
    r->start = (const Vector *)before->position;
    /* the first step of a file is one by the straight line, and its reference where it began */
    r->past = (const Vector *)(older ? older->position : before->reference);
    r->length_before = before->step_length;
}

static void point_of(const Vector *x, size_t i, Real t, Real *out) {
    for (int a = 0; a < 3; a++)
        out[a] = t == 0 ? (Real)x[i][a] : x[i][a] + t * ((Real)x[i + 1][a] - x[i][a]);
}

void carried_point(const Record *r, const Surface *on, Real turn, bool about_own, size_t i, Real t,
                   Real *out) {
    Real spin = turn * turn, from[3], last[3], first[3];
    const Real own = about_own ? turn : 0;
    for (int a = 0; a < 3; a++) spin += on->spin[a] * on->spin[a];
    const Real back = r->past ? formula_of(r->span[i], r->step_length, r->length_before).back : 0;
    if (!(spin > 0 && back > 0)) {
        point_of((const Vector *)r->reference, i, t, from);
        surface_carry(on, from, r->share, own, out);
        return;
    }
    point_of(r->start, i, t, from);
    surface_carry(on, from, 1, own, last);
    point_of(r->past, i, t, from);
    surface_carry(on, from, 1 + (Real)r->length_before / r->step_length, own, first);
    for (int a = 0; a < 3; a++) out[a] = last[a] + back * (last[a] - first[a]);
}
