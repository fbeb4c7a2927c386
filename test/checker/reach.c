/* SPDX-License-Identifier: BSD-3-Clause */
/* The claim "too short to reach round an obstacle", by a search for the shortest path.
 *
 * Nodes lie outside the radius R, so an element of length l has at most a chord c <= l inside it,
 * and an element that is kept out of a smaller radius has no longer chord than that leaves. Each
 * chord spans the arc 2 R asin(c/(2 R)) on its side. With q the least chord per arc, a line is as
 * long at least as what it goes outside the circle plus q times the arcs that its chords span. The
 * search goes over the points where it comes to the circle, seen from each end by an angle between
 * 0 and that of the tangent: distance to the point, less q times the arc that it saves. Along the
 * axis of a cylinder the two lengths add like the sides of a right angle. The turn about the axis
 * is counted by crossings of a half-plane: the line with what its ends go does not cross the
 * axis. */
#include "reach.h"

#include <math.h>

typedef Real Triple[3];

static Real dot(const Real *a, const Real *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* The ends where they shall be, in axes of the obstacle: u towards end A, v across it in the sense
 * of a positive turn, w along the axis of a cylinder. */
typedef struct Seen {
    const Surface *surface;
    Triple u, v, w;
    Real ra, rb, radius, angle, rise; /* the angle of end B */
} Seen;

static void from_middle(const Surface *s, const double *x, Real *out) {
    for (int k = 0; k < 3; k++) out[k] = (Real)x[k] - s->point[k];
}

/* Coordinates along u and v. */
static void flat(const Seen *seen, const double *x, Real out[2]) {
    Triple d;
    from_middle(seen->surface, x, d);
    out[0] = dot(d, seen->u);
    out[1] = dot(d, seen->v) + 0.0L; // no negative zero
}

static Seen look(const Surface *s, const Record *r) {
    Seen seen = {.surface = s};
    Triple a, b;
    from_middle(s, r->held_position[0], a);
    from_middle(s, r->held_position[1], b);
    if (s->kind == SURFACE_CYLINDER) {
        const Real down = dot(a, s->axis), up = dot(b, s->axis);
        seen.rise = up - down;
        for (int k = 0; k < 3; k++) {
            seen.w[k] = s->axis[k];
            a[k] -= down * s->axis[k];
            b[k] -= up * s->axis[k];
        }
    }
    seen.ra = sqrtl(dot(a, a));
    seen.rb = sqrtl(dot(b, b));
    for (int k = 0; k < 3; k++) seen.u[k] = a[k] / seen.ra;
    if (s->kind == SURFACE_CYLINDER) {
        for (int k = 0; k < 3; k++)
            seen.v[k] = seen.w[(k + 1) % 3] * seen.u[(k + 2) % 3] -
                        seen.w[(k + 2) % 3] * seen.u[(k + 1) % 3];
    } else { // across u towards B
        for (int k = 0; k < 3; k++) seen.v[k] = b[k] - dot(b, seen.u) * seen.u[k];
        const Real size = sqrtl(dot(seen.v, seen.v));
        for (int k = 0; k < 3; k++) seen.v[k] = size > 0 ? seen.v[k] / size : 0;
    }
    seen.radius = fminl(s->radius, fminl(seen.ra, seen.rb));
    seen.angle = atan2l(dot(b, seen.v) + 0.0L, dot(b, seen.u));
    return seen;
}

/* Does the straight way from p to q come nearer to the axis than a quarter of the radius?  Else
 * *turns counts its crossing of the half-plane of -u. */
static bool loses_side(const Real *p, const Real *q, Real radius, int *turns) {
    const Real d[2] = {q[0] - p[0], q[1] - p[1]}, square = d[0] * d[0] + d[1] * d[1];
    const Real t = square > 0 ? fminl(1, fmaxl(0, -(p[0] * d[0] + p[1] * d[1]) / square)) : 0;
    if (!(hypotl(p[0] + t * d[0], p[1] + t * d[1]) >= radius / 4)) return true;
    const bool above = p[1] >= 0, after = q[1] >= 0;
    if (above != after && p[0] + d[0] * (p[1] / (p[1] - q[1])) < 0) *turns += above ? 1 : -1;
    return false;
}

/* The least of distance to a point of the circle less q times the arc up to it, from the distance
 * r. */
static Real approach(Real r, Real radius, Real q) {
    Real low = 0, high = r > radius ? acosl(radius / r) : 0, value[2];
    for (int i = 0; i < 200; i++) {
        const Real at[2] = {low + (high - low) / 3, high - (high - low) / 3};
        for (int k = 0; k < 2; k++) {
            const Real half = sinl(at[k] / 2); // r^2 + R^2 - 2 r R cos without cancellation
            value[k] = sqrtl((r - radius) * (r - radius) + 4 * r * radius * half * half) -
                       q * radius * at[k];
        }
        if (value[0] < value[1])
            high = at[1];
        else
            low = at[0];
    }
    return r > radius ? fminl(value[0], value[1]) : 0;
}

/* The least chord per arc of any element; 0: one may lie on both sides. */
static Real least_share(const Source *source, const Record *r, const Seen *seen) {
    Real least = 1;
    for (size_t i = 0; i < r->elements; i++) {
        const Real l = r->element_length[i], R = seen->radius;
        const bool kept = r->has_elements && !source->touching_only;
        const Real inner = kept ? seen->surface->radius - surface_allowance(seen->surface, l) : 0;
        if (!kept && l >= 2 * R) return 0;
        const Real chord = fminl(l, inner < R ? 2 * sqrtl(R * R - inner * inner) : 0),
                   arc = 2 * R * asinl(fminl(1, chord / (2 * R)));
        if (chord > 0) least = fminl(least, chord / arc);
    }
    return least;
}

const char *reach_contradiction(const Source *source, const Record *r, bool statics,
                                double *missing, double *off) {
    if (r->proof_obstacle < 0 || r->proof_obstacle >= (int)source->surfaces)
        return "its obstacle is unknown";
    const Surface *s = &source->surface[r->proof_obstacle];
    if (!surface_is_round(s)) return "its obstacle is a plane";
    if (s->gives > 0) return "its obstacle gives, and keeps no line out";
    if (r->end_kind[0] != END_HELD || r->end_kind[1] != END_HELD) return "an end is free";
    if (source->touching_only && !statics)
        return "contact is that of the reference and keeps the line out of nothing";
    if (r->substeps != 1) return "it is of a substep";
    const Seen seen = look(s, r);
    Real turn = fabsl(seen.angle), length = 0;
    int turns = 0;
    if (s->kind == SURFACE_CYLINDER && !statics) {
        Real at[2], next[2];
        flat(&seen, r->held_position[0], at);
        for (size_t j = 0; j <= r->nodes; j++) {
            flat(&seen, j < r->nodes ? r->reference[j] : r->held_position[1], next);
            if (loses_side(at, next, s->radius, &turns)) return "the line lies across the axis";
            at[0] = next[0];
            at[1] = next[1];
        }
        turn = atan2l(next[1], next[0]) +
               turns * 2 * acosl(-1); // the coordinates whose signs were counted
    }
    const Real sense = turn < 0 ? -1 : 1, q = least_share(source, r, &seen), R = seen.radius;
    if (!(q > 0)) return "an element is long enough to lie across the obstacle";
    if (!(sense * turn > acosl(R / seen.ra) + acosl(R / seen.rb)))
        return "the obstacle is not in the way";
    const Real level = approach(seen.ra, R, q) + approach(seen.rb, R, q) + q * R * sense * turn,
               path = hypotl(level, seen.rise);
    for (size_t i = 0; i < r->elements; i++) length += r->element_length[i];
    *missing = (double)(path - length);
    *off = 0;
    if (!(path > length)) return "the line is long enough";
    const Real onward = R / seen.ra, inward = sqrtl(fmaxl(0, 1 - onward * onward));
    const bool opposite =
        s->kind == SURFACE_SPHERE && sinl(seen.angle) < 1e-9L; // any way is as long
    for (int k = 0; k < 3; k++) {
        Real expected =
            (level * (sense * onward * seen.v[k] - inward * seen.u[k]) + seen.rise * seen.w[k]) /
            path;
        if (!opposite) *off = fmax(*off, fabs((double)(expected - r->proof[k])));
    }
    return NULL;
}
