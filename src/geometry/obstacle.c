/* SPDX-License-Identifier: BSD-3-Clause */
/* Obstacles (obstacle.h): what all shapes share. The shapes themselves are in shape_*.c. */
#include "geometry/obstacle.h"

#include "geometry/folds.h"
#include "geometry/ground.h"

/* A vector this short beside a unit vector has lost its direction to rounding. */
static const double LEAST = 1e-12;

/* In the order of CpsObstacleKind. */
static const CpsiShapeTable *const SHAPE[] = {&cpsi_shape_plane,   &cpsi_shape_cylinder,
                                              &cpsi_shape_sphere,  &cpsi_shape_smooth,
                                              &cpsi_shape_smooth,  &cpsi_shape_rounded,
                                              &cpsi_shape_rounded, &cpsi_shape_rounded,
                                              &cpsi_shape_rounded, &cpsi_shape_mesh};

static const CpsiShapeTable *shape_of(const CpsiObstacle *o) {
    return o->form.inside ? &cpsi_shape_rounded : SHAPE[o->kind];
}

/* [m] What a shape that is not round has for a radius: the step in which its paths are examined. */
static double radius_of(const CpsObstacle *def) {
    if (def->kind == CPS_OBSTACLE_GROUND) return 0.5 * cpsi_ground_spacing(def->ground);
    return def->kind == CPS_OBSTACLE_SURFACE ? def->surface.size : def->radius;
}

/* The axes of a box. */
static void turn_frame(CpsiPlane *frame, const double rotation[4]) {
    const Rotation turn = rotation_load(rotation);
    for (int i = 0; i < 3; i++)
        frame->axis[i] = rotation_apply(turn, vec3(i == 0 ? 1 : 0, i == 1 ? 1 : 0, i == 2 ? 1 : 0));
}

CpsiObstacle cpsi_obstacle(const CpsObstacle *def) {
    static const double UP[3] = {0, 0, 1};
    const bool axis = cpsi_obstacle_kind_has_axis(def->kind);
    CpsiObstacle out = {.kind = def->kind,
                        .radius = radius_of(def),
                        .form = def->shape,
                        .stiffness = def->stiffness,
                        .damping = def->damping,
                        .shape = def->friction_shape,
                        .moves = def->moves,
                        .face = CPSI_NO_FACE,
                        .has_set = def->friction_set};
    if (def->kind == CPS_OBSTACLE_GROUND) out.ground = def->ground;
    if (def->kind == CPS_OBSTACLE_SURFACE) out.surface = def->surface;
    if (def->kind == CPS_OBSTACLE_MESH) out.mesh = def->mesh;
    out.frame = cpsi_plane(def->point, axis                              ? def->axis
                                       : def->kind == CPS_OBSTACLE_PLANE ? def->normal
                                                                         : UP);
    if (def->kind == CPS_OBSTACLE_BOX) turn_frame(&out.frame, def->shape.rotation);
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

bool cpsi_obstacle_is_round(const CpsiObstacle *o) {
    return (o->kind == CPS_OBSTACLE_CYLINDER || o->kind == CPS_OBSTACLE_SPHERE) && !o->form.inside;
}

bool cpsi_obstacle_is_rounded(const CpsiObstacle *o) { return shape_of(o) == &cpsi_shape_rounded; }

bool cpsi_obstacle_is_convex(const CpsiObstacle *o) {
    return o->kind == CPS_OBSTACLE_PLANE || cpsi_obstacle_is_round(o) ||
           (cpsi_obstacle_is_rounded(o) && o->kind != CPS_OBSTACLE_TORUS && !o->form.inside);
}

bool cpsi_obstacle_faces_lines(const CpsiObstacle *o) {
    if (o->stiffness > 0) return false;
    return cpsi_obstacle_is_round(o) ||
           (cpsi_obstacle_is_rounded(o) && (!o->form.inside || o->kind == CPS_OBSTACLE_TORUS));
}

bool cpsi_obstacle_covers(const CpsiObstacle *o, Vec3 x, double rounding) {
    const Vec3 at = vec3_sub(x, o->frame.point);
    return !o->ground || cpsi_ground_covers(o->ground, at.x, at.y, rounding);
}

double cpsi_obstacle_friction_factor(const CpsiObstacle *o, Vec3 x) {
    const Vec3 at = vec3_sub(x, o->frame.point);
    return o->ground ? cpsi_ground_friction_factor(o->ground, at.x, at.y) : 1;
}

static Vec3 unit(Vec3 v, Vec3 otherwise) {
    const double size = vec3_norm(v);
    return size > 0 ? vec3_scale(1 / size, v) : otherwise;
}

double cpsi_obstacle_gap(const CpsiObstacle *o, Vec3 x) { return shape_of(o)->gap(o, x); }

double cpsi_obstacle_depth(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    return shape_of(o)->depth(o, from, to);
}

Vec3 cpsi_obstacle_normal(const CpsiObstacle *o, Vec3 x) { return shape_of(o)->normal(o, x); }

Vec3 cpsi_obstacle_move(const CpsiObstacle *o, Vec3 x, Vec3 u) {
    return shape_of(o)->move(o, x, u);
}

Vec3 cpsi_obstacle_slip(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    return shape_of(o)->slip(o, from, to);
}

double cpsi_obstacle_angle(const CpsiObstacle *o, Vec3 from, Vec3 to) {
    return shape_of(o)->angle(o, from, to);
}

double cpsi_obstacle_range(const CpsiObstacle *o, Vec3 x) { return shape_of(o)->range(o, x); }

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
    shape_of(o)->curvature(o, x, t, b, curvature);
}

/* v turned about a unit axis. */
static Vec3 turned(Vec3 v, Vec3 axis, double angle) {
    const Vec3 along = vec3_scale(vec3_dot(v, axis), axis), across = vec3_sub(v, along);
    return vec3_add(along, vec3_axpy(cos(angle), across,
                                     vec3_scale(sin(angle), vec3_cross(axis, across))));
}

bool cpsi_obstacle_faces(const CpsiObstacle *o, Vec3 a, Vec3 b, double *share) {
    if (o->stiffness > 0) return false;
    if (cpsi_obstacle_is_rounded(o)) return cpsi_rounded_faces(o, a, b, share);
    if (!cpsi_obstacle_is_round(o)) return false;
    const Vec3 from = cpsi_obstacle_spoke(o, a), along = vec3_sub(cpsi_obstacle_spoke(o, b), from);
    const double passed = -vec3_dot(from, along), whole = vec3_dot(along, along);
    *share = passed / whole;
    return passed > 0 && passed < whole;
}

CpsiObstacle cpsi_obstacle_within(const CpsiObstacle *o, double depth) {
    CpsiObstacle out = *o;
    out.radius += o->form.inside ? depth : -depth;
    return out;
}

double cpsi_obstacle_allowance(const CpsiObstacle *o, double l) {
    /* seen from inside, only the side of a torus towards its axis is convex */
    const double r = o->form.inside ? o->form.main_radius - o->radius : o->radius;
    return fmin(0.25 * l * (l / r), 0.25 * r);
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
