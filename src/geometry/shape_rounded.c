/* SPDX-License-Identifier: BSD-3-Clause */
/* Capsule, torus, cone, box, and shapes with the lines inside of them (shape.h; docs/theory.md
 * 2.3a): what lies within the radius r of a core, which is a point, a straight line, a circle, a
 * sharp cone or a box. With c the point of the core that is nearest to x and e the direction from
 * there to x, the foot of x is c + r e. The distance is exact, and so is the normal.
 *
 * A way on such a surface is a way of c and a turn of e. Between two feet e turns by the angle b in
 * one plane, from tangent t0 to tangent t1. The part p of the way of c across that plane is kept.
 * Its part in the plane is taken as a first stretch along t0 and a second one along t1, which add
 * up to c1 - c0. So the way is a geodesic where the core is flat and the surface round it
 * developable (plane, cylinder, capsule, box across one edge), on spheres, and along the meridians
 * of capsules and cones; elsewhere it is one to second order in its length. */
#include <math.h>

#include "geometry/shape.h"

/* [rad] For directions this near to each other, or to opposite, rounding decides the plane in which
 * one turns into the other. */
static const double NEARLY = 1e-8;
/* Bisections at most, and parts of an element in which a distance that is not convex is examined.
 */
enum { HALVINGS = 200, MOST_PARTS = 64 };

/* Where x is, in the axes of the obstacle. */
typedef struct Seat {
    Vec3 core, out;   /* c and e */
    double distance;  /* of x from the core, negative inside a core that is solid */
    Vec3 tangent[2];  /* directions of the principal curvatures */
    double inverse_0; /* [1/m] curvature along the first tangent of a core that is curved */
    bool bent[2];     /* does e turn about the core along a tangent, with radius `distance`? */
} Seat;

static double component(Vec3 a, int i) { return i == 0 ? a.x : i == 1 ? a.y : a.z; }
static Vec3 with(Vec3 a, int i, double value) {
    return vec3(i == 0 ? value : a.x, i == 1 ? value : a.y, i == 2 ? value : a.z);
}

static Vec3 to_world(const CpsiObstacle *o, Vec3 v) {
    const Vec3 *axis = o->frame.axis;
    return vec3_axpy(v.x, axis[0], vec3_axpy(v.y, axis[1], vec3_scale(v.z, axis[2])));
}

static Vec3 to_own(const CpsiObstacle *o, Vec3 v) {
    const Vec3 *axis = o->frame.axis;
    return vec3(vec3_dot(v, axis[0]), vec3_dot(v, axis[1]), vec3_dot(v, axis[2]));
}

/* Away from the z axis; on it along x. */
static Vec3 radial(Vec3 q) {
    const double size = hypot(q.x, q.y);
    return size > 0 ? vec3(q.x / size, q.y / size, 0) : vec3(1, 0, 0);
}

static Vec3 any_across(Vec3 e) {
    const Vec3 seed = fabs(e.x) <= 0.75 ? vec3(1, 0, 0) : vec3(0, 1, 0), t = vec3_reject(seed, e);
    return vec3_scale(1 / vec3_norm(t), t);
}

/* The seat of q beside the point c of a core, which there goes on in no direction. */
static Seat beside_point(Vec3 q, Vec3 c, Vec3 otherwise) {
    const Vec3 arm = vec3_sub(q, c);
    Seat out = {.core = c, .distance = vec3_norm(arm), .bent = {true, true}};
    out.out = out.distance > 0 ? vec3_scale(1 / out.distance, arm) : otherwise;
    out.tangent[0] = any_across(out.out);
    out.tangent[1] = vec3_cross(out.out, out.tangent[0]);
    return out;
}

/* ... in the direction `along`, a unit vector, alone. */
static Seat beside_line(Vec3 q, Vec3 c, Vec3 along, Vec3 otherwise) {
    Seat out = beside_point(q, c, otherwise);
    out.tangent[0] = along;
    out.tangent[1] = vec3_cross(out.out, along);
    out.bent[0] = false;
    return out;
}

static Seat on_torus(const CpsiObstacle *o, Vec3 q) {
    const Vec3 m = radial(q), along = vec3(-m.y, m.x, 0);
    Seat out = beside_line(q, vec3_scale(o->form.main_radius, m), along, m);
    const double from_axis = hypot(q.x, q.y), least = 0.5 * (o->form.main_radius - o->radius);
    out.inverse_0 = vec3_dot(out.out, m) / fmax(from_axis, least);
    return out;
}

/* The tip of the core is inside the round tip of the cone. */
static Seat on_cone(const CpsiObstacle *o, Vec3 q) {
    const double sine = sin(o->form.angle), cosine = cos(o->form.angle);
    const Vec3 tip = vec3(0, 0, o->radius), m = radial(q), along = vec3(-m.y, m.x, 0);
    const double across = hypot(q.x, q.y), rise = q.z - o->radius,
                 s = across * sine + rise * cosine; /* from the tip along the side */
    if (!(s > 0)) return beside_point(q, tip, vec3(0, 0, -1));
    const Vec3 side = vec3_axpy(sine, m, vec3(0, 0, cosine));
    Seat out = {.core = vec3_axpy(s, side, tip),
                .out = vec3_axpy(cosine, m, vec3(0, 0, -sine)),
                .distance = across * cosine - rise * sine,
                .tangent = {along, side}};
    out.inverse_0 = cosine / fmax(across, 0.5 * o->radius * cosine);
    return out;
}

/* Inside the core: the nearest face. */
static Seat in_box(Vec3 q, const double half[3]) {
    int i = 0;
    for (int k = 1; k < 3; k++)
        if (half[k] - fabs(component(q, k)) < half[i] - fabs(component(q, i))) i = k;
    const double at = component(q, i), sign = at < 0 ? -1 : 1;
    const Vec3 none = vec3(0, 0, 0);
    return (Seat){.core = with(q, i, sign * half[i]),
                  .out = with(none, i, sign),
                  .distance = fabs(at) - half[i],
                  .tangent = {with(none, (i + 1) % 3, 1), with(none, (i + 2) % 3, 1)}};
}

static Seat on_box(const CpsiObstacle *o, Vec3 q) {
    double half[3];
    Vec3 c = q;
    int beyond = 0, within = -1;
    for (int i = 0; i < 3; i++) {
        half[i] = 0.5 * o->form.size[i] - o->radius;
        const double at = component(q, i);
        if (fabs(at) > half[i]) {
            c = with(c, i, at < 0 ? -half[i] : half[i]);
            beyond++;
        } else {
            within = i;
        }
    }
    if (beyond <= 1) return in_box(q, half); /* on a face, or inside */
    if (beyond == 2) return beside_line(q, c, with(vec3(0, 0, 0), within, 1), vec3(0, 0, 1));
    return beside_point(q, c, vec3(0, 0, 1));
}

static Seat seat_of(const CpsiObstacle *o, Vec3 x) {
    const Vec3 q = to_own(o, vec3_sub(x, o->frame.point)), up = vec3(0, 0, 1), side = vec3(1, 0, 0);
    const double half = 0.5 * o->form.length;
    switch (o->kind) {
    case CPS_OBSTACLE_TORUS: return on_torus(o, q);
    case CPS_OBSTACLE_CONE: return on_cone(o, q);
    case CPS_OBSTACLE_BOX: return on_box(o, q);
    case CPS_OBSTACLE_CYLINDER: return beside_line(q, vec3(0, 0, q.z), up, side);
    case CPS_OBSTACLE_CAPSULE:
        if (fabs(q.z) <= half) return beside_line(q, vec3(0, 0, q.z), up, side);
        return beside_point(q, vec3(0, 0, q.z < 0 ? -half : half), side);
    default: return beside_point(q, vec3(0, 0, 0), side);
    }
}

static double sign_of(const CpsiObstacle *o) { return o->form.inside ? -1 : 1; }

static double gap(const CpsiObstacle *o, Vec3 x) {
    return sign_of(o) * (seat_of(o, x).distance - o->radius);
}

static Vec3 normal(const CpsiObstacle *o, Vec3 x) {
    return vec3_scale(sign_of(o), to_world(o, seat_of(o, x).out));
}

static void curvature(const CpsiObstacle *o, Vec3 x, Vec3 t, Vec3 b, double out[3]) {
    const Seat seat = seat_of(o, x);
    const double round = 1 / fmax(seat.distance, 0.5 * o->radius);
    out[0] = out[1] = out[2] = 0;
    for (int i = 0; i < 2; i++) {
        const double k = sign_of(o) * (seat.bent[i] ? round : i == 0 ? seat.inverse_0 : 0);
        const Vec3 along = to_world(o, seat.tangent[i]);
        const double p = vec3_dot(along, t), q = vec3_dot(along, b);
        out[0] += k * p * p;
        out[1] += k * p * q;
        out[2] += k * q * q;
    }
}

/* Straight, and then to the height that was asked for. */
static Vec3 move(const CpsiObstacle *o, Vec3 x, Vec3 u) {
    const double height = gap(o, x) + vec3_dot(normal(o, x), u);
    const Vec3 y = vec3_add(x, u);
    return vec3_axpy(height - gap(o, y), normal(o, y), y);
}

static double angle(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    (void)o;
    return atan2(vec3_norm(vec3_cross(from, to)), vec3_dot(from, to));
}

static Vec3 slip(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    const Seat a = seat_of(o, from), b = seat_of(o, to);
    const Vec3 way = vec3_sub(b.core, a.core), pole = vec3_cross(a.out, b.out);
    const double sine = vec3_norm(pole), cosine = vec3_dot(a.out, b.out),
                 turn = atan2(sine, cosine);
    if (sine < NEARLY && cosine > 0) { /* the turn is its chord, to the last digit */
        const Vec3 chord = vec3_sub(b.out, a.out);
        return to_world(o, vec3_reject(vec3_axpy(o->radius, chord, way), b.out));
    }
    if (sine < NEARLY) /* opposite: every direction leads there */
        return to_world(o, vec3_axpy(o->radius * turn, b.tangent[1], vec3_reject(way, b.out)));
    const Vec3 axis = vec3_scale(1 / sine, pole), first = vec3_cross(axis, a.out),
               last = vec3_cross(axis, b.out);
    const double straight = vec3_dot(way, first) - tan(0.5 * turn) * vec3_dot(way, a.out);
    return to_world(o, vec3_axpy(straight + o->radius * turn, last,
                                 vec3_scale(vec3_dot(way, axis), axis)));
}

/* ---- along a straight path ---- */

static Vec3 between(Vec3 a, Vec3 b, double share) { return vec3_axpy(share, vec3_sub(b, a), a); }

/* The slope of the gap along the path from a to b. */
static double slope(const CpsiObstacle *o, Vec3 a, Vec3 b, double share) {
    return vec3_dot(normal(o, between(a, b, share)), vec3_sub(b, a));
}

/* Where the slope becomes 0 between two shares at which it has opposite signs: by secants, and
 * every fourth time by halves. */
static double turning_point(const CpsiObstacle *o, Vec3 a, Vec3 b, double low, double high) {
    double f = slope(o, a, b, low), g = slope(o, a, b, high);
    for (int i = 0; i < HALVINGS && high - low > 1e-16; i++) {
        const double by = i % 4 == 3 ? 0.5 : f / (f - g),
                     at = fmin(fmax(low + by * (high - low), low), high);
        const double here = slope(o, a, b, at);
        if (here == 0 || at == low || at == high) return at;
        if (here < 0) {
            low = at;
            f = here;
        } else {
            high = at;
            g = here;
        }
    }
    return 0.5 * (low + high);
}

/* Is the distance along a straight path convex? */
static bool is_convex(const CpsiObstacle *o) {
    return !o->form.inside && o->kind != CPS_OBSTACLE_TORUS;
}

/* The parts in which a path past a torus is examined. */
static int parts_of(const CpsiObstacle *o, Vec3 a, Vec3 b) {
    const double parts = ceil(4 * vec3_norm(vec3_sub(b, a)) / o->radius);
    return parts < MOST_PARTS ? (parts > 4 ? (int)parts : 4) : MOST_PARTS;
}

/* The part about the least gap of a path, by the shares of its ends. */
static void find_part(const CpsiObstacle *o, Vec3 a, Vec3 b, double part[2]) {
    const int parts = parts_of(o, a, b);
    double least = gap(o, a);
    int at = 0;
    for (int i = 1; i <= parts; i++) {
        const double here = gap(o, between(a, b, (double)i / parts));
        if (!(here < least)) continue;
        least = here;
        at = i;
    }
    part[0] = fmax(0, at - 1) / parts;
    part[1] = fmin(parts, at + 1) / parts;
}

bool cpsi_rounded_faces(const CpsiObstacle *o, Vec3 a, Vec3 b, double *share) {
    double part[2] = {0, 1};
    if (!is_convex(o)) {
        /* inside what is convex the least gap is at an end; a torus may be far away */
        if (o->kind != CPS_OBSTACLE_TORUS || gap(o, a) + gap(o, b) >= vec3_norm(vec3_sub(b, a)))
            return false;
        find_part(o, a, b, part);
    }
    if (!(slope(o, a, b, part[0]) < 0 && slope(o, a, b, part[1]) > 0)) return false;
    *share = turning_point(o, a, b, part[0], part[1]);
    return *share > 0 && *share < 1;
}

static double depth(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    const double ends = fmin(gap(o, from), gap(o, to));
    double share;
    if (!cpsi_rounded_faces(o, from, to, &share)) return -ends;
    return -fmin(ends, gap(o, between(from, to, share)));
}

/* The radius of the core's surface through x; inside no less than that of the wall, so that lines
 * in the middle of a bore may move. */
static double range(const CpsiObstacle *o, Vec3 x) {
    const Seat seat = seat_of(o, x);
    double within = INFINITY;
    for (int i = 0; i < 2; i++) {
        const double bent = seat.bent[i] ? o->radius + fmax(0, gap(o, x)) : INFINITY,
                     along = i == 0 && seat.inverse_0 != 0 ? 1 / fabs(seat.inverse_0) : INFINITY;
        within = fmin(within, fmin(bent, along));
    }
    return within;
}

const CpsiShapeTable cpsi_shape_rounded = {gap, depth, normal, curvature, move, slip, angle, range};
