/* SPDX-License-Identifier: BSD-3-Clause */
/* Cylinder and sphere (shape.h). They are solid: the free side is outside. Both have closed forms
 * in the spoke of a point, its arm from the axis or the centre. */
#include <math.h>

#include "geometry/shape.h"

/* [rad] For points this near to opposite, rounding decides the direction of the geodesic. */
static const double HALF_ROUND = 1e-8;

static Vec3 unit(Vec3 v, Vec3 otherwise) {
    const double size = vec3_norm(v);
    return size > 0 ? vec3_scale(1 / size, v) : otherwise;
}

Vec3 cpsi_obstacle_spoke(const CpsiObstacle *o, Vec3 x) {
    const Vec3 from = vec3_sub(x, o->frame.point);
    return o->kind == CPS_OBSTACLE_CYLINDER ? vec3_reject(from, o->frame.axis[2]) : from;
}

static double gap(const CpsiObstacle *o, Vec3 x) {
    return vec3_norm(cpsi_obstacle_spoke(o, x)) - o->radius;
}

static double depth(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    const Vec3 a = cpsi_obstacle_spoke(o, from), chord = vec3_sub(cpsi_obstacle_spoke(o, to), a);
    const double square = vec3_dot(chord, chord),
                 nearest = square > 0 ? -vec3_dot(a, chord) / square : 0;
    return o->radius - vec3_norm(vec3_axpy(fmin(1, fmax(0, nearest)), chord, a));
}

static Vec3 normal(const CpsiObstacle *o, Vec3 x) {
    return unit(cpsi_obstacle_spoke(o, x), o->frame.axis[0]);
}

/* Of the surface of the same kind through x, which is bent across `straight`. */
static void curvature_beside(const CpsiObstacle *o, Vec3 x, Vec3 straight, Vec3 t, Vec3 b,
                             double out[3]) {
    const double kappa = 1 / fmax(vec3_norm(cpsi_obstacle_spoke(o, x)), 0.5 * o->radius);
    const double c = vec3_dot(straight, t), s = vec3_dot(straight, b);
    out[0] = kappa * (1 - c * c);
    out[1] = -kappa * c * s;
    out[2] = kappa * (1 - s * s);
}

static void cylinder_curvature(const CpsiObstacle *o, Vec3 x, Vec3 t, Vec3 b, double out[3]) {
    curvature_beside(o, x, o->frame.axis[2], t, b, out);
}

static void sphere_curvature(const CpsiObstacle *o, Vec3 x, Vec3 t, Vec3 b, double out[3]) {
    curvature_beside(o, x, vec3(0, 0, 0), t, b, out);
}

static Vec3 move(const CpsiObstacle *o, Vec3 x, Vec3 u) {
    const Vec3 n = normal(o, x), s = cpsi_obstacle_spoke(o, x);
    const double rise = vec3_dot(u, n), distance = vec3_norm(s);
    Vec3 tangent = vec3_reject(u, n), straight = vec3(0, 0, 0);
    if (o->kind == CPS_OBSTACLE_CYLINDER) {
        straight = vec3_scale(vec3_dot(tangent, o->frame.axis[2]), o->frame.axis[2]);
        tangent = vec3_sub(tangent, straight);
    }
    const double length = vec3_norm(tangent);
    if (!(length > 0 && distance > 0)) return vec3_add(x, u);
    /* along the circle of x in the plane of n and the tangent */
    const double angle = length / distance, reach = distance + rise;
    const Vec3 t = vec3_scale(1 / length, tangent), centre = vec3_sub(x, s);
    const Vec3 arm = vec3_axpy(cos(angle), n, vec3_scale(sin(angle), t));
    return vec3_add(vec3_axpy(reach, arm, centre), straight);
}

static Vec3 slip(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    const Vec3 n0 = normal(o, from), n1 = normal(o, to), axis = o->frame.axis[2];
    Vec3 straight = vec3(0, 0, 0);
    if (o->kind == CPS_OBSTACLE_CYLINDER)
        straight = vec3_scale(vec3_dot(vec3_sub(to, from), axis), axis);
    /* the great circle from n0 to n1, its direction at n1 */
    const Vec3 pole = vec3_cross(n0, n1);
    const double sine = vec3_norm(pole), cosine = vec3_dot(n0, n1), angle = atan2(sine, cosine);
    if (!(sine > 0) && cosine > 0) return straight;
    if (sine < HALF_ROUND && cosine < 0) { /* opposite points: every direction is a geodesic, on a
                                              cylinder those across the axis */
        const Vec3 across = vec3_cross(axis, n1), other = vec3_cross(o->frame.axis[0], n1);
        return vec3_axpy(o->radius * angle, unit(vec3_norm(across) > 0.5 ? across : other, axis),
                         straight);
    }
    const Vec3 arrival = vec3_cross(vec3_scale(1 / sine, pole), n1);
    return vec3_axpy(o->radius * angle, arrival, straight);
}

static double cylinder_angle(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    return atan2(vec3_dot(vec3_cross(from, to), o->frame.axis[2]), vec3_dot(from, to));
}

static double sphere_angle(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    (void)o;
    return atan2(vec3_norm(vec3_cross(from, to)), vec3_dot(from, to));
}

static double range(const CpsiObstacle *o, Vec3 x) { return o->radius + fmax(0, gap(o, x)); }

const CpsiShapeTable cpsi_shape_cylinder = {gap,  depth, normal,         cylinder_curvature,
                                            move, slip,  cylinder_angle, range};
const CpsiShapeTable cpsi_shape_sphere = {gap,  depth, normal,       sphere_curvature,
                                          move, slip,  sphere_angle, range};
