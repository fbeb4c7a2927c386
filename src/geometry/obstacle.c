/* SPDX-License-Identifier: BSD-3-Clause */
/* Plane, cylinder, sphere (obstacle.h). Curved ones are solid: the free side is outside. */
#include "geometry/obstacle.h"

/* A vector this short beside a unit vector has lost its direction to rounding. */
static const double LEAST = 1e-12;
/* [rad] For points this near to opposite, rounding decides the direction of the geodesic. */
static const double HALF_ROUND = 1e-8;

CpsiObstacle cpsi_obstacle(const CpsObstacle *def) {
    CpsiObstacle out = {.kind = def->kind,
                        .radius = def->radius,
                        .shape = def->friction_shape,
                        .moves = def->moves,
                        .has_set = def->friction_set};
    out.frame = cpsi_plane(def->point, def->kind == CPS_OBSTACLE_PLANE ? def->normal : def->axis);
    out.friction[0] = def->friction;
    out.friction[1] = def->has_friction_lateral ? def->friction_lateral : def->friction;
    out.grain = vec3_load(def->grain);
    out.has_grain = vec3_norm(out.grain) > 0;
    return out;
}

bool cpsi_obstacle_is_isotropic(const CpsiObstacle *o) {
    return !o->has_set && o->friction[0] == o->friction[1] &&
           o->shape == CPS_FRICTION_SHAPE_ELLIPSE;
}

bool cpsi_obstacle_needs_local_axes(const CpsiObstacle *o) {
    return o->kind != CPS_OBSTACLE_PLANE || !cpsi_obstacle_is_isotropic(o);
}

static Vec3 unit(Vec3 v, Vec3 otherwise) {
    const double size = vec3_norm(v);
    return size > 0 ? vec3_scale(1 / size, v) : otherwise;
}

Vec3 cpsi_obstacle_spoke(const CpsiObstacle *o, Vec3 x) {
    const Vec3 from = vec3_sub(x, o->frame.point);
    return o->kind == CPS_OBSTACLE_CYLINDER ? vec3_reject(from, o->frame.axis[2]) : from;
}

double cpsi_obstacle_gap(const CpsiObstacle *o, Vec3 x) {
    if (o->kind == CPS_OBSTACLE_PLANE) return vec3_dot(cpsi_obstacle_spoke(o, x), o->frame.axis[2]);
    return vec3_norm(cpsi_obstacle_spoke(o, x)) - o->radius;
}

double cpsi_obstacle_depth(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    const Vec3 a = cpsi_obstacle_spoke(o, from), chord = vec3_sub(cpsi_obstacle_spoke(o, to), a);
    if (o->kind == CPS_OBSTACLE_PLANE)
        return -fmin(cpsi_obstacle_gap(o, from), cpsi_obstacle_gap(o, to));
    const double square = vec3_dot(chord, chord),
                 nearest = square > 0 ? -vec3_dot(a, chord) / square : 0;
    return o->radius - vec3_norm(vec3_axpy(fmin(1, fmax(0, nearest)), chord, a));
}

Vec3 cpsi_obstacle_normal(const CpsiObstacle *o, Vec3 x) {
    if (o->kind == CPS_OBSTACLE_PLANE) return o->frame.axis[2];
    return unit(cpsi_obstacle_spoke(o, x), o->frame.axis[0]);
}

void cpsi_obstacle_axes(const CpsiObstacle *o, Vec3 x, Vec3 along, double axes[9],
                        double curvature[3]) {
    const Vec3 n = cpsi_obstacle_normal(o, x), wanted = o->has_grain ? o->grain : along;
    Vec3 t = vec3_reject(wanted, n);
    /* a direction along the normal has no tangent: any other */
    for (int i = 0; i < 3 && !(vec3_norm(t) > LEAST * vec3_norm(wanted)); i++) {
        t = vec3_reject(o->frame.axis[i], n);
        if (vec3_norm(t) < 0.5) t = vec3(0, 0, 0);
    }
    t = unit(t, o->frame.axis[0]);
    const Vec3 b = vec3_cross(n, t);
    vec3_store(&axes[0], t);
    vec3_store(&axes[3], b);
    vec3_store(&axes[6], n);
    const double kappa = o->kind == CPS_OBSTACLE_PLANE
                             ? 0
                             : 1 / fmax(vec3_norm(cpsi_obstacle_spoke(o, x)), 0.5 * o->radius);
    const Vec3 straight = o->kind == CPS_OBSTACLE_CYLINDER ? o->frame.axis[2] : vec3(0, 0, 0);
    const double c = vec3_dot(straight, t), s = vec3_dot(straight, b);
    curvature[0] = kappa * (1 - c * c);
    curvature[1] = -kappa * c * s;
    curvature[2] = kappa * (1 - s * s);
}

/* v turned about a unit axis. */
static Vec3 turned(Vec3 v, Vec3 axis, double angle) {
    const Vec3 along = vec3_scale(vec3_dot(v, axis), axis), across = vec3_sub(v, along);
    return vec3_add(along, vec3_axpy(cos(angle), across,
                                     vec3_scale(sin(angle), vec3_cross(axis, across))));
}

Vec3 cpsi_obstacle_move(const CpsiObstacle *o, Vec3 x, Vec3 u) {
    if (o->kind == CPS_OBSTACLE_PLANE) return vec3_add(x, u);
    const Vec3 n = cpsi_obstacle_normal(o, x), s = cpsi_obstacle_spoke(o, x);
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

Vec3 cpsi_obstacle_slip(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    if (o->kind == CPS_OBSTACLE_PLANE) return vec3_reject(vec3_sub(to, from), o->frame.axis[2]);
    const Vec3 n0 = cpsi_obstacle_normal(o, from), n1 = cpsi_obstacle_normal(o, to),
               axis = o->frame.axis[2];
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

double cpsi_obstacle_angle(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    if (o->kind == CPS_OBSTACLE_PLANE) return 0;
    const Vec3 pole = vec3_cross(from, to);
    const double sine =
        o->kind == CPS_OBSTACLE_CYLINDER ? vec3_dot(pole, o->frame.axis[2]) : vec3_norm(pole);
    return atan2(sine, vec3_dot(from, to));
}

bool cpsi_obstacle_faces(const CpsiObstacle *o, Vec3 a, Vec3 b, double *share) {
    if (o->kind == CPS_OBSTACLE_PLANE) return false;
    const Vec3 from = cpsi_obstacle_spoke(o, a), along = vec3_sub(cpsi_obstacle_spoke(o, b), from);
    const double passed = -vec3_dot(from, along), whole = vec3_dot(along, along);
    *share = passed / whole;
    return passed > 0 && passed < whole;
}

double cpsi_obstacle_allowance(const CpsiObstacle *o, double l) {
    return fmin(0.25 * l * (l / o->radius), 0.25 * o->radius);
}

Vec3 cpsi_obstacle_turn(const CpsiObstacle *o, Vec3 x, double angle) {
    if (angle == 0) return x;
    return vec3_add(o->frame.point, turned(vec3_sub(x, o->frame.point), o->frame.axis[2], angle));
}

Vec3 cpsi_obstacle_carry(const CpsiObstacle *o, Vec3 x, const CpsiShift *shift, double angle) {
    return cpsi_obstacle_turn(o, cpsi_shift_carry(shift, x), angle);
}

void cpsi_obstacle_shift(CpsiObstacle *o, const CpsiShift *shift) {
    o->frame.point = cpsi_shift_carry(shift, o->frame.point);
    if (cpsi_vec3_is_zero(shift->turn)) return;
    const Rotation turn = rotation_of(shift->turn);
    o->grain = rotation_apply(turn, o->grain);
    /* orthonormal again, so that no rounding adds up over many steps */
    Vec3 *axis = o->frame.axis;
    axis[2] = unit(rotation_apply(turn, axis[2]), axis[2]);
    axis[0] = unit(vec3_reject(rotation_apply(turn, axis[0]), axis[2]), axis[0]);
    axis[1] = vec3_cross(axis[2], axis[0]);
}
