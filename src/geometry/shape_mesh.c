/* SPDX-License-Identifier: BSD-3-Clause */
/* A mesh inflated by a radius (shape.h; docs/theory.md 2.3): distance d to the nearest triangle
 * less the radius r. Where the foot is on an edge the level of d through x is a cylinder of radius
 * d round it, at a corner a ball, on a face a plane. The way between two feet is their chord, laid
 * into the tangent plane where it arrives: right to second order where the surface turns little,
 * and to first order across an edge. */
#include <math.h>

#include "geometry/mesh.h"
#include "geometry/shape.h"

/* Corrections after which a point is at its height. */
enum { CORRECTIONS = 40 };
/* Places at which a path is examined at most. */
enum { PLACES = 2000 };
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

/* The foot of x, with the normal in the axes of the world. */
static CpsiMeshFoot foot_of(const CpsiObstacle *o, Vec3 x) {
    CpsiMeshFoot at = cpsi_mesh_nearest(o->mesh, inwards(o, vec3_sub(x, o->frame.point)));
    at.normal = outwards(o, at.normal);
    return at;
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

static Vec3 slip(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    const CpsiMeshFoot first = foot_of(o, from), last = foot_of(o, to);
    const Vec3 a = vec3_axpy(o->radius - first.distance, first.normal, from),
               chord = vec3_sub(vec3_axpy(o->radius - last.distance, last.normal, to), a),
               flat = vec3_reject(chord, last.normal);
    const double size = vec3_norm(flat);
    return size > 0 ? vec3_scale(vec3_norm(chord) / size, flat) : vec3(0, 0, 0);
}

/* What turns by a radian over the distance of its faces is as good as round; what turns at one edge
 * is not, but what lies beyond is a plane again. */
static double range(const CpsiObstacle *o, Vec3 x) {
    const CpsiMeshFoot at = foot_of(o, x);
    return fmax(o->mesh->range[at.triangle], o->radius) + fmax(0, at.distance - o->radius);
}

const CpsiShapeTable cpsi_shape_mesh = {gap, depth, normal, curvature, move, slip, angle, range};
