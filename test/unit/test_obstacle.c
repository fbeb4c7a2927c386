/* SPDX-License-Identifier: BSD-3-Clause */
/* Geometry of planes, cylinders and spheres compared with differences and by moves there and
 * back. */
#include "geometry/obstacle.h"

#include <stdint.h>

#include "check.h"
#include "splitmix.h"

enum { POINTS = 200 };

static Vec3 random_vector(uint64_t *state, double size) {
    const double z = splitmix(state, -size, size), y = splitmix(state, -size, size);
    return vec3(splitmix(state, -size, size), y, z);
}

static CpsiObstacle make(CpsObstacleKind kind) {
    CpsObstacle def = cps_obstacle_default();
    const double point[3] = {0.3, -0.7, 1.1}, axis[3] = {1, 2, -0.5}, normal[3] = {-0.2, 0.4, 2};
    def.kind = kind;
    def.radius = 0.8;
    for (int a = 0; a < 3; a++) {
        def.point[a] = point[a];
        def.axis[a] = axis[a];
        def.normal[a] = normal[a];
    }
    return cpsi_obstacle(&def);
}

/* Call `check` at many points: on the surface, near it on both sides and far away, not near the
 * axis or centre, where curvature is limited to that at half the radius. */
static void everywhere(void (*check)(const CpsiObstacle *, Vec3, uint64_t *)) {
    for (int kind = CPS_OBSTACLE_PLANE; kind <= CPS_OBSTACLE_SPHERE; kind++) {
        const CpsiObstacle o = make((CpsObstacleKind)kind);
        uint64_t state = 7;
        for (int i = 0; i < POINTS; i++) {
            Vec3 x = random_vector(&state, i % 4 == 3 ? 40 : 2);
            const double gap = cpsi_obstacle_gap(&o, x);
            if (i % 4 == 1)
                x = vec3_axpy(-gap, cpsi_obstacle_normal(&o, x), x); /* onto the surface */
            if (o.kind != CPS_OBSTACLE_PLANE && cpsi_obstacle_gap(&o, x) < -0.45 * o.radius)
                continue;
            check(&o, x, &state);
        }
    }
}

/* The normal is the gradient of the gap, and leads down to a foot where the gap is 0. */
static void gradient(const CpsiObstacle *o, Vec3 x, uint64_t *state) {
    (void)state;
    const double step = 1e-5;
    const Vec3 n = cpsi_obstacle_normal(o, x);
    double slope[3], normal[3];
    vec3_store(normal, n);
    for (int a = 0; a < 3; a++) {
        const Vec3 e = vec3(a == 0 ? step : 0, a == 1 ? step : 0, a == 2 ? step : 0);
        slope[a] = (cpsi_obstacle_gap(o, vec3_add(x, e)) - cpsi_obstacle_gap(o, vec3_sub(x, e))) /
                   (2 * step);
    }
    /* central differences: step^2/6 of a third derivative of at most 12/0.32^2, and rounding of
     * 40/step ulps */
    CHECK_VECTOR(normal, slope, 5e-9);
    CHECK_NEAR(vec3_norm(n), 1, 4e-16);
    /* rounding of coordinates up to 40 */
    CHECK_NEAR(cpsi_obstacle_gap(o, vec3_axpy(-cpsi_obstacle_gap(o, x), n, x)), 0, 3e-14);
}

static void normal_is_gradient(void **state) {
    (void)state;
    everywhere(gradient);
}

/* Axes are orthonormal and right-handed, the first along the line or the grain; curvature is the
 * second derivative of the gap in the tangents. */
static void bends(const CpsiObstacle *o, Vec3 x, uint64_t *state) {
    double axes[9], curvature[3], n[3];
    const Vec3 along = random_vector(state, 1);
    cpsi_obstacle_axes(o, x, along, axes, curvature);
    const Vec3 t = vec3_load(&axes[0]), b = vec3_load(&axes[3]), normal = vec3_load(&axes[6]);
    vec3_store(n, cpsi_obstacle_normal(o, x));
    CHECK_VECTOR(&axes[6], n, 0);
    /* an along close to the normal has a short tangent, whose direction keeps 1/length of the
     * digits */
    const double part = vec3_norm(vec3_axpy(-vec3_dot(along, normal), normal, along)) /
                        vec3_norm(along),
                 loss = 1e-15 / part;
    CHECK_NEAR(vec3_dot(t, normal), 0, 2 * loss);
    CHECK_NEAR(vec3_norm(t), 1, 4e-16);
    CHECK_NEAR(vec3_norm(b), 1, 4 * loss);
    CHECK_NEAR(vec3_dot(vec3_cross(normal, t), b), 1, 4 * loss);
    CHECK_NEAR(vec3_dot(vec3_cross(along, normal), t), 0, 4e-16 * vec3_norm(along));
    CHECK_GREATER(vec3_dot(along, t), 0);

    const double step = 1e-4;
    const Vec3 direction[3] = {t, vec3_add(t, b), b}; /* the mixed one by polarisation */
    double second[3];
    for (int k = 0; k < 3; k++) {
        const double up = cpsi_obstacle_gap(o, vec3_axpy(step, direction[k], x)),
                     down = cpsi_obstacle_gap(o, vec3_axpy(-step, direction[k], x));
        second[k] = (up - 2 * cpsi_obstacle_gap(o, x) + down) / (step * step);
    }
    second[1] = 0.5 * (second[1] - second[0] - second[2]);
    /* step^2 of a fourth derivative of 3/0.32^3 and more for the sum of both; rounding of 40
     * ulps/step^2 */
    CHECK_VECTOR(curvature, second, 3e-6);
}

static void curvature_is_second_derivative(void **state) {
    (void)state;
    everywhere(bends);
}

/* The slip from x to where it moves is what it was moved by, as it arrives: same length, and back
 * again the same path. On a surface of radius r the slip is that at the surface, while x moves at
 * its own distance. */
static void there_and_back(const CpsiObstacle *o, Vec3 x, uint64_t *state) {
    const double distance =
        o->kind == CPS_OBSTACLE_PLANE ? 1 : (o->radius + cpsi_obstacle_gap(o, x)) / o->radius;
    const double rise = splitmix(state, -0.2, 0.5);
    const Vec3 n = cpsi_obstacle_normal(o, x), any = random_vector(state, 1);
    const Vec3 u = vec3_axpy(rise - vec3_dot(any, n), n, any);
    const double tolerance = 1e-14 * (1 + vec3_norm(x)) / (distance < 1 ? distance : 1);
    const Vec3 to = cpsi_obstacle_move(o, x, u);
    CHECK_NEAR(cpsi_obstacle_gap(o, to), cpsi_obstacle_gap(o, x) + rise, 10 * tolerance);

    /* what is straight on a cylinder is not shortened */
    const Vec3 axis = o->frame.axis[2], tangent = vec3_axpy(-rise, n, u),
               slip = cpsi_obstacle_slip(o, x, to);
    const double straight = o->kind == CPS_OBSTACLE_CYLINDER ? vec3_dot(tangent, axis) : 0;
    const double whole = vec3_norm(tangent),
                 round = sqrt(fmax(0, whole * whole - straight * straight));
    CHECK_NEAR(vec3_norm(slip), hypot(straight, round / distance), 10 * tolerance);
    CHECK_NEAR(vec3_dot(slip, cpsi_obstacle_normal(o, to)), 0, 10 * tolerance);
    if (o->kind == CPS_OBSTACLE_CYLINDER)
        CHECK_NEAR(vec3_dot(slip, axis), straight, 10 * tolerance);

    /* back: from the arrival, against the way, to the start */
    const Vec3 along = vec3_scale(straight, axis);
    const double grown =
        o->kind == CPS_OBSTACLE_PLANE ? 1 : (o->radius + cpsi_obstacle_gap(o, to)) / o->radius;
    const Vec3 rest = o->kind == CPS_OBSTACLE_CYLINDER ? vec3_sub(slip, along) : slip;
    Vec3 back = vec3_scale(-grown, rest);
    if (o->kind == CPS_OBSTACLE_CYLINDER) back = vec3_sub(back, along);
    back = vec3_axpy(-rise, cpsi_obstacle_normal(o, to), back);
    double got[3], want[3];
    vec3_store(got, cpsi_obstacle_move(o, to, back));
    vec3_store(want, x);
    CHECK_VECTOR(got, want, 30 * tolerance);
}

static void move_and_slip(void **state) {
    (void)state;
    everywhere(there_and_back);
}

/* Nothing moved is nothing; the way to a point on the same normal is none. */
static void still(const CpsiObstacle *o, Vec3 x, uint64_t *state) {
    (void)state;
    double got[3], want[3];
    vec3_store(got, cpsi_obstacle_move(o, x, vec3(0, 0, 0)));
    vec3_store(want, x);
    CHECK_VECTOR(got, want, 0);
    const Vec3 up = cpsi_obstacle_move(o, x, vec3_scale(0.5, cpsi_obstacle_normal(o, x)));
    CHECK_NEAR(vec3_norm(cpsi_obstacle_slip(o, x, up)), 0, 2e-14 * (1 + vec3_norm(x)));
}

static void no_slip(void **state) {
    (void)state;
    everywhere(still);
}

/* A turn keeps gap and distance along the axis, adds up, and moves the foot of a cylinder by radius
 * x angle round the axis. */
static void turns(const CpsiObstacle *o, Vec3 x, uint64_t *state) {
    if (o->kind == CPS_OBSTACLE_PLANE) return;
    const double angle = splitmix(state, -3, 3), rounding = 2e-14 * (1 + vec3_norm(x));
    const Vec3 axis = o->frame.axis[2], to = cpsi_obstacle_turn(o, x, angle);
    CHECK_NEAR(cpsi_obstacle_gap(o, to), cpsi_obstacle_gap(o, x), rounding);
    CHECK_NEAR(vec3_dot(vec3_sub(to, x), axis), 0, rounding);
    double got[3], want[3];
    vec3_store(got, cpsi_obstacle_turn(o, cpsi_obstacle_turn(o, x, angle / 3), 2 * angle / 3));
    vec3_store(want, to);
    CHECK_VECTOR(got, want, 2 * rounding);
    vec3_store(got, cpsi_obstacle_turn(o, x, 0));
    vec3_store(want, x);
    CHECK_VECTOR(got, want, 0);
    /* right-hand rule: to first order x + angle axis x (x - point) */
    const Vec3 spin = vec3_cross(axis, vec3_sub(x, o->frame.point)),
               near = cpsi_obstacle_turn(o, x, 1e-6);
    vec3_store(got, vec3_scale(1e6, vec3_sub(near, x)));
    vec3_store(want, spin);
    CHECK_VECTOR(got, want, 1e-6 * vec3_norm(spin) + 1e6 * 1e-15 * (1 + vec3_norm(x)));
    if (o->kind == CPS_OBSTACLE_CYLINDER)
        CHECK_NEAR(vec3_norm(cpsi_obstacle_slip(o, x, to)), o->radius * fabs(angle), rounding);
}

static void turn(void **state) {
    (void)state;
    everywhere(turns);
}

/* The angle between two normals has the sign of the turn on a cylinder and none on a ball; half
 * round a way has the length of half a turn, whatever its direction. */
static void angles(const CpsiObstacle *o, Vec3 x, uint64_t *state) {
    const double angle = splitmix(state, -3, 3), rounding = 2e-14 * (1 + vec3_norm(x));
    const Vec3 n = cpsi_obstacle_normal(o, x);
    if (o->kind == CPS_OBSTACLE_PLANE) {
        CHECK_NEAR(cpsi_obstacle_angle(o, n, vec3(1, 0, 0)), 0, 0);
        return;
    }
    const Vec3 to = cpsi_obstacle_normal(o, cpsi_obstacle_turn(o, x, angle)),
               far = vec3_scale(-1, n);
    const double found = cpsi_obstacle_angle(o, n, to), pi = 3.14159265358979323846;
    if (o->kind == CPS_OBSTACLE_CYLINDER) CHECK_NEAR(found, angle, rounding);
    if (o->kind == CPS_OBSTACLE_SPHERE) CHECK_NEAR(cos(found), vec3_dot(n, to), rounding);
    CHECK_NEAR(cpsi_obstacle_angle(o, to, n), o->kind == CPS_OBSTACLE_SPHERE ? found : -found,
               rounding);
    CHECK_NEAR(fabs(cpsi_obstacle_angle(o, n, far)), pi, rounding);
    const Vec3 foot = vec3_axpy(-cpsi_obstacle_gap(o, x), n, x),
               across = vec3_axpy(-2 * o->radius, n, foot);
    const Vec3 slip = cpsi_obstacle_slip(o, foot, across);
    CHECK_NEAR(vec3_norm(slip), pi * o->radius, 1e2 * rounding);
    CHECK_NEAR(vec3_dot(slip, n), 0, 1e2 * rounding);
}

static void half_round(void **state) {
    (void)state;
    everywhere(angles);
    /* exactly: the points on the axes of a ball and a cylinder at the origin, to the last bit
     * opposite */
    for (int kind = CPS_OBSTACLE_CYLINDER; kind <= CPS_OBSTACLE_SPHERE; kind++) {
        CpsObstacle def = cps_obstacle_default();
        def.kind = (CpsObstacleKind)kind;
        def.radius = 2;
        const CpsiObstacle o = cpsi_obstacle(&def); /* about the y axis */
        const Vec3 slip = cpsi_obstacle_slip(&o, vec3(2, 0, 0), vec3(-2, 0, 0));
        CHECK_NEAR(vec3_norm(slip), 2 * 3.14159265358979323846, 1e-15);
        CHECK_NEAR(slip.x, 0, 0);
        if (kind == CPS_OBSTACLE_CYLINDER) CHECK_NEAR(slip.y, 0, 0);
    }
}

/* What an obstacle asks of the nodes on it. */
static void has_local_axes(void **state) {
    (void)state;
    CpsObstacle def = cps_obstacle_default();
    def.friction = 0.5;
    CpsiObstacle o = cpsi_obstacle(&def);
    assert_false(cpsi_obstacle_needs_local_axes(&o));
    CHECK_NEAR(o.friction[1], 0.5, 0); /* across as along, if not said */
    def.has_friction_lateral = true;
    def.friction_lateral = 0;
    o = cpsi_obstacle(&def);
    assert_true(cpsi_obstacle_needs_local_axes(&o));
    CHECK_NEAR(o.friction[1], 0, 0);
    def.has_friction_lateral = true;
    def.friction_lateral = 0.5;
    def.friction_shape = CPS_FRICTION_SHAPE_BOX;
    o = cpsi_obstacle(&def);
    assert_true(cpsi_obstacle_needs_local_axes(&o));
    def.friction_shape = CPS_FRICTION_SHAPE_ELLIPSE;
    def.kind = CPS_OBSTACLE_SPHERE;
    o = cpsi_obstacle(&def);
    assert_true(cpsi_obstacle_needs_local_axes(&o));
}

/* A grain's first tangent is fixed in space, whatever the line does; a line along the normal still
 * has axes. */
static void grain(void **state) {
    (void)state;
    CpsObstacle def = cps_obstacle_default();
    def.grain[0] = 3;
    def.grain[1] = 4;
    def.grain[2] = 7;
    CpsiObstacle o = cpsi_obstacle(&def);
    double axes[9], curvature[3];
    cpsi_obstacle_axes(&o, vec3(1, 2, 0), vec3(0, -1, 0), axes, curvature);
    CHECK_VECTOR(axes, ((const double[]){0.6, 0.8, 0}), 2e-16);
    CHECK_VECTOR(&axes[3], ((const double[]){-0.8, 0.6, 0}), 2e-16);

    o = make(CPS_OBSTACLE_SPHERE);
    const Vec3 x = vec3(2, 1, 3), n = cpsi_obstacle_normal(&o, x);
    cpsi_obstacle_axes(&o, x, vec3_scale(5, n), axes, curvature);
    for (int i = 0; i < 3; i++) CHECK_NEAR(vec3_norm(vec3_load(&axes[3 * i])), 1, 1e-15);
    CHECK_NEAR(vec3_dot(vec3_load(axes), n), 0, 1e-15);
}

/* The point of an element that faces a round obstacle is where the gap along it is least, found
 * here by golden section; it is told only where that is between the ends. */
static void faces(void **state_) {
    (void)state_;
    const double golden = (sqrt(5) - 1) / 2;
    uint64_t state = 11;
    int inside = 0;
    for (int i = 0; i < 40 * POINTS; i++) {
        const CpsiObstacle o = make(i % 2 ? CPS_OBSTACLE_CYLINDER : CPS_OBSTACLE_SPHERE);
        const Vec3 a = random_vector(&state, 2),
                   b = vec3_add(a, random_vector(&state, pow(10, splitmix(&state, -2, 1))));
        double low = 0, high = 1, share;
        for (int k = 0; k < 80; k++) {
            const double left = high - golden * (high - low), right = low + golden * (high - low);
            const double before = cpsi_obstacle_gap(&o, vec3_axpy(left, vec3_sub(b, a), a));
            if (before < cpsi_obstacle_gap(&o, vec3_axpy(right, vec3_sub(b, a), a)))
                high = right;
            else
                low = left;
        }
        /* a search by values finds the place of a least value to the root of rounding only */
        const double found = 0.5 * (low + high), margin = 1e-5;
        const bool between = cpsi_obstacle_faces(&o, a, b, &share);
        if (found > margin && found < 1 - margin) assert_true(between);
        if (!between) continue;
        inside++;
        CHECK_NEAR(share, found, margin);
    }
    assert_true(inside > 4 * POINTS);
    double none = 0;
    const CpsiObstacle plane = make(CPS_OBSTACLE_PLANE);
    assert_false(cpsi_obstacle_faces(&plane, vec3(0, 0, 1), vec3(1, 0, 1), &none));
    const CpsiObstacle ball = make(CPS_OBSTACLE_SPHERE);
    assert_false(
        cpsi_obstacle_faces(&ball, vec3(1, 1, 1), vec3(1, 1, 1), &none)); /* no element at all */
}

/* A chord of up to 1.3 R cuts in by less than is allowed, one of 1.35 R by more; never more than a
 * quarter of the radius is allowed. */
static void allowance(void **state_) {
    (void)state_;
    const CpsiObstacle o = make(CPS_OBSTACLE_CYLINDER);
    for (int i = 1; i <= 130; i++) {
        const double l = 0.01 * i * o.radius,
                     cut = o.radius - sqrt(o.radius * o.radius - 0.25 * l * l);
        assert_true(cut < cpsi_obstacle_allowance(&o, l));
        /* of second order, and twice the chord's own cut for short elements */
        assert_true(cpsi_obstacle_allowance(&o, l) <= 2 * cut);
    }
    const double l = 1.35 * o.radius;
    assert_true(o.radius - sqrt(o.radius * o.radius - 0.25 * l * l) >
                cpsi_obstacle_allowance(&o, l));
    CHECK_NEAR(cpsi_obstacle_allowance(&o, 100 * o.radius), 0.25 * o.radius, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(normal_is_gradient),
        cmocka_unit_test(curvature_is_second_derivative),
        cmocka_unit_test(move_and_slip),
        cmocka_unit_test(no_slip),
        cmocka_unit_test(turn),
        cmocka_unit_test(half_round),
        cmocka_unit_test(has_local_axes),
        cmocka_unit_test(grain),
        cmocka_unit_test(faces),
        cmocka_unit_test(allowance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
