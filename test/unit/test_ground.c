/* SPDX-License-Identifier: BSD-3-Clause */
/* Ground through the points of a grid, and the geometry of smooth surfaces: compared with
 * polynomials, differences, and cylinders and spheres written as functions. */
#include "capstan/ground.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "geometry/ground.h"
#include "geometry/obstacle.h"
#include "splitmix.h"

enum { MOST = 40 };

static double x[MOST], y[MOST], z[MOST * MOST], factor[MOST * MOST];

/* A grid of random spacing; its heights are those of `height`, or random. */
static CpsGroundGrid grid_of(uint64_t *state, int columns, int rows,
                             double (*height)(double, double)) {
    CpsGroundGrid grid = cps_ground_grid_default();
    double at = splitmix(state, -5, 5);
    for (int i = 0; i < columns; i++) x[i] = at += splitmix(state, 0.2, 1);
    at = splitmix(state, -5, 5);
    for (int j = 0; j < rows; j++) y[j] = at += splitmix(state, 0.2, 1);
    for (int j = 0; j < rows; j++)
        for (int i = 0; i < columns; i++) {
            z[j * columns + i] = height ? height(x[i], y[j]) : splitmix(state, -0.5, 0.5);
            factor[j * columns + i] = splitmix(state, 0, 2);
        }
    grid.x_count = columns;
    grid.y_count = rows;
    grid.x = x;
    grid.y = y;
    grid.z = z;
    grid.friction_factor = factor;
    grid.extends = true;
    return grid;
}

static CpsGround *made(const CpsGroundGrid *grid) {
    CpsGround *ground = NULL;
    CpsError err = {0};
    if (cps_ground_create(grid, &ground, &err)) print_error("%s\n", err.message);
    assert_non_null(ground);
    return ground;
}

static double paraboloid(double a, double b) {
    return 0.3 - 0.2 * a + 0.1 * b + 0.05 * a * a - 0.04 * a * b + 0.03 * b * b +
           0.01 * a * a * b * b;
}

/* What is of second degree along each axis is reproduced; heights are those of the points, which
 * are copied. */
static void reproduces_parabolas(void **state) {
    (void)state;
    uint64_t random = 3;
    for (int size = 3; size < 12; size++) {
        const CpsGroundGrid grid = grid_of(&random, size, 14 - size, paraboloid);
        CpsGround *ground = made(&grid), *other = cps_ground_retain(ground);
        const double low[2] = {x[0], y[0]}, high[2] = {x[size - 1], y[13 - size]};
        memset(z, 0, sizeof z);
        cps_ground_release(other);
        for (int k = 0; k < 100; k++) {
            const double a = splitmix(&random, low[0], high[0]),
                         b = splitmix(&random, low[1], high[1]);
            double slope[2];
            /* rounding of weights of up to 5 times heights of up to 50 */
            CHECK_NEAR(cps_ground_height(ground, a, b, slope), paraboloid(a, b), 1e-12);
            CHECK_NEAR(slope[0], -0.2 + 0.1 * a - 0.04 * b + 0.02 * a * b * b, 1e-11);
            CHECK_NEAR(slope[1], 0.1 - 0.04 * a + 0.06 * b + 0.02 * a * a * b, 1e-11);
        }
        cps_ground_release(ground);
    }
}

/* Heights and slopes agree on both sides of the edges of cells, and slopes and second derivatives
 * are the derivatives of heights and slopes, inside and beyond the edges of the grid. */
static void is_smooth(void **state) {
    (void)state;
    uint64_t random = 5;
    for (int size = 2; size < 9; size++) {
        const CpsGroundGrid grid = grid_of(&random, size, 10 - size, NULL);
        CpsGround *ground = made(&grid);
        for (int i = 0; i < size; i++) {
            const double b = splitmix(&random, y[0] - 1, y[9 - size] + 1), e = 1e-9;
            const CpsiHeight before = cpsi_ground_height(ground, x[i] - e, b),
                             after = cpsi_ground_height(ground, x[i] + e, b);
            /* 2e-9 of slopes and second derivatives of up to 100 */
            CHECK_NEAR(after.z, before.z, 2e-7);
            CHECK_NEAR(after.x, before.x, 2e-7);
            CHECK_NEAR(after.y, before.y, 2e-7);
        }
        for (int k = 0; k < 200; k++) {
            const double a = splitmix(&random, x[0] - 2, x[size - 1] + 2),
                         b = splitmix(&random, y[0] - 2, y[9 - size] + 2), h = 1e-6;
            const CpsiHeight at = cpsi_ground_height(ground, a, b),
                             left = cpsi_ground_height(ground, a - h, b),
                             right = cpsi_ground_height(ground, a + h, b),
                             below = cpsi_ground_height(ground, a, b - h),
                             above = cpsi_ground_height(ground, a, b + h);
            bool edge = false; /* where a difference would cross an edge of second derivatives */
            for (int i = 0; i < size; i++) edge |= fabs(a - x[i]) < 2 * h;
            for (int j = 0; j < 10 - size; j++) edge |= fabs(b - y[j]) < 2 * h;
            if (edge) continue;
            /* rounding over h; h^2/6 of third derivatives of at most 1e4 is less */
            const double part = 1e-9, size_x = fabs(at.z) + fabs(at.x) + 1,
                         size_xx = size_x + fabs(at.y) + fabs(at.xx) + fabs(at.yy) + fabs(at.xy);
            CHECK_NEAR((right.z - left.z) / (2 * h), at.x, part * size_x);
            CHECK_NEAR((above.z - below.z) / (2 * h), at.y, part * (size_x + fabs(at.y)));
            CHECK_NEAR((right.x - left.x) / (2 * h), at.xx, 10 * part * size_xx);
            CHECK_NEAR((above.x - below.x) / (2 * h), at.xy, 10 * part * size_xx);
            CHECK_NEAR((above.y - below.y) / (2 * h), at.yy, 10 * part * size_xx);
        }
        cps_ground_release(ground);
    }
}

/* The cubic of each cell once more, from its four corners: their heights, slopes and twists. */
static double slope_at(const double *v, const double *at, int count, int i, int stride) {
    if (count == 2) return (v[stride] - v[0]) / (at[1] - at[0]);
    const int m = i == 0 ? 1 : i == count - 1 ? count - 2 : i;
    const double left = (v[m * stride] - v[(m - 1) * stride]) / (at[m] - at[m - 1]),
                 right = (v[(m + 1) * stride] - v[m * stride]) / (at[m + 1] - at[m]),
                 bend = (right - left) / (at[m + 1] - at[m - 1]);
    return left + bend * ((at[i] - at[m - 1]) + (at[i] - at[m]));
}

static double hermite(const double v[2], const double d[2], double h, double t) {
    return v[0] + t * (h * d[0] + t * (3 * (v[1] - v[0]) - h * (2 * d[0] + d[1]) +
                                       t * (2 * (v[0] - v[1]) + h * (d[0] + d[1]))));
}

static void is_the_cubic_of_its_cell(void **state) {
    (void)state;
    uint64_t random = 9;
    for (int size = 2; size < 9; size++) {
        const int rows = 10 - size;
        const CpsGroundGrid grid = grid_of(&random, size, rows, NULL);
        CpsGround *ground = made(&grid);
        for (int i = 0; i + 1 < size; i++)
            for (int j = 0; j + 1 < rows; j++) {
                const double s = splitmix(&random, 0, 1), t = splitmix(&random, 0, 1),
                             h = x[i + 1] - x[i], k = y[j + 1] - y[j];
                double line[MOST], along[2], tilt[2];
                for (int r = 0; r < rows; r++) {
                    const double *row = &z[r * size], d[2] = {slope_at(row, x, size, i, 1),
                                                              slope_at(row, x, size, i + 1, 1)};
                    line[r] = hermite(&row[i], d, h, s);
                }
                for (int r = 0; r < 2; r++) {
                    along[r] = line[j + r];
                    tilt[r] = slope_at(line, y, rows, j + r, 1);
                }
                CHECK_NEAR(cps_ground_height(ground, x[i] + s * h, y[j] + t * k, NULL),
                           hermite(along, tilt, k, t), 1e-13);
            }
        cps_ground_release(ground);
    }
}

/* The factor of friction is that of the points, linear between them, that of the edge beyond. */
static void multiplies_friction(void **state) {
    (void)state;
    uint64_t random = 11;
    const CpsGroundGrid grid = grid_of(&random, 5, 4, NULL);
    CpsGround *ground = made(&grid);
    CHECK_NEAR(cpsi_ground_friction_factor(ground, x[2], y[1]), factor[7], 1e-15);
    CHECK_NEAR(cpsi_ground_friction_factor(ground, 0.5 * (x[2] + x[3]), y[1]),
               0.5 * (factor[7] + factor[8]), 1e-15);
    CHECK_NEAR(cpsi_ground_friction_factor(ground, x[2], 0.25 * y[1] + 0.75 * y[2]),
               0.25 * factor[7] + 0.75 * factor[12], 1e-15);
    CHECK_NEAR(cpsi_ground_friction_factor(ground, x[0] - 9, y[3] + 9), factor[15], 1e-15);
    CHECK_INT(cpsi_ground_covers(ground, 1e9, 0, 0), true);
    cps_ground_release(ground);
    CpsGroundGrid cut = grid;
    cut.extends = false;
    cut.friction_factor = NULL;
    ground = made(&cut);
    CHECK_INT(cpsi_ground_covers(ground, x[4], y[0], 0), true);
    CHECK_INT(cpsi_ground_covers(ground, x[4] + 1e-6, y[0], 1e-9), false);
    CHECK_INT(cpsi_ground_covers(ground, x[0], y[0] - 1e-6, 1e-9), false);
    CHECK_INT(cpsi_ground_covers(ground, NAN, y[0], 1e-9), false);
    CHECK_NEAR(cpsi_ground_friction_factor(ground, x[1], y[1]), 1, 0);
    cps_ground_release(ground);
}

static void refuse(CpsGroundGrid grid, const char *says) {
    CpsGround *ground = (CpsGround *)&grid;
    CpsError err = {0};
    CHECK_INT(cps_ground_create(&grid, &ground, &err) != CPS_OK, true);
    assert_null(ground);
    if (!strstr(err.message, says)) fail_msg("'%s' does not say '%s'", err.message, says);
}

static void refuses_what_is_no_grid(void **state) {
    (void)state;
    uint64_t random = 13;
    const CpsGroundGrid good = grid_of(&random, 4, 3, NULL);
    CpsGroundGrid bad = good;
    bad.cookie = 0;
    refuse(bad, "cps_ground_grid_default");
    bad = good;
    bad.x_count = 1;
    refuse(bad, "1 points along x");
    bad.x_count = -3;
    refuse(bad, "-3 points along x");
    bad = good;
    bad.y_count = CPS_MAX_GROUND_COUNT + 1;
    refuse(bad, "points along y");
    bad = good;
    bad.x = NULL;
    refuse(bad, "NULL");
    bad = good;
    bad.z = NULL;
    refuse(bad, "NULL");
    x[2] = x[1];
    refuse(good, "expected increasing");
    x[2] = NAN;
    refuse(good, "finite");
    x[2] = 0.5 * (x[1] + x[3]);
    z[5] = INFINITY;
    refuse(good, "the height at");
    z[5] = 0;
    factor[5] = -0.1;
    refuse(good, "the factor of friction at");
    factor[5] = 1;
    CpsError err = {0};
    CHECK_INT(cps_ground_create(&good, NULL, &err), CPS_ERR_ARGUMENT);
    CpsGround *none = NULL;
    CHECK_INT(cps_ground_create(NULL, &none, &err), CPS_ERR_ARGUMENT);
    cps_ground_release(NULL);
    assert_null(cps_ground_retain(NULL));
    CpsGround *ground = made(&good);
    cps_ground_release(ground);
}

/* ---- surfaces ---- */

/* A ball and a cylinder about z of radius 2, as the squares of their spokes: no distances. */
static double ball(void *user, const double p[3], double gradient[3]) {
    (void)user;
    for (int k = 0; k < 3; k++) gradient[k] = 2 * p[k];
    return p[0] * p[0] + p[1] * p[1] + p[2] * p[2] - 4;
}

static double cylinder(void *user, const double p[3], double gradient[3]) {
    (void)user;
    gradient[0] = 2 * p[0];
    gradient[1] = 2 * p[1];
    gradient[2] = 0;
    return p[0] * p[0] + p[1] * p[1] - 4;
}

static CpsiObstacle surface_of(CpsSurfaceFunction *function, CpsiObstacle *exact) {
    CpsObstacle def = cps_obstacle_default();
    def.kind = CPS_OBSTACLE_SURFACE;
    def.surface = (CpsSurface){.function = function, .size = 0.2};
    def.point[0] = 0.5;
    def.point[1] = -1;
    def.radius = 2;
    def.axis[1] = 0;
    def.axis[2] = 1;
    const CpsiObstacle out = cpsi_obstacle(&def);
    def.kind = function == ball ? CPS_OBSTACLE_SPHERE : CPS_OBSTACLE_CYLINDER;
    *exact = cpsi_obstacle(&def);
    return out;
}

static Vec3 random_vector(uint64_t *state, double size) {
    double v[3];
    for (int a = 2; a >= 0; a--) v[a] = splitmix(state, -size, size);
    return vec3_load(v);
}

static Vec3 random_place(uint64_t *state, const CpsiObstacle *exact, double from, double to) {
    const Vec3 at = random_vector(state, 3);
    const double gap = splitmix(state, from, to);
    return vec3_axpy(gap - cpsi_obstacle_gap(exact, at), cpsi_obstacle_normal(exact, at), at);
}

/* On the surface all is that of the ball or cylinder; near it the distance is so to first order. */
static void is_the_round_one(void **state) {
    (void)state;
    uint64_t random = 17;
    for (int k = 0; k < 400; k++) {
        CpsiObstacle exact;
        const CpsiObstacle o = surface_of(k % 2 ? ball : cylinder, &exact);
        const double height = k % 4 < 2 ? 0 : 0.05;
        const Vec3 p = random_place(&random, &exact, -height, height),
                   n = cpsi_obstacle_normal(&exact, p);
        double axes[9], same[9], bent[3], want[3], other[3], normal[3];
        const double gap = cpsi_obstacle_gap(&exact, p);
        /* psi/|grad psi| = g (1 + g/4)/(1 + g/2): off by g^2/4 and less than a third more */
        CHECK_NEAR(cpsi_obstacle_gap(&o, p), gap, 0.33 * gap * gap + 2e-15);
        vec3_store(normal, n);
        vec3_store(other, cpsi_obstacle_normal(&o, p));
        CHECK_VECTOR(other, normal, 1e-14);
        const Vec3 along = vec3(0.3, splitmix(&random, -1, 1), 0.7);
        cpsi_obstacle_axes(&o, p, along, axes, bent);
        cpsi_obstacle_axes(&exact, p, along, same, want);
        CHECK_VECTOR(&axes[3], &same[3], 1e-13);
        /* differences of gradients that are linear: rounding over the displacement */
        CHECK_VECTOR(bent, want, 1e-8);
        CHECK_NEAR(cpsi_obstacle_range(&o, p),
                   1 / sqrt(bent[0] * bent[0] + 2 * bent[1] * bent[1] + bent[2] * bent[2]) +
                       fmax(0, cpsi_obstacle_gap(&o, p)),
                   1e-6);
    }
}

/* The slip on a ball is exact; on a cylinder, along a helix, it is of second order: 8 times less
 * in length for half of the way. A move follows the surface and keeps its height. */
static void slips_and_moves(void **state) {
    (void)state;
    uint64_t random = 19;
    double worst[2] = {0, 0};
    for (int k = 0; k < 300; k++) {
        CpsiObstacle exact;
        const CpsiObstacle o = surface_of(k % 2 ? ball : cylinder, &exact);
        const Vec3 p = random_place(&random, &exact, 0, 0);
        const Vec3 t = random_vector(&random, 1), n = cpsi_obstacle_normal(&exact, p),
                   flat = vec3_reject(t, n);
        for (int halved = 0; halved < 2; halved++) {
            const double length = 0.4 / (1 + halved);
            const Vec3 u = vec3_scale(length / vec3_norm(flat), flat),
                       q = cpsi_obstacle_move(&exact, p, u);
            const Vec3 found = cpsi_obstacle_slip(&o, p, q),
                       want = cpsi_obstacle_slip(&exact, p, q);
            const double off = vec3_norm(vec3_sub(found, want));
            if (k % 2)
                CHECK_LESS(off, 1e-14); /* rounding of places of size 4 */
            else
                worst[halved] = fmax(worst[halved], off / length);
            const Vec3 moved = cpsi_obstacle_move(&o, p, vec3_axpy(0.3, n, u));
            CHECK_NEAR(cpsi_obstacle_gap(&o, moved), 0.3 + cpsi_obstacle_gap(&o, p), 4e-15);
            /* along the surface to third order */
            CHECK_LESS(vec3_norm(vec3_sub(cpsi_obstacle_move(&o, p, u), q)),
                       length * length * length / 4);
        }
    }
    printf("slip on a cylinder: relative error %.3g, halved %.3g\n", worst[0], worst[1]);
    CHECK_LESS(worst[0], 0.2 * 0.2 / 18);
    CHECK_BETWEEN(worst[0] / worst[1], 3.8, 4.2);
}

/* The deepest place of a path, to its true foot: under a wave, by sampling; in a ball exactly. */
static void depth_is_true(void **state) {
    (void)state;
    CpsiObstacle exact;
    const CpsiObstacle o = surface_of(ball, &exact);
    const Vec3 centre = vec3(0.5, -1, 0);
    for (int k = 1; k < 20; k++) {
        const double low = 0.1 * k;
        const Vec3 a = vec3_add(centre, vec3(-3, low, 0)), b = vec3_add(centre, vec3(3, low, 0));
        /* a step of the path is 0.2, halfway to the deepest place at most: 0.1^2/(2 low) */
        CHECK_NEAR(cpsi_obstacle_depth(&o, a, b), cpsi_obstacle_depth(&exact, a, b),
                   low > 0.3 ? 0.005 / low : 0.1);
    }
    /* a path that ends inside: the true depth of its end, which psi/|grad psi| exceeds */
    const Vec3 a = vec3_add(centre, vec3(3, 0, 0)), b = vec3_add(centre, vec3(1.2, 0, 0));
    CHECK_NEAR(cpsi_obstacle_depth(&o, a, b), 0.8, 1e-12);
    CHECK_GREATER(-cpsi_obstacle_gap(&o, b), 1);
    CHECK_NEAR(cpsi_obstacle_depth(&o, a, a), -cpsi_obstacle_gap(&o, a), 0);
}

/* A function without a value says that everything is deep inside. */
static double nonsense(void *user, const double p[3], double gradient[3]) {
    (void)user;
    gradient[0] = p[0] > 0 ? NAN : 0;
    return p[1] > 0 ? NAN : 1;
}

static void nonsense_is_inside(void **state) {
    (void)state;
    CpsiObstacle exact;
    const CpsiObstacle o = surface_of(nonsense, &exact);
    for (int k = 0; k < 4; k++) {
        const Vec3 p = vec3(k % 2 ? 5 : -5, k / 2 ? 5 : -5, 0);
        CHECK_NEAR(cpsi_obstacle_gap(&o, p), -0.2, 0);
        CHECK_NEAR(vec3_norm(cpsi_obstacle_normal(&o, p)), 1, 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reproduces_parabolas),     cmocka_unit_test(is_smooth),
        cmocka_unit_test(is_the_cubic_of_its_cell), cmocka_unit_test(multiplies_friction),
        cmocka_unit_test(refuses_what_is_no_grid),  cmocka_unit_test(is_the_round_one),
        cmocka_unit_test(slips_and_moves),          cmocka_unit_test(depth_is_true),
        cmocka_unit_test(nonsense_is_inside),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
