/* SPDX-License-Identifier: BSD-3-Clause */
/* Meshes: the nearest point against a search over all triangles by another formula, the side
 * against the solid angle under which a closed mesh is seen, the geometry of obstacles against
 * differences, and what is refused or left out. */
#include "capstan/mesh.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "geometry/mesh.h"
#include "geometry/obstacle.h"
#include "splitmix.h"

static const double PI = 3.14159265358979323846;

enum { ROUND = 14, UP = 8, VERTICES = ROUND * (UP - 1) + 2, TRIANGLES = 2 * ROUND * (UP - 1) };

static double vertex[3 * VERTICES];
static int triangle[3 * TRIANGLES], used;

static void add(int a, int b, int c) {
    triangle[used++] = a;
    triangle[used++] = b;
    triangle[used++] = c;
}

/* A closed body with dents: a ball of radii between 1 - rough and 1 + rough, seen from outside
 * counter-clockwise. */
static CpsMeshTriangles body_of(uint64_t *random, double rough) {
    CpsMeshTriangles out = cps_mesh_triangles_default();
    int v = 0;
    used = 0;
    for (int j = 0; j <= UP; j++)
        for (int i = 0; i < (j == 0 || j == UP ? 1 : ROUND); i++, v++) {
            const double polar = PI * j / UP, angle = 2 * PI * i / ROUND,
                         r = 1 + rough * splitmix(random, -1, 1);
            vertex[3 * v] = r * sin(polar) * cos(angle);
            vertex[3 * v + 1] = r * sin(polar) * sin(angle);
            vertex[3 * v + 2] = r * cos(polar);
        }
    for (int i = 0; i < ROUND; i++) {
        const int next = (i + 1) % ROUND, last = 1 + ROUND * (UP - 2);
        add(0, 1 + i, 1 + next);
        for (int j = 0; j < UP - 2; j++) {
            const int a = 1 + ROUND * j + i, b = 1 + ROUND * j + next;
            add(a, a + ROUND, b + ROUND);
            add(a, b + ROUND, b);
        }
        add(last + i, VERTICES - 1, last + next);
    }
    out.vertex_count = VERTICES;
    out.vertex = vertex;
    out.triangle_count = TRIANGLES;
    out.triangle = triangle;
    return out;
}

static CpsMesh *made(const CpsMeshTriangles *of) {
    CpsMesh *mesh = NULL;
    CpsError err = {0};
    if (cps_mesh_create(of, &mesh, &err)) print_error("%s\n", err.message);
    assert_non_null(mesh);
    return mesh;
}

static Vec3 anywhere(uint64_t *random, double reach) {
    const double z = splitmix(random, -reach, reach), y = splitmix(random, -reach, reach);
    return vec3(splitmix(random, -reach, reach), y, z);
}

static Vec3 corner_of(const CpsMeshTriangles *of, int t, int i) {
    return vec3_at(of->vertex, of->triangle[3 * t + i]);
}

/* The nearest point of a triangle, by barycentric coordinates and by its edges; *part: -1 on the
 * face, i on the edge from corner i, 3 + i at corner i. */
static Vec3 nearest_point(const CpsMeshTriangles *of, int t, Vec3 x, int *part) {
    const Vec3 a = corner_of(of, t, 0), u = vec3_sub(corner_of(of, t, 1), a),
               v = vec3_sub(corner_of(of, t, 2), a), w = vec3_sub(x, a);
    const double uu = vec3_dot(u, u), uv = vec3_dot(u, v), vv = vec3_dot(v, v), uw = vec3_dot(u, w),
                 vw = vec3_dot(v, w), det = uu * vv - uv * uv;
    const double s = (vv * uw - uv * vw) / det, r = (uu * vw - uv * uw) / det;
    double least = INFINITY;
    Vec3 nearest = a;
    *part = -1;
    if (s >= 0 && r >= 0 && s + r <= 1) return vec3_add(a, vec3_axpy(s, u, vec3_scale(r, v)));
    for (int i = 0; i < 3; i++) {
        const Vec3 p = corner_of(of, t, i), e = vec3_sub(corner_of(of, t, (i + 1) % 3), p),
                   from = vec3_sub(x, p);
        const double k = fmin(1, fmax(0, vec3_dot(from, e) / vec3_dot(e, e)));
        const double distance = vec3_norm(vec3_sub(from, vec3_scale(k, e)));
        if (!(distance < least)) continue;
        least = distance;
        nearest = vec3_axpy(k, e, p);
        *part = k <= 0 ? 3 + i : k >= 1 ? 3 + (i + 1) % 3 : i;
    }
    return nearest;
}

static double distance_of(const CpsMeshTriangles *of, int t, Vec3 x) {
    int part;
    return vec3_norm(vec3_sub(x, nearest_point(of, t, x, &part)));
}

/* The solid angle of a triangle seen from x, positive from behind (van Oosterom and Strackee). */
static double solid_angle(const CpsMeshTriangles *of, int t, Vec3 x) {
    const Vec3 a = vec3_sub(corner_of(of, t, 0), x), b = vec3_sub(corner_of(of, t, 1), x),
               c = vec3_sub(corner_of(of, t, 2), x);
    const double p = vec3_norm(a), q = vec3_norm(b), r = vec3_norm(c);
    return 2 * atan2(vec3_dot(a, vec3_cross(b, c)),
                     p * q * r + vec3_dot(a, b) * r + vec3_dot(b, c) * p + vec3_dot(c, a) * q);
}

static void nearest_and_side(void **state) {
    (void)state;
    uint64_t random = 11;
    int inside = 0, edges = 0, corners = 0;
    for (int trial = 0; trial < 12; trial++) {
        const CpsMeshTriangles of = body_of(&random, 0.05 * trial);
        CpsMesh *mesh = made(&of);
        assert_int_equal(cps_mesh_report(mesh).rim_count, 0);
        for (int k = 0; k < 500; k++) {
            const Vec3 x = anywhere(&random, k % 2 ? 1.1 : 3);
            double least = INFINITY, seen = 0, at[3], foot[3];
            for (int t = 0; t < TRIANGLES; t++) {
                least = fmin(least, distance_of(&of, t, x));
                seen += solid_angle(&of, t, x);
            }
            const bool within = seen > 2 * PI; /* 4 pi inside, 0 outside */
            vec3_store(at, x);
            /* rounding of coordinates of up to 4 */
            CHECK_NEAR(cps_mesh_distance(mesh, at, foot), within ? -least : least, 1e-14);
            CHECK_NEAR(vec3_norm(vec3_sub(x, vec3_load(foot))), least, 1e-14);
            const CpsiMeshFoot found = cpsi_mesh_nearest(mesh, x);
            inside += within;
            edges += found.part >= CPSI_MESH_EDGE && found.part < CPSI_MESH_CORNER;
            corners += found.part >= CPSI_MESH_CORNER;
        }
        cps_mesh_release(mesh);
    }
    print_message("%d of 6000 places inside, nearest to an edge %d, to a corner %d\n", inside,
                  edges, corners);
    assert_true(inside > 500 && edges > 500 && corners > 500);
}

/* The same, turned inside out, is free within; a sheet is free on both sides. */
static void sides(void **state) {
    (void)state;
    uint64_t random = 12;
    CpsMeshTriangles of = body_of(&random, 0.2);
    CpsMesh *mesh = made(&of);
    const double volume = cps_mesh_report(mesh).volume;
    CHECK_LESS(fabs(volume - 4 * PI / 3), 1); /* about a ball */
    for (int t = 0; t < TRIANGLES; t++) {
        const int kept = triangle[3 * t];
        triangle[3 * t] = triangle[3 * t + 1];
        triangle[3 * t + 1] = kept;
    }
    CpsMesh *bore = made(&of);
    of.two_sided = true;
    CpsMesh *sheet = made(&of);
    CHECK_NEAR(cps_mesh_report(bore).volume, -volume, 1e-13);
    for (int k = 0; k < 500; k++) {
        double x[3];
        vec3_store(x, anywhere(&random, 2));
        const double d = cps_mesh_distance(mesh, x, NULL);
        CHECK_NEAR(cps_mesh_distance(bore, x, NULL), -d, 1e-14);
        CHECK_NEAR(cps_mesh_distance(sheet, x, NULL), fabs(d), 1e-14);
    }
    cps_mesh_release(mesh);
    cps_mesh_release(bore);
    cps_mesh_release(sheet);
}

/* An open square, seen from above counter-clockwise: beyond its rim all is free. */
static void rims(void **state) {
    (void)state;
    static const double square[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    static const int halves[] = {0, 1, 2, 0, 2, 3};
    CpsMeshTriangles of = cps_mesh_triangles_default();
    of.vertex_count = 4;
    of.vertex = square;
    of.triangle_count = 2;
    of.triangle = halves;
    CpsMesh *mesh = made(&of);
    assert_int_equal(cps_mesh_report(mesh).rim_count, 4);
    CHECK_NEAR(cps_mesh_distance(mesh, (double[]){0.5, 0.5, 0.1}, NULL), 0.1, 0);
    CHECK_NEAR(cps_mesh_distance(mesh, (double[]){0.5, 0.5, -0.1}, NULL), -0.1, 0);
    CHECK_NEAR(cps_mesh_distance(mesh, (double[]){1.3, 0.5, 0.4}, NULL), 0.5, 1e-15);
    CHECK_NEAR(cps_mesh_distance(mesh, (double[]){1.3, 0.5, -0.4}, NULL), 0.5, 1e-15);
    CHECK_NEAR(cps_mesh_distance(mesh, (double[]){-2, -1, -2}, NULL), 3, 1e-15);
    /* no place has no distance: as if deep inside */
    assert_true(cps_mesh_distance(mesh, (double[]){NAN, 0, 0}, NULL) < -1);
    cps_mesh_release(mesh);
}

/* Gap, normal, curvature, moves and slips agree with each other, wherever the obstacle is and
 * however it has been turned. */
static void is_an_obstacle(void **state) {
    (void)state;
    uint64_t random = 13;
    int bent = 0;
    for (int trial = 0; trial < 40; trial++) {
        const CpsMeshTriangles of = body_of(&random, 0.01 * trial);
        CpsMesh *mesh = made(&of);
        CpsObstacle def = cps_obstacle_default();
        def.kind = CPS_OBSTACLE_MESH;
        def.mesh = mesh;
        def.radius = 0.2;
        vec3_store(def.point, anywhere(&random, 3));
        CpsiObstacle o = cpsi_obstacle(&def);
        const CpsiObstacle before = o;
        CpsiShift shift;
        shift.by = anywhere(&random, 1);
        shift.turn = anywhere(&random, 2);
        shift.about = anywhere(&random, 1);
        cpsi_obstacle_shift(&o, &shift);
        for (int k = 0; k < 200; k++) {
            const Vec3 x = vec3_add(vec3_load(def.point), anywhere(&random, 1.5)),
                       y = cpsi_obstacle_carry(&o, x, &shift, 0), e = anywhere(&random, 1);
            const double gap = cpsi_obstacle_gap(&before, x), h = 1e-6;
            const Vec3 n = cpsi_obstacle_normal(&o, y);
            if (!(gap > -0.09)) continue; /* deeper, curvature is that of half the radius */
            CHECK_NEAR(cpsi_obstacle_gap(&o, y), gap, 1e-13); /* it goes with the body */
            CHECK_NEAR(vec3_norm(n), 1, 1e-14);
            const Vec3 there = vec3_axpy(h, e, y), other = vec3_axpy(-h, e, y);
            const double rise = cpsi_obstacle_gap(&o, there) - cpsi_obstacle_gap(&o, other);
            const Vec3 turned = vec3_sub(cpsi_obstacle_normal(&o, there), n);
            if (vec3_norm(turned) > 0.05) continue; /* over a concave edge */
            CHECK_NEAR(rise / (2 * h), vec3_dot(n, e), 1e-4);
            double axes[9], curvature[3];
            cpsi_obstacle_axes(&o, y, e, axes, curvature);
            const Vec3 t = vec3_load(axes), b = vec3_load(&axes[3]);
            const Vec3 by =
                vec3_scale(1 / h, vec3_sub(cpsi_obstacle_normal(&o, vec3_axpy(h, t, y)), n));
            /* where the difference does not cross from one part of a triangle to another */
            const double scale = vec3_norm(by) + fabs(curvature[0]) + fabs(curvature[1]);
            const bool same = fabs(vec3_dot(by, t) - curvature[0]) < 1e-3 * (1 + scale) &&
                              fabs(vec3_dot(by, b) - curvature[1]) < 1e-3 * (1 + scale);
            bent += same && scale > 0;
            const double at_edge = vec3_norm(
                vec3_sub(cpsi_obstacle_normal(&o, vec3_axpy(2 * h, t, y)),
                         vec3_axpy(2, vec3_sub(cpsi_obstacle_normal(&o, vec3_axpy(h, t, y)), n),
                                   n)));
            if (at_edge < 1e-9) assert_true(same);
            /* a move keeps the height that the displacement says, and a slip along the surface
             * leads back */
            const Vec3 u = vec3_scale(0.01, e), moved = cpsi_obstacle_move(&o, y, u);
            CHECK_NEAR(cpsi_obstacle_gap(&o, moved) - cpsi_obstacle_gap(&o, y), vec3_dot(u, n),
                       1e-12);
            const Vec3 slip = cpsi_obstacle_slip(&o, y, y);
            CHECK_NEAR(vec3_norm(slip), 0, 1e-15);
        }
        cps_mesh_release(mesh);
    }
    print_message("%d places on round edges\n", bent);
    assert_true(bent > 200);
}

/* The depth of a straight path: that of its deepest of many places. */
static void depth_of_paths(void **state) {
    (void)state;
    uint64_t random = 14;
    for (int trial = 0; trial < 60; trial++) {
        const CpsMeshTriangles of = body_of(&random, 0.3);
        CpsMesh *mesh = made(&of);
        CpsObstacle def = cps_obstacle_default();
        def.kind = CPS_OBSTACLE_MESH;
        def.mesh = mesh;
        def.radius = 0.1;
        const CpsiObstacle o = cpsi_obstacle(&def);
        const Vec3 from = anywhere(&random, 2), to = anywhere(&random, 2);
        double deepest = -INFINITY;
        for (int k = 0; k <= 20000; k++)
            deepest =
                fmax(deepest,
                     -cpsi_obstacle_gap(&o, vec3_axpy(k / 20000.0, vec3_sub(to, from), from)));
        /* steps of a twentieth of the radius */
        CHECK_LESS(fabs(cpsi_obstacle_depth(&o, from, to) - deepest), 0.05 * 0.1);
        cps_mesh_release(mesh);
    }
}

/* ---- several feet ---- */

static bool has_vertex(const CpsMeshTriangles *of, int t, int v) {
    return of->triangle[3 * t] == v || of->triangle[3 * t + 1] == v || of->triangle[3 * t + 2] == v;
}

/* Is no point of the triangles that have the part of triangle t nearer? */
static bool is_foot(const CpsMeshTriangles *of, int t, int part, double distance, Vec3 x) {
    if (part < 0) return true;
    const int first = of->triangle[3 * t + part % 3],
              last = part < 3 ? of->triangle[3 * t + (part + 1) % 3] : first;
    for (int s = 0; s < of->triangle_count; s++)
        if (has_vertex(of, s, first) && has_vertex(of, s, last) &&
            distance_of(of, s, x) < distance - 1e-12)
            return false;
    return true;
}

/* [sr] By which all triangles are seen from x: 0 outside. */
static double seen_from(const CpsMeshTriangles *of, Vec3 x) {
    double sum = 0;
    for (int t = 0; t < of->triangle_count; t++) sum += solid_angle(of, t, x);
    return fabs(sum);
}

enum { MANY = 60 };

/* The distances of the feet of x that are seen from the free side, each once; returns their number.
 */
static int all_feet(const CpsMeshTriangles *of, Vec3 x, double within, Vec3 out[MANY]) {
    int count = 0;
    for (int t = 0; t < of->triangle_count; t++) {
        int part;
        const Vec3 y = nearest_point(of, t, x, &part), arm = vec3_sub(x, y);
        const double distance = vec3_norm(arm);
        bool is_new = true;
        if (distance > within || !is_foot(of, t, part, distance, x) ||
            seen_from(of, vec3_axpy(1e-6, arm, y)) > 1)
            continue;
        for (int i = 0; i < count; i++) is_new &= vec3_norm(vec3_sub(out[i], y)) > 1e-9;
        assert_true(count < MANY);
        if (is_new) out[count++] = y;
    }
    return count;
}

static void several_feet(void **state) {
    (void)state;
    uint64_t random = 41;
    int several = 0;
    for (int trial = 0; trial < 400; trial++) {
        const CpsMeshTriangles of = body_of(&random, splitmix(&random, 0.1, 0.6));
        CpsMesh *mesh = made(&of);
        const Vec3 x = anywhere(&random, 1.2);
        CpsiMeshFoot foot[MANY];
        Vec3 expected[MANY];
        bool beyond;
        const double within = cpsi_mesh_nearest(mesh, x).distance * splitmix(&random, 1, 3);
        assert_true(mesh->has_folds);
        if (within > 0) {
            const int count = cpsi_mesh_feet(mesh, x, within, MANY, foot, &beyond),
                      all = all_feet(&of, x, within, expected);
            assert_false(beyond);
            assert_int_equal(count, all);
            several += count > 1;
            for (int i = 0; i < count; i++) {
                double least = INFINITY;
                for (int k = 0; k < all; k++)
                    least = fmin(least, vec3_norm(vec3_sub(expected[k], foot[i].foot)));
                CHECK_LESS(least, 1e-9);
                const CpsiMeshFoot same = cpsi_mesh_foot_from(mesh, foot[i].triangle, x, &beyond);
                assert_false(beyond);
                CHECK_NEAR(same.distance, foot[i].distance, 1e-12);
                if (i > 0) assert_true(foot[i].distance >= foot[i - 1].distance);
            }
            assert_int_equal(cpsi_mesh_feet(mesh, x, within, 1, foot, &beyond), 1);
        }
        cps_mesh_release(mesh);
    }
    assert_true(several > 40);
}

/* A groove along x whose sides have the slopes 1 and 1/2, of four triangles. */
static CpsMesh *groove(bool two_sided) {
    static const double at[18] = {-1, 0, 0, 1, 0, 0, 1, 1, 1, -1, 1, 1, 1, -1, 0.5, -1, -1, 0.5};
    static const int corner[12] = {0, 1, 2, 0, 2, 3, 0, 5, 4, 0, 4, 1};
    CpsMeshTriangles of = cps_mesh_triangles_default();
    of.vertex_count = 6;
    of.vertex = at;
    of.triangle_count = 4;
    of.triangle = corner;
    of.two_sided = two_sided;
    return made(&of);
}

/* A foot is followed to its neighbours, and over a fold to the plane of its face. */
static void over_a_fold(void **state) {
    (void)state;
    for (int sides = 0; sides < 2; sides++) {
        CpsMesh *mesh = groove(sides == 1);
        const double root = sqrt(2), other = sqrt(1.25);
        CpsiMeshFoot foot[4];
        bool beyond;
        const Vec3 low = vec3(0.2, 0.01, 0.3), right = vec3(-0.4, 0.9, 1.1);
        assert_true(mesh->has_folds);
        assert_int_equal(cpsi_mesh_feet(mesh, low, 1, 4, foot, &beyond), 2);
        assert_false(beyond);
        CHECK_NEAR(foot[0].distance, (0.3 - 0.01) / root, 1e-15);
        CHECK_NEAR(foot[1].distance, (0.3 + 0.005) / other, 1e-15);
        /* on the right the left side has no foot any more; from there it is that on its plane */
        assert_int_equal(cpsi_mesh_feet(mesh, right, 1, 4, foot, &beyond), 1);
        CHECK_NEAR(foot[0].distance, 0.2 / root, 1e-15);
        int left = 0;
        while (cpsi_mesh_nearest_of(mesh, left, vec3(0, -0.5, 0.25)).distance > 1e-12) left++;
        const CpsiMeshFoot plane = cpsi_mesh_foot_from(mesh, left, right, &beyond);
        assert_true(beyond);
        CHECK_NEAR(plane.distance, (1.1 + 0.45) / other, 1e-15);
        CHECK_NEAR(plane.normal.y, 0.5 / other, 1e-15);
        /* behind the fold both planes, the deeper first; of a sheet that is its other side */
        const int behind = cpsi_mesh_feet(mesh, vec3(0.3, 0.001, -0.1), 1, 4, foot, &beyond);
        assert_int_equal(behind, sides == 1 ? 1 : 2);
        assert_int_equal(beyond, sides == 0);
        CHECK_NEAR(foot[0].distance, sides == 1 ? hypot(0.001, 0.1) : -0.0995 / other, 1e-15);
        cps_mesh_release(mesh);
    }
}

/* A convex body has none; two of them may be touched at once. */
static void without_folds(void **state) {
    (void)state;
    double at[24];
    const int four[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    int corner[24];
    const double first[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    for (int k = 0; k < 12; k++) {
        at[k] = first[k];
        at[12 + k] = first[k] + (k % 3 == 0 ? 2 : 0);
        corner[k] = four[k];
        corner[12 + k] = four[k] + 4;
    }
    CpsMeshTriangles of = cps_mesh_triangles_default();
    of.vertex_count = 8;
    of.vertex = at;
    of.triangle_count = 4;
    of.triangle = corner;
    CpsMesh *one = made(&of);
    assert_false(one->has_folds);
    of.triangle_count = 8;
    CpsMesh *two = made(&of);
    assert_true(two->has_folds);
    CpsiMeshFoot foot[4];
    bool beyond;
    assert_int_equal(cpsi_mesh_feet(two, vec3(1.5, 0.01, 0.01), 1, 4, foot, &beyond), 2);
    cps_mesh_release(one);
    cps_mesh_release(two);
}

/* ---- what is refused, left out and joined ---- */

static void expect(const CpsMeshTriangles *of, CpsStatus status, const char *message) {
    CpsMesh *mesh = (CpsMesh *)&vertex; /* to be set to NULL */
    CpsError err = {0};
    assert_int_equal(cps_mesh_create(of, &mesh, &err), status);
    assert_null(mesh);
    if (!strstr(err.message, message)) fail_msg("'%s' is not in '%s'", message, err.message);
}

static void refusals(void **state) {
    (void)state;
    double at[18] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 2, 0, 0, 0, 0, 1};
    int corner[12] = {0, 1, 2, 1, 3, 2};
    CpsMeshTriangles good = cps_mesh_triangles_default();
    good.vertex_count = 6;
    good.vertex = at;
    good.triangle_count = 2;
    good.triangle = corner;
    cps_mesh_release(made(&good));
    cps_mesh_release(NULL);
    assert_null(cps_mesh_retain(NULL));
    assert_int_equal(cps_mesh_create(&good, NULL, NULL), CPS_ERR_ARGUMENT);
    expect(NULL, CPS_ERR_ARGUMENT, "triangles is NULL");
    CpsMeshTriangles bad = good;
    bad.cookie = 0;
    expect(&bad, CPS_ERR_ARGUMENT, "cps_mesh_triangles_default()");
    bad = good;
    bad.vertex_count = 2;
    expect(&bad, CPS_ERR_ARGUMENT, "2 vertices, expected 3 to");
    bad.vertex_count = CPS_MAX_MESH_VERTICES + 1;
    expect(&bad, CPS_ERR_LIMIT, "vertices, expected 3 to");
    bad = good;
    bad.triangle_count = 0;
    expect(&bad, CPS_ERR_ARGUMENT, "0 triangles, expected 1 to");
    bad.triangle_count = CPS_MAX_MESH_TRIANGLES + 1;
    expect(&bad, CPS_ERR_LIMIT, "triangles, expected 1 to");
    bad = good;
    bad.vertex = NULL;
    expect(&bad, CPS_ERR_ARGUMENT, "vertices are NULL");
    bad = good;
    bad.triangle = NULL;
    expect(&bad, CPS_ERR_ARGUMENT, "triangles are NULL");
    at[4] = NAN;
    expect(&good, CPS_ERR_ARGUMENT, "vertex 1 has the coordinate nan m");
    at[4] = 1e61;
    expect(&good, CPS_ERR_ARGUMENT, "vertex 1 has the coordinate 1e+61 m");
    at[4] = 0;
    corner[5] = 6;
    expect(&good, CPS_ERR_ARGUMENT, "triangle 1 has vertex 6, expected one of 0 to 5");
    corner[5] = -1;
    expect(&good, CPS_ERR_ARGUMENT, "triangle 1 has vertex -1");
    corner[5] = 4; /* 1 3 4: a triangle; 0 1 4: on one line */
    corner[3] = 0;
    corner[4] = 1;
    expect(&good, CPS_ERR_ARGUMENT, "the corners of triangle 1 lie on one line");
    memcpy(corner, (int[]){0, 1, 2, 1, 2, 3}, 6 * sizeof *corner);
    expect(&good, CPS_ERR_ARGUMENT, "turned against each other at the edge from (1, 0, 0) to");
    memcpy(corner, (int[]){0, 1, 2, 0, 2, 1}, 6 * sizeof *corner);
    expect(&good, CPS_ERR_ARGUMENT, "two triangles lie on each other at the edge");
    memcpy(corner, (int[]){0, 1, 2, 1, 0, 5, 1, 0, 4}, 9 * sizeof *corner);
    good.triangle_count = 3;
    at[13] = 1; /* 4: (2, 1, 0) */
    expect(&good, CPS_ERR_ARGUMENT, "more than two triangles meet at the edge");
    good.two_sided = true; /* which has no side to be known */
    cps_mesh_release(made(&good));
}

static void left_out(void **state) {
    (void)state;
    /* vertex 4 is at vertex 1, with another zero */
    const double at[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 1, -0.0, 0};
    const int corner[] = {0, 1, 2, 4, 3, 2, 1, 4, 3, 2, 0, 4};
    CpsMeshTriangles of = cps_mesh_triangles_default();
    of.vertex_count = 5;
    of.vertex = at;
    of.triangle_count = 4;
    of.triangle = corner;
    CpsMesh *mesh = made(&of), *same = cps_mesh_retain(mesh);
    cps_mesh_release(same);
    const CpsMeshReport report = cps_mesh_report(mesh);
    const CpsMeshTriangles made_of = cps_mesh_triangles(mesh);
    assert_int_equal(report.left_out_count, 2); /* without area, and once more */
    assert_int_equal(report.rim_count, 4);
    assert_int_equal(made_of.vertex_count, 4);
    assert_int_equal(made_of.triangle_count, 2);
    CHECK_NEAR(report.high[0], 1, 0);
    CHECK_NEAR(report.low[1], 0, 0);
    assert_true(report.bytes > 200);
    CpsMesh *again = made(&made_of);
    assert_memory_equal(cps_mesh_triangles(again).triangle, made_of.triangle, 6 * sizeof(int));
    cps_mesh_release(again);
    cps_mesh_release(mesh);
    of.triangle = &corner[6];
    of.triangle_count = 1;
    expect(&of, CPS_ERR_ARGUMENT, "each of its 1 triangles has two corners in one place");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nearest_and_side),
        cmocka_unit_test(sides),
        cmocka_unit_test(rims),
        cmocka_unit_test(is_an_obstacle),
        cmocka_unit_test(depth_of_paths),
        cmocka_unit_test(several_feet),
        cmocka_unit_test(over_a_fold),
        cmocka_unit_test(without_folds),
        cmocka_unit_test(refusals),
        cmocka_unit_test(left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
