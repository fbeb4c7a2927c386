/* SPDX-License-Identifier: BSD-3-Clause */
/* Ground and surfaces given as functions (shape.h; docs/theory.md 2.3): psi(x) >= 0, psi smooth.
 *
 * psi is no distance. The distance of x is taken as g = psi/|grad psi| at x, which is right to
 * first order near the surface and exact on it, the normal as that of the level of psi through x,
 * and the foot as x - g n. For a plane all three are exact. Far above a surface they have one value
 * each, where the nearest point has not. The way between two feet is that of an arc that turns by
 * the angle between the normals: exact on planes and spheres, elsewhere to second order. */
#include <math.h>

#include "geometry/ground.h"
#include "geometry/shape.h"

/* Corrections after which a point is on its level of psi, and its foot is found. */
enum { CORRECTIONS = 40, FOOT = 60 };
/* Places at which a path is examined at most. */
enum { PLACES = 2000 };
/* [-] A correction smaller than this, relative to the places, is rounding. */
static const double ROUNDING = 4e-16;
/* [-] Share of the size by which a gradient is displaced for second derivatives: the cube root of
 * the rounding of a number. */
static const double DIFFERENCE = 6e-6;
/* [rad] Below this an arc is its chord to the last digit. */
static const double STRAIGHT = 1e-8;

typedef struct Level {
    double psi;
    Vec3 gradient;
    double size; /* of the gradient */
} Level;

static Level level_at(const CpsiObstacle *o, Vec3 x) {
    const Vec3 at = vec3_sub(x, o->frame.point);
    Level out;
    if (o->ground) {
        const CpsiHeight f = cpsi_ground_height(o->ground, at.x, at.y);
        out.psi = at.z - f.z;
        out.gradient = vec3(-f.x, -f.y, 1);
    } else {
        const double place[3] = {at.x, at.y, at.z};
        double gradient[3] = {0, 0, 0};
        out.psi = o->surface.function(o->surface.user, place, gradient);
        out.gradient = vec3_load(gradient);
    }
    out.size = vec3_norm(out.gradient);
    if (isfinite(out.psi) && isfinite(out.size) && out.size > 0) return out;
    /* no value: as if deep inside, so that nothing here is certified */
    return (Level){-o->radius, vec3(0, 0, 1), 1};
}

static double gap(const CpsiObstacle *o, Vec3 x) {
    const Level at = level_at(o, x);
    return at.psi / at.size;
}

static Vec3 normal(const CpsiObstacle *o, Vec3 x) {
    const Level at = level_at(o, x);
    return vec3_scale(1 / at.size, at.gradient);
}

/* The foot of x to first order, and the normal there. */
static Vec3 first_foot(const CpsiObstacle *o, Vec3 x, Vec3 *n) {
    const Level at = level_at(o, x);
    *n = vec3_scale(1 / at.size, at.gradient);
    return vec3_axpy(-at.psi / at.size, *n, x);
}

/* The nearest point of the surface: onto it, and along it until x is above. */
static Vec3 nearest_point(const CpsiObstacle *o, Vec3 x) {
    Vec3 n, y = first_foot(o, x, &n);
    for (int i = 0; i < FOOT; i++) {
        const Vec3 along = vec3_reject(vec3_sub(x, y), n);
        const Vec3 next = first_foot(o, vec3_add(y, along), &n);
        const double moved = vec3_norm(vec3_sub(next, y));
        y = next;
        if (moved <= ROUNDING * (vec3_norm(y) + o->radius)) break;
    }
    return y;
}

static double depth(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    const Vec3 way = vec3_sub(to, from);
    const double steps = ceil(vec3_norm(way) / o->radius);
    const int count = steps < PLACES ? (steps > 1 ? (int)steps : 1) : PLACES;
    Vec3 deepest = from;
    double least = gap(o, from);
    for (int i = 1; i <= count; i++) {
        const Vec3 x = vec3_axpy((double)i / count, way, from);
        const double here = gap(o, x);
        if (!(here < least)) continue;
        least = here;
        deepest = x;
    }
    const double distance = vec3_norm(vec3_sub(deepest, nearest_point(o, deepest)));
    return least < 0 ? fmin(-least, distance) : -least;
}

/* Second derivatives of psi along the tangents t and b. */
static void second(const CpsiObstacle *o, Vec3 x, Vec3 t, Vec3 b, double out[3]) {
    if (o->ground) {
        const Vec3 at = vec3_sub(x, o->frame.point);
        const CpsiHeight f = cpsi_ground_height(o->ground, at.x, at.y);
        const double ht[2] = {f.xx * t.x + f.xy * t.y, f.xy * t.x + f.yy * t.y};
        out[0] = -(ht[0] * t.x + ht[1] * t.y);
        out[1] = -(ht[0] * b.x + ht[1] * b.y);
        out[2] = -((f.xx * b.x + f.xy * b.y) * b.x + (f.xy * b.x + f.yy * b.y) * b.y);
        return;
    }
    const double h = DIFFERENCE * o->radius;
    const Vec3 along = vec3_sub(level_at(o, vec3_axpy(h, t, x)).gradient,
                                level_at(o, vec3_axpy(-h, t, x)).gradient),
               across = vec3_sub(level_at(o, vec3_axpy(h, b, x)).gradient,
                                 level_at(o, vec3_axpy(-h, b, x)).gradient);
    out[0] = vec3_dot(along, t) / (2 * h);
    out[1] = (vec3_dot(along, b) + vec3_dot(across, t)) / (4 * h);
    out[2] = vec3_dot(across, b) / (2 * h);
}

static void curvature(const CpsiObstacle *o, Vec3 x, Vec3 t, Vec3 b, double out[3]) {
    const double size = level_at(o, x).size;
    second(o, x, t, b, out);
    for (int k = 0; k < 3; k++) out[k] /= size;
}

static Vec3 move(const CpsiObstacle *o, Vec3 x, Vec3 u) {
    const Level at = level_at(o, x);
    const double height = at.psi / at.size + vec3_dot(u, at.gradient) / at.size;
    Vec3 y = vec3_add(x, u);
    for (int i = 0; i < CORRECTIONS; i++) {
        const Level there = level_at(o, y);
        const double off = height - there.psi / there.size;
        if (!(fabs(off) > ROUNDING * (vec3_norm(y) + o->radius))) break;
        y = vec3_axpy(off / there.size, there.gradient, y);
    }
    return y;
}

/* [rad] Between two unit vectors, 0 to pi. */
static double angle(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    (void)o;
    return atan2(vec3_norm(vec3_cross(from, to)), vec3_dot(from, to));
}

static Vec3 slip(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    Vec3 n0, n1;
    const Vec3 a = first_foot(o, from, &n0), chord = vec3_sub(first_foot(o, to, &n1), a);
    const Vec3 flat = vec3_reject(chord, n1);
    const double half = 0.5 * angle(o, n0, n1), size = vec3_norm(flat);
    if (!(size > 0)) return vec3(0, 0, 0);
    const double arc = half > STRAIGHT ? half / sin(half) : 1;
    return vec3_scale(arc * vec3_norm(chord) / size, flat);
}

static double range(const CpsiObstacle *o, Vec3 x) {
    const Vec3 n = normal(o, x), seed = fabs(n.x) <= 0.75 ? vec3(1, 0, 0) : vec3(0, 1, 0),
               across = vec3_cross(n, seed), b = vec3_scale(1 / vec3_norm(across), across);
    double k[3];
    curvature(o, x, vec3_cross(b, n), b, k);
    const double bent = sqrt(k[0] * k[0] + 2 * k[1] * k[1] + k[2] * k[2]);
    return bent > 0 ? 1 / bent + fmax(0, gap(o, x)) : INFINITY;
}

const CpsiShapeTable cpsi_shape_smooth = {gap, depth, normal, curvature, move, slip, angle, range};
