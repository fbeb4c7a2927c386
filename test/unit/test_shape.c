/* SPDX-License-Identifier: BSD-3-Clause */
/* Geometry of capsules, tori, cones, boxes, and of shapes from inside, compared with differences,
 * with equations of their surfaces, with planes, cylinders and balls, and with geodesics that are
 * integrated. */
#include <stdint.h>

#include "check.h"
#include "geometry/obstacle.h"
#include "splitmix.h"

enum { POINTS = 400, SHAPES = 6 };
static const double R = 0.8, LENGTH = 1.5, MAIN = 2, ANGLE = 0.6, SIZE[3] = {2.4, 3, 2};

static const CpsObstacleKind KIND[SHAPES] = {CPS_OBSTACLE_CAPSULE, CPS_OBSTACLE_TORUS,
                                             CPS_OBSTACLE_CONE,    CPS_OBSTACLE_BOX,
                                             CPS_OBSTACLE_SPHERE,  CPS_OBSTACLE_CYLINDER};

static Vec3 random_vector(uint64_t *state, double size) {
    const double x = splitmix(state, -size, size), y = splitmix(state, -size, size);
    return vec3(x, y, splitmix(state, -size, size));
}

static CpsObstacle defined(CpsObstacleKind kind, bool inside) {
    CpsObstacle def = cps_obstacle_default();
    const double point[3] = {0.3, -0.7, 1.1}, axis[3] = {1, 2, -0.5};
    def.kind = kind;
    def.radius = R;
    def.shape = (CpsShape){.inside = inside,
                           .length = LENGTH,
                           .main_radius = MAIN,
                           .angle = ANGLE,
                           .size = {SIZE[0], SIZE[1], SIZE[2]},
                           .rotation = {0.9, 0.2, -0.3, 0.1}};
    for (int a = 0; a < 3; a++) {
        def.point[a] = point[a];
        def.axis[a] = axis[a];
    }
    return def;
}

static CpsiObstacle make(CpsObstacleKind kind, bool inside) {
    const CpsObstacle def = defined(kind, inside);
    return cpsi_obstacle(&def);
}

/* At points on the surface, near it on both sides and far away, off the core, where the nearest
 * point of the surface is not unique. */
static void everywhere(void (*check)(const CpsiObstacle *, Vec3, uint64_t *)) {
    for (int i = 0; i < 2 * SHAPES; i++) {
        const CpsiObstacle o = make(KIND[i / 2], i % 2);
        uint64_t state = 7;
        for (int k = 0; k < POINTS; k++) {
            Vec3 x = random_vector(&state, k % 4 == 3 ? 40 : 3);
            const double gap = cpsi_obstacle_gap(&o, x);
            if (k % 4 == 1) x = vec3_axpy(-gap, cpsi_obstacle_normal(&o, x), x);
            const double deep = (o.form.inside ? 1 : -1) * cpsi_obstacle_gap(&o, x);
            if (deep < 0.45 * R) check(&o, x, &state);
        }
    }
}

/* Is the foot of x on the surface, by the equation that the surface has in its own axes? */
static double equation(const CpsiObstacle *o, Vec3 x) {
    const Vec3 arm = vec3_sub(x, o->frame.point), *e = o->frame.axis;
    const double q[3] = {vec3_dot(arm, e[0]), vec3_dot(arm, e[1]), vec3_dot(arm, e[2])},
                 across = hypot(q[0], q[1]);
    double sum = 0, tangent, z;
    switch (o->kind) {
    case CPS_OBSTACLE_SPHERE: return vec3_norm(arm) - R;
    case CPS_OBSTACLE_CYLINDER: return across - R;
    case CPS_OBSTACLE_TORUS: return hypot(across - MAIN, q[2]) - R;
    case CPS_OBSTACLE_CAPSULE:
        z = fabs(q[2]) - 0.5 * LENGTH;
        return z > 0 ? hypot(across, z) - R : across - R;
    case CPS_OBSTACLE_CONE: /* the side touches the ball of the tip at this height */
        tangent = R - R * sin(ANGLE);
        if (q[2] < tangent) return hypot(across, q[2] - R) - R;
        return (across - R * cos(ANGLE)) * cos(ANGLE) - (q[2] - tangent) * sin(ANGLE);
    default:
        for (int i = 0; i < 3; i++) {
            const double over = fmax(0, fabs(q[i]) - (0.5 * SIZE[i] - R));
            sum += over * over;
        }
        return sqrt(sum) - R;
    }
}

static void gradient(const CpsiObstacle *o, Vec3 x, uint64_t *state) {
    (void)state;
    const double h = 1e-5, gap = cpsi_obstacle_gap(o, x), rounding = 3e-15 * (2 + vec3_norm(x));
    const Vec3 n = cpsi_obstacle_normal(o, x), foot = vec3_axpy(-gap, n, x);
    double slope[3], normal[3];
    vec3_store(normal, n);
    for (int a = 0; a < 3; a++) {
        const Vec3 e = vec3(a == 0 ? h : 0, a == 1 ? h : 0, a == 2 ? h : 0);
        slope[a] =
            (cpsi_obstacle_gap(o, vec3_add(x, e)) - cpsi_obstacle_gap(o, vec3_sub(x, e))) / (2 * h);
    }
    /* curvature may jump within the difference, by 1/(0.45 R) at most: h/2 of it */
    CHECK_VECTOR(normal, slope, 2e-5);
    CHECK_NEAR(vec3_norm(n), 1, 1e-15);
    CHECK_NEAR(cpsi_obstacle_gap(o, foot), 0, rounding);
    CHECK_NEAR(equation(o, foot), 0, rounding);
}

static void normal_leads_to_the_surface(void **state) {
    (void)state;
    everywhere(gradient);
}

/* Curvature from normals beside x; not where they jump from part to part. */
static void bends(const CpsiObstacle *o, Vec3 x, uint64_t *state) {
    double axes[9], k[3], wide[3], found[3];
    const Vec3 arm = vec3_sub(x, o->frame.point);
    /* near the axis of a torus its curvature is limited */
    if (o->kind == CPS_OBSTACLE_TORUS &&
        vec3_norm(vec3_reject(arm, o->frame.axis[2])) < 0.5 * (MAIN - R) + 1e-3)
        return;
    cpsi_obstacle_axes(o, x, random_vector(state, 1), axes, k);
    const Vec3 t = vec3_load(axes), b = vec3_load(&axes[3]);
    for (int i = 0; i < 2; i++) {
        const double h = i ? 1e-5 : 2e-5;
        const Vec3 dt = vec3_sub(cpsi_obstacle_normal(o, vec3_axpy(h, t, x)),
                                 cpsi_obstacle_normal(o, vec3_axpy(-h, t, x))),
                   db = vec3_sub(cpsi_obstacle_normal(o, vec3_axpy(h, b, x)),
                                 cpsi_obstacle_normal(o, vec3_axpy(-h, b, x)));
        double *out = i ? found : wide;
        out[0] = vec3_dot(dt, t) / (2 * h);
        out[1] = (vec3_dot(dt, b) + vec3_dot(db, t)) / (4 * h);
        out[2] = vec3_dot(db, b) / (2 * h);
    }
    for (int a = 0; a < 3; a++)
        if (fabs(wide[a] - found[a]) > 1e-8) return; /* a join of two parts is within reach */
    /* rounding of the normals over h, and h^2 of third derivatives of at most 1/0.36^3 */
    CHECK_VECTOR(k, found, 1e-8);
}

static void curvature_is_that_of_normals(void **state) {
    (void)state;
    everywhere(bends);
}

/* From inside, all has the other sign. */
static void sides(const CpsiObstacle *o, Vec3 x, uint64_t *state) {
    if (!o->form.inside) return;
    const CpsiObstacle out = make(o->kind, false);
    const Vec3 along = random_vector(state, 1), to = vec3_add(x, random_vector(state, 0.3));
    double axes[9], k[3], other[9], m[3], got[3], want[3];
    CHECK_NEAR(cpsi_obstacle_gap(o, x), -cpsi_obstacle_gap(&out, x), 1e-14 * (2 + vec3_norm(x)));
    cpsi_obstacle_axes(o, x, along, axes, k);
    cpsi_obstacle_axes(&out, x, along, other, m);
    for (int a = 0; a < 3; a++) CHECK_NEAR(axes[6 + a], -other[6 + a], 1e-14);
    CHECK_NEAR(k[0], -m[0], 1e-12);
    CHECK_NEAR(k[1], m[1], 1e-12); /* the second tangent is opposite */
    CHECK_NEAR(k[2], -m[2], 1e-12);
    vec3_store(got, cpsi_obstacle_slip(o, x, to));
    vec3_store(want, cpsi_obstacle_slip(&out, x, to));
    CHECK_VECTOR(got, want, 1e-11);
}

static void inside_is_outside_with_the_other_sign(void **state) {
    (void)state;
    everywhere(sides);
}

static void same_place(const CpsiObstacle *a, const CpsiObstacle *b, Vec3 x, Vec3 to) {
    double got[3], want[3], axes[9], k[3], other[9], m[3];
    CHECK_NEAR(cpsi_obstacle_gap(a, x), cpsi_obstacle_gap(b, x), 1e-12);
    cpsi_obstacle_axes(a, x, vec3(0.3, 0.5, -0.7), axes, k);
    cpsi_obstacle_axes(b, x, vec3(0.3, 0.5, -0.7), other, m);
    for (int i = 0; i < 9; i++) CHECK_NEAR(axes[i], other[i], 1e-12);
    CHECK_VECTOR(k, m, 1e-12);
    vec3_store(got, cpsi_obstacle_slip(a, x, to));
    vec3_store(want, cpsi_obstacle_slip(b, x, to));
    CHECK_VECTOR(got, want, 1e-12);
}

/* The middle of a capsule is a cylinder, its ends are balls, and the middle of a box' face is a
 * plane: distance, axes, curvature and ways. */
static void parts_are_the_simple_shapes(void **unused) {
    (void)unused;
    const CpsiObstacle capsule = make(CPS_OBSTACLE_CAPSULE, false),
                       cylinder = make(CPS_OBSTACLE_CYLINDER, false),
                       box = make(CPS_OBSTACLE_BOX, false);
    const Vec3 *e = capsule.frame.axis, *f = box.frame.axis;
    CpsObstacle def = defined(CPS_OBSTACLE_SPHERE, false);
    uint64_t state = 5;
    for (int i = 0; i < POINTS; i++) {
        const double h = splitmix(&state, -0.74, 0.74), g = splitmix(&state, -0.74, 0.74);
        Vec3 way[2];
        for (int k = 0; k < 2; k++) {
            const Vec3 across = vec3_scale(splitmix(&state, -2, 2), e[1]);
            way[k] = vec3_axpy(splitmix(&state, 1, 2), e[0], across);
        }
        same_place(&capsule, &cylinder, vec3_add(capsule.frame.point, vec3_axpy(h, e[2], way[0])),
                   vec3_add(capsule.frame.point, vec3_axpy(g, e[2], way[1])));
        vec3_store(def.point, vec3_axpy(0.5 * LENGTH, e[2], capsule.frame.point));
        const CpsiObstacle ball = cpsi_obstacle(&def);
        for (int k = 1; k >= 0; k--) way[k] = vec3_axpy(splitmix(&state, 0.1, 2), e[2], way[k]);
        same_place(&capsule, &ball, vec3_add(ball.frame.point, way[0]),
                   vec3_add(ball.frame.point, way[1]));
        CpsObstacle flat = cps_obstacle_default();
        vec3_store(flat.point, vec3_axpy(0.5 * SIZE[2], f[2], box.frame.point));
        vec3_store(flat.normal, f[2]);
        const CpsiObstacle plane = cpsi_obstacle(&flat);
        Vec3 on[2];
        for (int k = 0; k < 2; k++) {
            Vec3 out = vec3_scale(splitmix(&state, -0.1, 1), f[2]);
            out = vec3_axpy(splitmix(&state, -0.6, 0.6), f[1], out);
            out = vec3_axpy(splitmix(&state, -0.39, 0.39), f[0], out);
            on[k] = vec3_add(plane.frame.point, out);
        }
        same_place(&box, &plane, on[0], on[1]);
    }
}

/* A torus of main radius M differs from a cylinder by what the circle is off its tangent, x^2/(2
 * M).
 */
static void a_large_torus_is_a_cylinder(void **unused) {
    (void)unused;
    for (double main = 1e2; main < 1e7; main *= 10) {
        CpsObstacle def = defined(CPS_OBSTACLE_TORUS, false), tube = def;
        const double up[3] = {0, 0, 1}, along[3] = {0, 1, 0}, on[3] = {main, 0, 0}, none[3] = {0};
        for (int a = 0; a < 3; a++) {
            def.axis[a] = up[a];
            tube.axis[a] = along[a];
            tube.point[a] = on[a];
            def.point[a] = none[a];
        }
        def.shape.main_radius = main;
        tube.kind = CPS_OBSTACLE_CYLINDER;
        const CpsiObstacle o = cpsi_obstacle(&def), c = cpsi_obstacle(&tube);
        uint64_t state = 3;
        for (int i = 0; i < POINTS; i++) {
            const Vec3 x = vec3_add(vec3_load(on), random_vector(&state, 1.5));
            if (cpsi_obstacle_gap(&c, x) < -0.5 * R) continue;
            CHECK_NEAR(cpsi_obstacle_gap(&o, x), cpsi_obstacle_gap(&c, x),
                       1.5 * 1.5 / 2 / main * 1.05 + 4e-16 * main);
        }
    }
}

/* Along a geodesic from x for `length`, in small steps that are projected; its direction. */
static Vec3 follow(const CpsiObstacle *o, Vec3 x, Vec3 *t, double length) {
    enum { STEPS = 1000 };
    for (int i = 0; i < STEPS; i++) {
        Vec3 y = vec3_axpy(length / STEPS, *t, x);
        y = vec3_axpy(-cpsi_obstacle_gap(o, y), cpsi_obstacle_normal(o, y), y);
        const Vec3 n = cpsi_obstacle_normal(o, y), flat = vec3_reject(*t, n);
        *t = vec3_scale(1 / vec3_norm(flat), flat);
        x = y;
    }
    return x;
}

/* The way found against geodesics of a length of 0.4, in equal pieces: the largest error per length
 * of a piece. Every other one begins near the obstacle's point, which is the tip of a cone; in
 * however many pieces, a geodesic crosses the same changes of curvature. */
static double error_of_ways(CpsObstacleKind kind, int pieces) {
    enum { GEODESICS = 200 };
    const CpsiObstacle o = make(kind, false);
    const double size = 0.4 / pieces;
    uint64_t state = 17;
    double worst = 0;
    for (int i = 0; i < GEODESICS; i++) {
        Vec3 x = vec3_add(o.frame.point, random_vector(&state, i % 2 ? 1.5 : 3));
        x = vec3_axpy(-cpsi_obstacle_gap(&o, x), cpsi_obstacle_normal(&o, x), x);
        const Vec3 flat = vec3_reject(random_vector(&state, 1), cpsi_obstacle_normal(&o, x));
        Vec3 t = vec3_scale(1 / vec3_norm(flat), flat);
        for (int piece = 0; piece < pieces; piece++) {
            const Vec3 to = follow(&o, x, &t, size);
            const Vec3 off = vec3_axpy(-size, t, cpsi_obstacle_slip(&o, x, to));
            worst = fmax(worst, vec3_norm(off) / size);
            x = to;
        }
    }
    return worst;
}

/* Ways are of second order: half as long, four times as exact, per length; on a sphere and a
 * cylinder they are geodesics, to what the integration leaves. */
static void ways_are_of_second_order(void **unused) {
    (void)unused;
    static const char *const NAME[] = {"capsule", "torus", "cone", "box"};
    for (int k = 0; k < 4; k++) {
        const double wide = error_of_ways(KIND[k], 4), half = error_of_ways(KIND[k], 8),
                     quarter = error_of_ways(KIND[k], 16);
        print_message("%s: error of ways %.2e, %.2e, %.2e: orders %.2f, %.2f\n", NAME[k], wide,
                      half, quarter, log2(wide / half), log2(half / quarter));
        /* length^2 over radii of curvature of at least R, by 1/6 */
        CHECK_LESS(wide, 0.1 * 0.1 / (R * R) / 6);
        CHECK_GREATER(0.5 * log2(wide / quarter), 1.7);
    }
    /* Steps h along the tangents at their beginnings are too long by (h/R)^2/3, and turn a helix at
     * alpha to the axis by length h sin^3(alpha) cos(alpha)/(2 R^2), its mean by half of it:
     * 8.33e-8 on a sphere, 2.03e-5 at most on a cylinder. */
    CHECK_LESS(error_of_ways(CPS_OBSTACLE_SPHERE, 1), 9e-8);
    CHECK_LESS(error_of_ways(CPS_OBSTACLE_CYLINDER, 1), 2.1e-5);
}

/* Across one edge of a box, from face to face, the unrolled surface is flat. */
static void ways_across_an_edge_are_exact(void **unused) {
    (void)unused;
    CpsObstacle def = defined(CPS_OBSTACLE_BOX, false);
    const double none[4] = {1, 0, 0, 0};
    for (int i = 0; i < 4; i++) def.shape.rotation[i] = none[i];
    for (int a = 0; a < 3; a++) def.point[a] = 0;
    const CpsiObstacle o = cpsi_obstacle(&def);
    uint64_t state = 23;
    for (int i = 0; i < POINTS; i++) {
        /* on top at u before the edge, on the side at v below it, w along it */
        const double u = splitmix(&state, 0, 0.3), v = splitmix(&state, 0, 0.2),
                     w = splitmix(&state, -1.3, 1.3), quarter = 0.5 * 3.14159265358979323846 * R;
        const Vec3 from = vec3(0.4 - u, -0.5 * w, 1), to = vec3(1.2, 0.5 * w, 0.2 - v);
        const Vec3 slip = cpsi_obstacle_slip(&o, from, to);
        const double got[3] = {slip.x, slip.y, slip.z}, want[3] = {0, w, -(u + quarter + v)};
        if (fabs(0.5 * w) < 0.5 * SIZE[1] - R) CHECK_VECTOR(got, want, 1e-14);
    }
}

/* Along the axis, where the directions of two points differ by rounding only. */
static void ways_without_a_turn(void **unused) {
    (void)unused;
    const CpsiObstacle o = make(CPS_OBSTACLE_CAPSULE, false);
    const Vec3 *e = o.frame.axis;
    uint64_t state = 31;
    for (int i = 0; i < POINTS; i++) {
        const double angle = splitmix(&state, -3, 3), turn = pow(10, splitmix(&state, -17, -6)),
                     h = splitmix(&state, -0.7, 0.7), g = splitmix(&state, -0.7, 0.7);
        const Vec3 from = vec3_axpy(R * cos(angle), e[0], vec3_scale(R * sin(angle), e[1])),
                   to = vec3_axpy(R * cos(angle + turn), e[0],
                                  vec3_scale(R * sin(angle + turn), e[1]));
        const Vec3 slip = cpsi_obstacle_slip(&o, vec3_add(o.frame.point, vec3_axpy(h, e[2], from)),
                                             vec3_add(o.frame.point, vec3_axpy(g, e[2], to)));
        CHECK_NEAR(vec3_dot(slip, e[2]), g - h, 1e-14);
        CHECK_NEAR(vec3_norm(vec3_reject(slip, e[2])), R * turn, 1e-15);
    }
}

/* The least gap along straight ways, against many places of each. */
static void faces(void **unused) {
    (void)unused;
    uint64_t state = 11;
    for (int k = 0; k < 2 * SHAPES; k++) {
        const CpsiObstacle o = make(KIND[k / 2], k % 2);
        int between = 0;
        for (int i = 0; i < 4 * POINTS; i++) {
            enum { PLACES = 1000 };
            const Vec3 a = random_vector(&state, 3),
                       b = vec3_add(a, random_vector(&state, pow(10, splitmix(&state, -2, 0.5))));
            if (cpsi_obstacle_gap(&o, a) < 0 || cpsi_obstacle_gap(&o, b) < 0) continue;
            double least = INFINITY, share;
            for (int j = 0; j <= PLACES; j++)
                least =
                    fmin(least,
                         cpsi_obstacle_gap(&o, vec3_axpy((double)j / PLACES, vec3_sub(b, a), a)));
            const double ends = fmin(cpsi_obstacle_gap(&o, a), cpsi_obstacle_gap(&o, b)),
                         length = vec3_norm(vec3_sub(b, a)), step = length / PLACES;
            const bool found = cpsi_obstacle_faces(&o, a, b, &share);
            /* what cuts in is found, and so is where it does so most */
            if (least < -step) assert_true(found);
            CHECK_NEAR(-cpsi_obstacle_depth(&o, a, b), fmin(least, ends),
                       least < 0 ? step : 2 * length);
            if (!found) continue;
            between++;
            CHECK_LESS(cpsi_obstacle_gap(&o, vec3_axpy(share, vec3_sub(b, a), a)),
                       least + 1e-9 + (o.kind == CPS_OBSTACLE_TORUS && least > 0 ? length : 0));
        }
        if (!o.form.inside) assert_true(between > POINTS / 40);
        if (o.form.inside && o.kind != CPS_OBSTACLE_TORUS) assert_int_equal(between, 0);
    }
}

/* Shifted and turned with all points, a shape has the same distances and ways. */
static void shifts(void **unused) {
    (void)unused;
    uint64_t state = 29;
    for (int k = 0; k < 2 * SHAPES; k++)
        for (int i = 0; i < 50; i++) {
            const CpsiObstacle o = make(KIND[k / 2], k % 2);
            CpsiObstacle there = o;
            CpsiShift shift;
            shift.by = random_vector(&state, 1e3);
            shift.turn = random_vector(&state, 2);
            shift.about = random_vector(&state, 5);
            const Vec3 x = random_vector(&state, 3), y = vec3_add(x, random_vector(&state, 0.3));
            cpsi_obstacle_shift(&there, &shift);
            const Vec3 a = cpsi_shift_carry(&shift, x), b = cpsi_shift_carry(&shift, y);
            CHECK_NEAR(cpsi_obstacle_gap(&there, a), cpsi_obstacle_gap(&o, x), 2e-12);
            /* the directions of points within half of the radius are ill-conditioned */
            if (fabs(cpsi_obstacle_gap(&o, x)) > 0.5 * R ||
                fabs(cpsi_obstacle_gap(&o, y)) > 0.5 * R)
                continue;
            CHECK_NEAR(vec3_norm(cpsi_obstacle_slip(&there, a, b)),
                       vec3_norm(cpsi_obstacle_slip(&o, x, y)), 1e-11);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(normal_leads_to_the_surface),
        cmocka_unit_test(curvature_is_that_of_normals),
        cmocka_unit_test(inside_is_outside_with_the_other_sign),
        cmocka_unit_test(parts_are_the_simple_shapes),
        cmocka_unit_test(a_large_torus_is_a_cylinder),
        cmocka_unit_test(ways_are_of_second_order),
        cmocka_unit_test(ways_across_an_edge_are_exact),
        cmocka_unit_test(ways_without_a_turn),
        cmocka_unit_test(faces),
        cmocka_unit_test(shifts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
