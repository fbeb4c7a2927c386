/* SPDX-License-Identifier: BSD-3-Clause */
/* Capsules, tori, cones, boxes, and insides (shape.h).
 *
 * The nearest point c of a core is found from the definition of each core: of a box coordinate by
 * coordinate, of what is round about an axis in the half-plane through x. The way between two feet
 * c + r e, with e turning by b in a plane: let m be the tangent in it halfway. The two stretches of
 * c along the tangents at e and e' both make the angle b/2 with m, so that they are together
 * (c' - c).m/cos(b/2) long. */
#include "shape.h"

#include <math.h>

static Real dot(const Real *a, const Real *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static Real size(const Real *a) { return sqrtl(dot(a, a)); }

static void cross(const Real *a, const Real *b, Real *out) {
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

bool shape_is(const Surface *s) {
    return s->inside || s->kind == SURFACE_CAPSULE || s->kind == SURFACE_TORUS ||
           s->kind == SURFACE_CONE || s->kind == SURFACE_BOX;
}

/* c and e of a point, and its distance from the core, negative inside. */
typedef struct Foot {
    Real core[3], out[3], distance;
} Foot;

/* In the half-plane at the distance `across` from the axis and `along` it. */
static void in_half_plane(const Surface *s, Real across, Real along, Real core[2], Real out[2],
                          Real *distance) {
    core[0] = core[1] = 0;
    if (s->kind == SURFACE_CYLINDER) core[1] = along;
    if (s->kind == SURFACE_CAPSULE) core[1] = fmaxl(-s->length / 2, fminl(s->length / 2, along));
    if (s->kind == SURFACE_TORUS) core[0] = s->main_radius;
    if (s->kind == SURFACE_CONE) { /* nearest of the ray from the tip of the core */
        const Real ray[2] = {sinl(s->angle), cosl(s->angle)},
                   on = fmaxl(0, across * ray[0] + (along - s->radius) * ray[1]);
        core[0] = on * ray[0];
        core[1] = s->radius + on * ray[1];
        if (on > 0) {
            out[0] = ray[1];
            out[1] = -ray[0];
            *distance = (across - core[0]) * out[0] + (along - core[1]) * out[1];
            return;
        }
    }
    *distance = hypotl(across - core[0], along - core[1]);
    out[0] = *distance > 0 ? (across - core[0]) / *distance : 1;
    out[1] = *distance > 0 ? (along - core[1]) / *distance : 0;
}

static Foot foot_of_round(const Surface *s, const Real *arm) {
    Foot foot;
    Real radial[3], core[2], out[2];
    const Real along = dot(arm, s->axis);
    for (int k = 0; k < 3; k++) radial[k] = arm[k] - along * s->axis[k];
    const Real across = size(radial);
    in_half_plane(s, across, along, core, out, &foot.distance);
    for (int k = 0; k < 3; k++) {
        const Real away = across > 0 ? radial[k] / across : 0;
        foot.core[k] = core[0] * away + core[1] * s->axis[k];
        foot.out[k] = out[0] * away + out[1] * s->axis[k];
    }
    return foot;
}

static Foot foot_of_box(const Surface *s, const Real *arm) {
    Foot foot = {.distance = 0};
    Real edge[3][3], over[3], least = INFINITY;
    int face = 0;
    for (int k = 0; k < 3; k++) {
        edge[0][k] = s->side[k];
        edge[2][k] = s->axis[k];
    }
    cross(edge[2], edge[0], edge[1]);
    for (int i = 0; i < 3; i++) {
        const Real at = dot(arm, edge[i]), most = s->size[i] / 2 - s->radius,
                   kept = fmaxl(-most, fminl(most, at));
        over[i] = at - kept;
        if (most - fabsl(at) < least) {
            least = most - fabsl(at);
            face = i;
        }
        for (int k = 0; k < 3; k++) foot.core[k] += kept * edge[i][k];
    }
    foot.distance = size(over);
    if (foot.distance > 0) {
        for (int k = 0; k < 3; k++)
            foot.out[k] = (over[0] * edge[0][k] + over[1] * edge[1][k] + over[2] * edge[2][k]) /
                          foot.distance;
        return foot;
    }
    const Real sign = dot(arm, edge[face]) < 0 ? -1 : 1; /* in the core: to the nearest face */
    foot.distance = -least;
    for (int k = 0; k < 3; k++) {
        foot.out[k] = sign * edge[face][k];
        foot.core[k] = arm[k] + least * foot.out[k];
    }
    return foot;
}

static Foot foot_of(const Surface *s, const Real *x) {
    const Real arm[3] = {x[0] - s->point[0], x[1] - s->point[1], x[2] - s->point[2]};
    return s->kind == SURFACE_BOX ? foot_of_box(s, arm) : foot_of_round(s, arm);
}

Real shape_distance(const Surface *s, const Real *x, Real *normal) {
    const Foot foot = foot_of(s, x);
    const Real sign = s->inside ? -1 : 1;
    for (int k = 0; k < 3 && normal; k++) normal[k] = sign * foot.out[k];
    return sign * (foot.distance - s->radius);
}

void shape_slip(const Surface *s, const Real *from, const Real *to, Real *out) {
    const Foot a = foot_of(s, from), b = foot_of(s, to);
    Real way[3], less[3], sum[3], pole[3], last[3], halfway[3];
    for (int k = 0; k < 3; k++) {
        way[k] = b.core[k] - a.core[k];
        less[k] = b.out[k] - a.out[k];
        sum[k] = b.out[k] + a.out[k];
    }
    const Real turn = 2 * atan2l(size(less), size(sum));
    cross(a.out, b.out, pole);
    const Real sine = size(pole);
    if (sine < 1e-10L) { /* the plane of the turn is rounding, the turn itself its chord */
        for (int k = 0; k < 3; k++) way[k] += s->radius * less[k];
        for (int k = 0; k < 3; k++) out[k] = way[k] - dot(way, b.out) * b.out[k];
        return;
    }
    for (int k = 0; k < 3; k++) pole[k] /= sine;
    cross(pole, b.out, last);
    cross(pole, sum, halfway);
    const Real in_plane = dot(way, halfway) / size(halfway) / cosl(turn / 2) + s->radius * turn,
               beside = dot(way, pole);
    for (int k = 0; k < 3; k++) out[k] = in_plane * last[k] + beside * pole[k];
}

/* How fast the distance grows along the way from a to b, at a share of it. */
static Real growth(const Surface *s, const Real *a, const Real *b, Real share) {
    Real x[3], n[3], along[3];
    for (int k = 0; k < 3; k++) {
        along[k] = b[k] - a[k];
        x[k] = a[k] + share * along[k];
    }
    shape_distance(s, x, n);
    return dot(n, along);
}

static Real distance_at(const Surface *s, const Real *a, const Real *b, Real share) {
    Real x[3];
    for (int k = 0; k < 3; k++) x[k] = a[k] + share * (b[k] - a[k]);
    return shape_distance(s, x, NULL);
}

bool shape_facing(const Surface *s, const Real *a, const Real *b, Real *share) {
    enum { PARTS = 256 };
    Real low = 0, high = 1;
    if (s->inside && s->kind != SURFACE_TORUS) return false; /* what is between is farther inside */
    if (s->kind == SURFACE_TORUS) {
        int nearest = 0;
        Real least = INFINITY;
        for (int i = 0; i <= PARTS; i++) {
            const Real here = distance_at(s, a, b, (Real)i / PARTS);
            if (here < least) {
                least = here;
                nearest = i;
            }
        }
        low = fmaxl(0, nearest - 1) / PARTS;
        high = fminl(PARTS, nearest + 1) / PARTS;
    }
    if (!(growth(s, a, b, low) < 0 && growth(s, a, b, high) > 0)) return false;
    for (int i = 0; i < 80; i++) {
        const Real middle = (low + high) / 2;
        if (growth(s, a, b, middle) < 0)
            low = middle;
        else
            high = middle;
    }
    *share = (low + high) / 2;
    return true;
}
