/* SPDX-License-Identifier: BSD-3-Clause */
/* The claim "caught between a ball and a plane".
 *
 * A half-line goes from the ball's surface outwards. Below it, as far down as the plane, there is
 * a window, of which the line passes through: its elements cross the window once more in one sense
 * than in the other. What no motion can change, unless the line crosses the half-line, or an end
 * the window; for the rest of the window's edge is in the ball, where elements do not come, or
 * below the plane. A line whose nodes are outside the ball and whose elements cut no deeper than
 * they may is as long, at least, as a curve outside the ball the parts of which on the ball count q
 * times, q the least chord per arc. So it goes from an end to a direction, seen from the centre at
 * the angle W, by no less than the least over the points where it comes to the ball, at angles up
 * to that of the tangent, of the distance to that point and q times the rest of the arc.
 *
 * Both lengths together, over the window with the ends where they shall be, and over the half-line
 * with the ends anywhere on their way, change by no more than 2 q R per radian, or than the ends
 * move. So each search advances by what is left above the length of the line, and overlooks
 * nothing. */
#include "caught.h"

#include <math.h>

/* Positions looked at before a search is given up; places of a certified line, in its length. */
enum { POSITIONS = 200000 };
static const Real PLACE = 1e-9L;

typedef Real Triple[3];

static Real dot(const Real *a, const Real *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static Real size(const Real *a) { return sqrtl(dot(a, a)); }

typedef struct Window {
    const Surface *ball, *plane;
    Triple out, side;      /* the half-line; across the plane's normal, in the plane of both */
    Triple from[2], to[2]; /* the ends on their way, from the centre */
    Real top, bottom; /* [rad] the half-line and the lower edge, above the level of the centre */
    Real q, length;
} Window;

/* The least length from x to the direction e on the ball, or 0 where an end is not at least a right
 * angle away. */
static Real piece(const Window *w, const Real *x, const Real *e) {
    const Real r = size(x), radius = fminl(w->ball->radius, r), cosine = dot(x, e) / r;
    if (cosine > 0) return 0;
    const Real whole = acosl(fmaxl(-1, cosine));
    Real low = 0, high = acosl(radius / r), least = INFINITY;
    for (int i = 0; i < 200; i++) {
        const Real at[2] = {low + (high - low) / 3, high - (high - low) / 3};
        Real value[2];
        for (int k = 0; k < 2; k++) {
            const Real half = sinl(at[k] / 2);
            value[k] = sqrtl((r - radius) * (r - radius) + 4 * r * radius * half * half) +
                       w->q * radius * (whole - at[k]);
            least = fminl(least, value[k]);
        }
        if (value[0] < value[1])
            high = at[1];
        else
            low = at[0];
    }
    return least;
}

/* ... of both pieces, in the window's direction at an angle above the level, with the ends at a
 * share of their way. */
static Real least_length(const Window *w, Real angle, Real share) {
    Triple e, x;
    Real sum = 0;
    for (int k = 0; k < 3; k++) e[k] = cosl(angle) * w->side[k] + sinl(angle) * w->plane->axis[k];
    for (int end = 0; end < 2; end++) {
        for (int k = 0; k < 3; k++)
            x[k] = w->from[end][k] + share * (w->to[end][k] - w->from[end][k]);
        const Real part = piece(w, x, e);
        if (part == 0) return 0;
        sum += part;
    }
    return sum;
}

/* The least surplus over the window with the ends at the end of their way; 0: none, or the search
 * was given up. */
static Real surplus_in_window(const Window *w) {
    Real least = INFINITY, angle = w->top;
    for (int i = 0; i < POSITIONS; i++) {
        const Real surplus = least_length(w, angle, 1) - w->length;
        if (!(surplus > 0) || least_length(w, angle, 0) == 0) return 0;
        least = fminl(least, surplus);
        if (angle <= w->bottom) return least;
        angle = fmaxl(w->bottom, angle - surplus / (2 * w->q * w->ball->radius));
    }
    return 0;
}

/* Does the line not reach across the half-line, wherever its ends are on their way? */
static bool half_line_holds(const Window *w) {
    Real speed = 0, share = 0;
    for (int end = 0; end < 2; end++) {
        Triple u;
        for (int k = 0; k < 3; k++) u[k] = w->to[end][k] - w->from[end][k];
        speed += size(u);
    }
    for (int i = 0; i < POSITIONS; i++) {
        const Real surplus = least_length(w, w->top, share) - w->length;
        if (!(surplus > 0)) return false;
        if (share >= 1) return true;
        share = surplus < speed * (1 - share) ? share + surplus / speed : 1;
    }
    return false;
}

/* Crossings of the window by the elements of the reference, those in one sense less the others. */
static int crossings(const Window *w, const Record *r) {
    int count = 0;
    Triple before = {0}, normal;
    const Real *up = w->plane->axis;
    for (int k = 0; k < 3; k++)
        normal[k] = up[(k + 1) % 3] * w->side[(k + 2) % 3] - up[(k + 2) % 3] * w->side[(k + 1) % 3];
    for (size_t j = 0; j < r->nodes; j++) {
        Triple x;
        for (int k = 0; k < 3; k++) x[k] = (Real)r->reference[j][k] - w->ball->point[k];
        const Real s = dot(before, normal), t = dot(x, normal);
        if (j > 0 && (s < 0) != (t < 0)) {
            Real along = 0, above = 0;
            for (int k = 0; k < 3; k++) {
                const Real at = (before[k] * t - x[k] * s) / (t - s);
                along += at * w->side[k];
                above += at * up[k];
            }
            if (along > 0 && atan2l(above, along) < w->top) count += s < 0 ? 1 : -1;
        }
        for (int k = 0; k < 3; k++) before[k] = x[k];
    }
    return count;
}

/* Is the reference a configuration: nodes outside ball and plane, elements no deeper in the ball
 * and no longer than they may? */
static bool is_configuration(const Window *w, const Record *r) {
    const Real place = PLACE * w->length;
    for (size_t j = 0; j < r->nodes; j++) {
        Triple x, before, chord;
        for (int k = 0; k < 3; k++) x[k] = r->reference[j][k];
        if (!(surface_distance(w->ball, x) >= -place && surface_distance(w->plane, x) >= -place))
            return false;
        if (j == 0) continue;
        const Real l = r->element_length[j - 1];
        for (int k = 0; k < 3; k++) before[k] = r->reference[j - 1][k];
        for (int k = 0; k < 3; k++) chord[k] = x[k] - before[k];
        if (!(size(chord) <= l * (1 + PLACE) + 1e-15L * (size(x) + size(before)) &&
              surface_pierced(w->ball, before, x, l) <= place))
            return false;
    }
    return true;
}

/* The window below the half-line of the proof; false where the ball does not dip into the plane
 * with its lower half deeper than elements into the ball. */
static bool open_window(const Source *source, const Record *r, Window *w) {
    Real deepest = 0, along = 0;
    *w = (Window){.ball = &source->surface[r->proof_obstacle],
                  .plane = &source->surface[r->proof_plane],
                  .q = 1};
    for (size_t i = 0; i < r->elements; i++)
        deepest = fmaxl(deepest, surface_allowance(w->ball, r->element_length[i]));
    const Real inner = w->ball->radius - deepest;
    for (size_t i = 0; i < r->elements; i++) {
        const Real l = r->element_length[i], R = w->ball->radius,
                   half = fminl(l / 2, sqrtl((R - inner) * (R + inner))) / R;
        w->length += l;
        w->q = fminl(w->q, half / asinl(half));
    }
    for (int k = 0; k < 3; k++) {
        w->out[k] = r->proof[k];
        along += w->out[k] * w->plane->axis[k];
        for (int end = 0; end < 2; end++) {
            w->from[end][k] = r->reference[end ? r->nodes - 1 : 0][k] - w->ball->point[k];
            w->to[end][k] = r->held_position[end][k] - w->ball->point[k];
        }
    }
    for (int k = 0; k < 3; k++) w->side[k] = w->out[k] - along * w->plane->axis[k];
    const Real width = size(w->side), height = surface_distance(w->plane, w->ball->point);
    if (!(height >= 0 && height < inner && width > 0)) return false;
    for (int k = 0; k < 3; k++) w->side[k] /= width;
    w->top = atan2l(along, width);
    w->bottom = -asinl(height / inner);
    return w->bottom < w->top;
}

const char *caught_contradiction(const Source *source, const Record *r, double *missing) {
    Window w;
    if (r->proof_obstacle < 0 || r->proof_obstacle >= (int)source->surfaces || r->proof_plane < 0 ||
        r->proof_plane >= (int)source->surfaces)
        return "one of its obstacles is unknown";
    if (source->surface[r->proof_obstacle].kind != SURFACE_SPHERE) return "its obstacle is no ball";
    if (source->surface[r->proof_plane].kind != SURFACE_PLANE) return "its plane is none";
    if (source->surface[r->proof_obstacle].gives > 0 || source->surface[r->proof_plane].gives > 0)
        return "one of its obstacles gives, and keeps no line out";
    if (r->end_kind[0] != END_HELD || r->end_kind[1] != END_HELD) return "an end is free";
    if (source->touching_only || !r->has_elements) return "elements are not kept out of obstacles";
    const double one = hypot(hypot(r->proof[0], r->proof[1]), r->proof[2]);
    if (!(fabs(one - 1) <= 1e-12)) return "the half-line's direction is no unit vector";
    if (!open_window(source, r, &w)) return "the line can go below the ball";
    if (!is_configuration(&w, r)) return "where the step begins is no configuration";
    if (crossings(&w, r) == 0) return "the line does not lie between the ball and the plane";
    if (!half_line_holds(&w)) return "the line can get out";
    *missing = (double)surplus_in_window(&w);
    return *missing > 0 ? NULL : "the line is long enough";
}
