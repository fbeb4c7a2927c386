/* SPDX-License-Identifier: BSD-3-Clause */
/* Bends (bend.h). Two forces of a line and the action of a contact make a triangle. On the verge of
 * slipping the action is the angle of friction phi = atan(mu) away from the normal, and a line that
 * turns by d evenly to both sides of it meets it under 90 degrees less d/2 - phi on one side and
 * less d/2 + phi on the other, so that by the law of sines the forces are as cos(d/2 - phi) to
 * cos(d/2 + phi). From 90 degrees on they may have any ratio. */
#include "bend.h"

#include <math.h>

#include "elongation.h"
#include "measure.h"

/* What an element may lack of the length at which it has no tension, as a share of it, and count as
 * stretched. */
static const Real STRETCHED = 1e-9L;

static Real dot(const Real *a, const Real *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* unit vector of a force; false where it is too small to have a direction */
static bool unit(const double *force, Real least, Real *out) {
    for (int k = 0; k < 3; k++) out[k] = force[k];
    Real size = sqrtl(dot(out, out));
    if (!(size > least)) return false;
    for (int k = 0; k < 3; k++) out[k] /= size;
    return true;
}

/* Unit vector along element i: of its force or, where that is too small to have a
 * direction, of the element if it is stretched to its length, as any force in it would act so. */
static bool along_element(const Record *r, size_t i, Real least, Real *out) {
    double ahead[3];
    if (unit(r->segment_force[i], least, out)) return true;
    for (int k = 0; k < 3; k++) ahead[k] = r->position[i + 1][k] - r->position[i][k];
    const Real length = r->element_length[i] * (1 + elongation_rest(r, i));
    return unit(ahead, (1 - STRETCHED) * length, out);
}

/* angle of a direction above the tangent plane */
static Real above(const Real *e, const Real *n) {
    Real rise = dot(e, n), flat[3];
    for (int k = 0; k < 3; k++) flat[k] = e[k] - rise * n[k];
    return atan2l(rise, sqrtl(dot(flat, flat)));
}

/* The larger coefficient for a slip along the line, this way or that: what friction does against a
 * slip of 1 under a reaction of 1. */
static Real friction_along(const Surface *surface, const Real *n, const Real *line,
                           const Real *chord, Real factor) {
    Real axes[2][3], direction[2], most = 0, phi;
    static const Real none[2] = {0, 0};
    if (!surface_axes(surface, n, chord, axes)) return 0;
    for (int a = 0; a < 2; a++) direction[a] = dot(line, axes[a]);
    Real size = hypotl(direction[0], direction[1]);
    for (int sign = -1; sign <= 1; sign += 2) {
        const Real slip[2] = {size > 0 ? sign * direction[0] / size : sign,
                              size > 0 ? sign * direction[1] / size : 0};
        surface_gap(surface, factor * surface_friction(surface), none, slip, &phi);
        most = fmaxl(most, phi);
    }
    return most;
}

static Real ratio_of(Real turn, Real friction) {
    Real phi = atanl(friction), low = cosl(turn / 2 + phi);
    return low > 0 ? cosl(turn / 2 - phi) / low : INFINITY;
}

/* turn and coefficient at contact c of node j; no turn where there is no friction, or the obstacle
 * is flat */
static void bend_at(const Source *source, const Record *r, bool reached, size_t j, size_t c,
                    Real least, Real *turn, Real *friction) {
    *turn = *friction = 0;
    if (j == 0 || j == r->elements || !(r->reaction[c] > 0) || !(r->friction_bound[c] > 0)) return;
    const Surface *surface = &source->surface[source->surfaces > 1 ? (size_t)r->obstacle[c] : 0];
    Real before[3], after[3], n[3], line[3], chord[3], here[3], plane[3];
    Vector *place = reached ? r->position : r->reference;
    if (!surface_is_cut(surface) || !along_element(r, j - 1, least, before) ||
        !along_element(r, j, least, after))
        return;
    for (int k = 0; k < 3; k++) {
        n[k] = r->normal[c][k];
        line[k] = before[k] + after[k];
        chord[k] = (Real)place[j + 1][k] - place[j - 1][k];
        here[k] = place[j][k];
    }
    surface_normal(surface, here, plane);
    *turn = fmaxl(0, above(before, n) - above(after, n));
    if (*turn > 0)
        *friction = friction_along(surface, plane, line, chord, r->factor ? r->factor[j] : 1);
}

/* The same of the contact of element i. Its action is shared by the element's nodes, where the line
 * turns: with the force of the element and the two parts of the action the triangle is the one of a
 * node. */
static void bend_on(const Source *source, const Record *r, bool reached, size_t i, Real least,
                    Real *turn, Real *friction) {
    const size_t c = r->contacts * r->nodes + i;
    *turn = *friction = 0;
    if (!(r->obstacle[c] >= 0) || !(r->reaction[c] > 0) || !(r->friction_bound[c] > 0)) return;
    const Surface *surface = &source->surface[(size_t)r->obstacle[c]];
    if (surface_may_be_third(surface)) return; // the third contact of a node
    const Real t = r->share_of[i];
    Real before[3], after[3], n[3], line[3], chord[3], plane[3], place[3];
    double first[3], last[3];
    for (int k = 0; k < 3; k++) {
        n[k] = r->normal[c][k];
        const double action = r->reaction[c] * r->normal[c][k] + r->friction[c][k];
        first[k] = r->segment_force[i][k] + (1 - (double)t) * action;
        last[k] = r->segment_force[i][k] - (double)t * action;
        place[k] = (1 - t) * r->position[i][k] + t * r->position[i + 1][k];
    }
    if (!unit(first, least, before) || !unit(last, least, after)) return;
    for (int k = 0; k < 3; k++) line[k] = before[k] + after[k];
    measure_element_plane(r, surface, i, !reached, t, place, plane, chord);
    *turn = fmaxl(0, above(before, n) - above(after, n));
    const double factor =
        r->factor ? (1 - (double)t) * r->factor[i] + (double)t * r->factor[i + 1] : 1;
    if (*turn > 0) *friction = friction_along(surface, plane, line, chord, factor);
}

/* ln of the ratio of tensions at a turn, less friction times the turn. Its derivative by the turn d
 * is mu (1 + mu^2) t^2/(1 - mu^2 t^2), t = tan(d/2); of a small turn its integral by three points
 * of Gauss has no cancellation, and an error in d^7. */
static Real off_coulomb(Real turn, Real friction) {
    if (turn * (1 + friction) > 0.01L) return logl(ratio_of(turn, friction)) - friction * turn;
    const Real at[] = {-sqrtl(0.6L), 0, sqrtl(0.6L)}, weight[] = {5 / 18.0L, 8 / 18.0L, 5 / 18.0L};
    Real sum = 0;
    for (int k = 0; k < 3; k++) {
        const Real t = tanl(turn / 4 * (1 + at[k])), m = friction * friction;
        sum += weight[k] * friction * (1 + m) * t * t / (1 - m * t * t);
    }
    return turn * sum;
}

/* Is this bend, at `arc` of the line, the worst so far? */
static void take_bend(const Record *r, Real turn, Real friction, Real arc, Real length, Real *worst,
                      Bend *bend) {
    if (fabsl(arc - r->bend_at) <= 1e-12L * length) bend->there = fmax(bend->there, (double)turn);
    Real ratio = ratio_of(turn, friction), off = off_coulomb(turn, friction);
    // what locks counts before what is only far off
    if (isfinite(off) && ratio >= 19) off += 1e6L;
    if (!(off > *worst)) return;
    *worst = off;
    bend->turn = (double)turn;
    bend->friction = (double)friction;
    bend->ratio = (double)ratio;
}

Bend bend_of_record(const Source *source, const Record *r, bool reached, double largest_force) {
    Bend bend = {.ratio = 1};
    Real worst = 0, arc = 0, length = 0;
    for (size_t i = 0; i < r->elements; i++) length += r->element_length[i];
    for (size_t j = 0; j < r->nodes; arc += j < r->elements ? r->element_length[j] : 0, j++) {
        if (source->surfaces > 0)
            for (size_t c = j; c < r->contacts * r->nodes; c += r->nodes) {
                Real turn, friction;
                bend_at(source, r, reached, j, c, 1e-9L * largest_force, &turn, &friction);
                take_bend(r, turn, friction, arc, length, &worst, &bend);
            }
        if (!r->has_elements || j >= r->elements) continue;
        Real turn, friction;
        bend_on(source, r, reached, j, 1e-9L * largest_force, &turn, &friction);
        take_bend(r, turn, friction, arc + (Real)r->share_of[j] * r->element_length[j], length,
                  &worst, &bend);
    }
    return bend;
}
