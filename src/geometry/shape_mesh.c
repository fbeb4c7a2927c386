/* SPDX-License-Identifier: BSD-3-Clause */
/* A mesh inflated by a radius (shape.h, folds.h; docs/theory.md 2.3): distance d to the nearest
 * triangle less the radius r. Where the foot is on an edge the level of d through x is a cylinder
 * of radius d round it, at a corner a ball, on a face a plane. The way between two feet is their
 * chord, laid into the tangent plane where it arrives: right to second order where the surface
 * turns little, and to first order across an edge. Across a fold it is that of the plane where it
 * arrives. */
#include <math.h>

#include "geometry/folds.h"
#include "geometry/mesh.h"

/* Corrections after which a point is at its height. */
enum { CORRECTIONS = 40 };
/* Places at which a path is examined at most. */
enum { PLACES = 2000 };
/* [-] Of the radius: the gap up to which feet beside the nearest are looked for. */
static const double RANGE = 0.25;
/* [-] Of the radius: the least step along a path. */
static const double STEP = 0.05;
/* [-] A correction smaller than this, relative to the places, is rounding. */
static const double ROUNDING = 4e-16;

/* Into the axes of the mesh, and back. */
static Vec3 inwards(const CpsiObstacle *o, Vec3 v) {
    return vec3(vec3_dot(v, o->frame.axis[0]), vec3_dot(v, o->frame.axis[1]),
                vec3_dot(v, o->frame.axis[2]));
}

static Vec3 outwards(const CpsiObstacle *o, Vec3 v) {
    return vec3_axpy(v.x, o->frame.axis[0],
                     vec3_axpy(v.y, o->frame.axis[1], vec3_scale(v.z, o->frame.axis[2])));
}

/* x in the axes of the mesh. */
static Vec3 inside_of(const CpsiObstacle *o, Vec3 x) {
    return inwards(o, vec3_sub(x, o->frame.point));
}

/* The foot of x, with the normal in the axes of the world. */
static CpsiMeshFoot foot_of(const CpsiObstacle *o, Vec3 x) {
    bool beyond;
    CpsiMeshFoot at = o->face == CPSI_NO_FACE
                          ? cpsi_mesh_nearest(o->mesh, inside_of(o, x))
                          : cpsi_mesh_foot_from(o->mesh, o->face, inside_of(o, x), &beyond);
    at.normal = outwards(o, at.normal);
    return at;
}

bool cpsi_obstacle_has_folds(const CpsiObstacle *o) {
    return o->mesh && o->mesh->has_folds && !(o->stiffness > 0);
}

static CpsiFoot as_seen(const CpsiObstacle *o, const CpsiMeshFoot *at, bool beyond) {
    return (CpsiFoot){.face = at->triangle,
                      .beyond = beyond,
                      .gap = at->distance - o->radius,
                      .normal = outwards(o, at->normal)};
}

int cpsi_obstacle_feet(const CpsiObstacle *o, Vec3 x, CpsiFoot out[CPSI_MOST_FEET]) {
    CpsiMeshFoot at[CPSI_MOST_FEET];
    bool beyond;
    const int count = cpsi_mesh_feet(o->mesh, inside_of(o, x), (1 + RANGE) * o->radius,
                                     CPSI_MOST_FEET, at, &beyond);
    for (int i = 0; i < count; i++) out[i] = as_seen(o, &at[i], beyond);
    return count;
}

/* Of several feet of x the one whose normal is nearest to n; behind a fold the nearest. */
static CpsiMeshFoot foot_towards(const CpsiObstacle *o, Vec3 x, Vec3 n) {
    CpsiMeshFoot at[CPSI_MOST_FEET];
    bool beyond;
    int best = 0;
    const int count = cpsi_mesh_feet(o->mesh, inside_of(o, x), (1 + RANGE) * o->radius,
                                     CPSI_MOST_FEET, at, &beyond);
    if (beyond) at[0] = cpsi_mesh_nearest(o->mesh, inside_of(o, x));
    for (int i = 0; i < (beyond ? 1 : count); i++) {
        at[i].normal = outwards(o, at[i].normal);
        if (vec3_dot(at[i].normal, n) > vec3_dot(at[best].normal, n)) best = i;
    }
    return at[best];
}

int cpsi_obstacle_face_towards(const CpsiObstacle *o, Vec3 x, Vec3 n) {
    return foot_towards(o, x, n).triangle;
}

CpsiFoot cpsi_obstacle_foot(const CpsiObstacle *o, Vec3 x) {
    bool beyond;
    const CpsiMeshFoot at = cpsi_mesh_foot_from(o->mesh, o->face, inside_of(o, x), &beyond);
    return as_seen(o, &at, beyond);
}

static double gap(const CpsiObstacle *o, Vec3 x) { return foot_of(o, x).distance - o->radius; }

static Vec3 normal(const CpsiObstacle *o, Vec3 x) { return foot_of(o, x).normal; }

/* No place is nearer to the surface than the last one by more than the way to it. */
static double depth(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    const Vec3 way = vec3_sub(to, from);
    const double length = vec3_norm(way), least_step = fmax(STEP * o->radius, length / PLACES);
    double least = fmin(gap(o, from), gap(o, to));
    for (double passed = 0; passed < length;) {
        const double here = gap(o, vec3_axpy(passed / length, way, from));
        least = fmin(least, here);
        passed += fmax(here - least, least_step);
    }
    return -least;
}

/* [1/m] The curvature across `straight`, a unit vector or 0, of a surface that is round. */
static void curvature(const CpsiObstacle *o, Vec3 x, Vec3 t, Vec3 b, double out[3]) {
    const CpsiMeshFoot at = foot_of(o, x);
    Vec3 straight = vec3(0, 0, 0);
    out[0] = out[1] = out[2] = 0;
    if (at.part == CPSI_MESH_FACE) return;
    if (at.part < CPSI_MESH_CORNER) {
        const int i = at.part - CPSI_MESH_EDGE;
        const Vec3 edge = outwards(o, vec3_sub(cpsi_mesh_corner(o->mesh, at.triangle, (i + 1) % 3),
                                               cpsi_mesh_corner(o->mesh, at.triangle, i)));
        straight = vec3_scale(1 / vec3_norm(edge), edge);
    }
    const double kappa = 1 / fmax(at.distance, 0.5 * o->radius);
    const double c = vec3_dot(straight, t), s = vec3_dot(straight, b);
    out[0] = kappa * (1 - c * c);
    out[1] = -kappa * c * s;
    out[2] = kappa * (1 - s * s);
}

static Vec3 move(const CpsiObstacle *o, Vec3 x, Vec3 u) {
    const CpsiMeshFoot at = foot_of(o, x);
    const double height = at.distance + vec3_dot(u, at.normal);
    Vec3 y = vec3_add(x, u);
    for (int i = 0; i < CORRECTIONS; i++) {
        const CpsiMeshFoot there = foot_of(o, y);
        const double off = height - there.distance;
        if (!(fabs(off) > ROUNDING * (vec3_norm(y) + o->radius))) break;
        y = vec3_axpy(off, there.normal, y);
    }
    return y;
}

/* [rad] Between two unit vectors, 0 to pi. */
static double angle(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    (void)o;
    return atan2(vec3_norm(vec3_cross(from, to)), vec3_dot(from, to));
}

/* A way from foot to foot. */
typedef struct Way {
    Vec3 from, to, first, last; /* the feet on the surface, and the normals there */
    bool folds;                 /* the normals turn towards each other on the way */
} Way;

static Way way_between(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    const CpsiMeshFoot last = foot_of(o, to), first = o->face == CPSI_NO_FACE
                                                          ? foot_of(o, from)
                                                          : foot_towards(o, from, last.normal);
    Way way = {.from = vec3_axpy(o->radius - first.distance, first.normal, from),
               .to = vec3_axpy(o->radius - last.distance, last.normal, to),
               .first = first.normal,
               .last = last.normal};
    way.folds = o->face != CPSI_NO_FACE &&
                vec3_dot(vec3_sub(way.to, way.from), vec3_sub(last.normal, first.normal)) < 0;
    return way;
}

static Vec3 slip(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    const Way way = way_between(o, from, to);
    if (way.folds) return vec3_reject(vec3_sub(to, from), way.last);
    const Vec3 chord = vec3_sub(way.to, way.from), flat = vec3_reject(chord, way.last);
    const double size = vec3_norm(flat);
    return size > 0 ? vec3_scale(vec3_norm(chord) / size, flat) : vec3(0, 0, 0);
}

Vec3 cpsi_obstacle_first_normal(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    const Way way = way_between(o, from, to);
    return way.folds ? way.last : way.first;
}

/* What turns by a radian over the distance of its faces is as good as round; what turns at one edge
 * is not, but what lies beyond is a plane again. */
static double range(const CpsiObstacle *o, Vec3 x) {
    const CpsiMeshFoot at = foot_of(o, x);
    return fmax(o->mesh->range[at.triangle], o->radius) + fmax(0, at.distance - o->radius);
}

const CpsiShapeTable cpsi_shape_mesh = {gap, depth, normal, curvature, move, slip, angle, range};
