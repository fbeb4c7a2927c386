/* SPDX-License-Identifier: BSD-3-Clause */
/* Bodies on a plane: elliptic integrals, cells, the wheel, searches on random bodies, what is
 * refused. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/planar.h"
#include "check.h"
#include "linalg/elliptic.h"
#include "planar/cells.h"

#define PI 3.14159265358979323846

static CpsPlanar *body_of(int count, const CpsPatch *patch) {
    CpsPlanar *body = NULL;
    CpsError err = {.message = ""};
    if (cps_planar_create(count, patch, &body, &err) != CPS_OK) fail_msg("%s", err.message);
    return body;
}

/* ---- elliptic integrals ---- */

/* Over a quarter turn by the trapezium rule, which converges geometrically for periodic functions:
 * the nearest poles lie at asinh(kc/k) off the axis, and N intervals leave exp(-4 N asinh(kc/k)):
 * exp(-45) for kc = 0.045. */
static CpsiElliptic by_quadrature(double k) {
    enum { N = 256 };
    CpsiElliptic sum = {0};
    for (int i = 0; i <= N; i++) {
        const double x = 0.5 * PI * i / N, weight = (i == 0 || i == N ? 0.5 : 1) * 0.5 * PI / N;
        const double s = sin(x), c = cos(x), d = sqrt(1 - k * k * s * s);
        sum.e += weight * d;
        sum.b += weight * c * c / d;
        sum.d += weight * s * s / d;
        sum.c += weight * s * s * c * c / (d * d * d);
    }
    return sum;
}

static void elliptic_integrals(void **state) {
    (void)state;
    static const double K[] = {0, 1e-9, 0.01, 0.3, 0.7071067811865476, 0.95, 0.999};
    const double tolerance = 3e-14; /* 256 additions, and logarithms that cancel for k near 1 */
    for (size_t i = 0; i < sizeof K / sizeof K[0]; i++) {
        const CpsiElliptic got = cpsi_elliptic(K[i], sqrt((1 - K[i]) * (1 + K[i]))),
                           want = by_quadrature(K[i]);
        CHECK_RELATIVE(got.e, want.e, tolerance);
        CHECK_RELATIVE(got.b, want.b, tolerance);
        CHECK_RELATIVE(got.c, want.c, tolerance);
        CHECK_RELATIVE(got.d, want.d, tolerance);
    }

    /* the ends: k = 0 exactly; k = 1, where C and D grow without bound and E = B = 1 (differences
     * of logarithms, 37 ulp) */
    CHECK_NEAR(cpsi_elliptic(0, 1).c, PI / 16, 1e-15);
    CHECK_NEAR(cpsi_elliptic(1, 0).e, 1, tolerance);
    CHECK_NEAR(cpsi_elliptic(1, 0).b, 1, tolerance);
    CHECK_FINITE(cpsi_elliptic(1, 0).d);
}

/* ---- cells ---- */

typedef struct Moments {
    double load, first[2], square;
    int count;
} Moments;

static bool add_moments(void *user, double strength, const double r[2]) {
    Moments *sum = user;
    assert_true(strength >= 0);
    sum->load += strength;
    sum->first[0] += strength * r[0];
    sum->first[1] += strength * r[1];
    sum->square += strength * (r[0] * r[0] + r[1] * r[1]);
    sum->count++;
    return true;
}

/* Load and first moment are those of the patch, exactly; the second moment, of a convex function,
 * lies between. */
static void cells_keep_load_and_moment(void **state) {
    (void)state;
    static const double CORNER[8] = {0, 0, 2, 0, 2, 1, 0, 1};
    const struct {
        CpsPatch patch;
        double first[2], square; /* about the patch's middle */
    } CASE[] = {
        {{.kind = CPS_PATCH_ROD, .friction = 0.5, .load = 6, .size = 2, .tilt = {0.25}}, {1, 0}, 4},
        /* tilted by t: moments N t a^2/2 round a ring, N t a^2/4 over a disc; at 90 degrees */
        {{.kind = CPS_PATCH_RING, .friction = 1, .load = 3, .size = 2, .tilt = {0.3, 0.4}},
         {1.8, 2.4},
         12},
        {{.kind = CPS_PATCH_DISC,
          .friction = 1,
          .load = 3,
          .size = 2,
          .angle = 0.5 * PI,
          .tilt = {0.3, 0.4}},
         {-1.2, 0.9},
         6},
        /* 3 N on 2 x 1 m2, tilt along x: moment 3 x 0.5 x 2^2/12; square 3 (4 + 1)/12, odd in the
         * tilt */
        {{.kind = CPS_PATCH_POLYGON,
          .friction = 1,
          .load = 3,
          .corner_count = 4,
          .corner = CORNER,
          .tilt = {0.5}},
         {0.5, 0},
         1.25},
    };
    for (size_t i = 0; i < sizeof CASE / sizeof CASE[0]; i++) {
        CpsPatch given = CASE[i].patch;
        given.cookie = cps_patch_default().cookie;
        CpsPlanar *body = body_of(1, &given);
        const CpsiPatch *patch = &body->patch[0];
        for (int n = 1; n <= 9; n += 4) {
            Moments inner = {0}, outer = {0};
            cpsi_cells(patch, CPS_PLANAR_INNER, n, add_moments, &inner);
            cpsi_cells(patch, CPS_PLANAR_OUTER, n, add_moments, &outer);
            CHECK_RELATIVE(inner.load, 3, 1e-14); /* rounding of some 100 cells */
            CHECK_RELATIVE(outer.load, 3, 1e-14);
            for (int x = 0; x < 2; x++) {
                CHECK_NEAR(inner.first[x], CASE[i].first[x], 1e-13);
                CHECK_NEAR(outer.first[x], CASE[i].first[x], 1e-13);
            }
            CHECK_LESS(inner.square, CASE[i].square);
            CHECK_GREATER(outer.square, CASE[i].square);
            CHECK_NEAR(inner.count, cpsi_cell_count(patch, n), 0);
            assert_true(outer.count <= cpsi_cell_contacts(patch, CPS_PLANAR_OUTER, n));
        }
        const int n = cpsi_cell_fineness(patch, 1000);
        assert_true(cpsi_cell_count(patch, n) <= 1000 && cpsi_cell_count(patch, n + 1) > 1000);
        cps_planar_destroy(body);
    }
}

/* ---- the wheel ---- */

/* M77 section 11 with the closed form of 5.2: f N = 500, b/a = 200, a = 0.3 */
static void wheel_slip_and_spin(void **state) {
    (void)state;
    /* velocity along i and j; spin; power */
    static const double CASE[][4] = {{1, 0, 0, 500},
                                     {1, 0.3, 0, 522.0153254455275},
                                     {1, 1, -1.8785473984267176, 658.257569495584},
                                     {0.5, 2, -5.939273699213359, 629.128784747792},
                                     {0, 1, -10.0 / 3, 200}};
    CpsPlanar *body = body_of(1, &(CpsPatch){.cookie = cps_patch_default().cookie,
                                             .kind = CPS_PATCH_WHEEL,
                                             .angle = 0.5 * PI,
                                             .friction = 0.5,
                                             .load = 1000,
                                             .size = 0.3,
                                             .brake = 60});
    for (size_t i = 0; i < sizeof CASE / sizeof CASE[0]; i++) {
        const double twist[3] = {CASE[i][0], CASE[i][1], 0}; /* rolling direction y, so i is x */
        double wrench[3];
        CpsWheelMotion motion;
        CpsSetAnswer answer;
        assert_int_equal(cps_planar_wheel(body, 0, twist, &motion, NULL), CPS_OK);
        assert_int_equal(cps_planar_dissipation(body, twist, wrench, NULL, &answer, NULL), CPS_OK);
        CHECK_NEAR(motion.spin, CASE[i][2], 1e-13); /* closed forms, some ulp */
        CHECK_RELATIVE(answer.value, CASE[i][3], 1e-14);
        CHECK_RELATIVE(motion.ground + motion.brake, CASE[i][3], 1e-14);
        CHECK_RELATIVE(-wrench[0] * twist[0] - wrench[1] * twist[1], CASE[i][3], 1e-14);
        CHECK_LESS(fabs(wrench[1]), 200 + 1e-10);
        if (twist[0] == 0)
            CHECK_NEAR(wrench[0], 0, 1e-12); /* of the edge's side forces, the middle one */
    }
    CpsWheelMotion motion;
    assert_int_equal(cps_planar_wheel(body, 1, (double[3]){0}, &motion, NULL), CPS_ERR_ARGUMENT);
    cps_planar_destroy(body);
}

/* ---- searches on random bodies ---- */

static uint64_t seed;

static double random_share(void) { /* xorshift64 */
    seed ^= seed << 13;
    seed ^= seed >> 7;
    seed ^= seed << 17;
    return (double)(seed >> 11) / 9007199254740992.0;
}

static double random_sign(void) { return 2 * random_share() - 1; }

enum { MOST_PATCHES = 4, CORNERS = 5 };

/* Any patch of a size around `scale`; corners for a polygon. */
static CpsPatch random_patch(double scale, int kinds, double corner[2 * CORNERS]) {
    CpsPatch patch = cps_patch_default();
    patch.kind = (CpsPatchKind)(random_share() * kinds);
    for (int a = 0; a < 2; a++) patch.position[a] = scale * random_sign();
    patch.angle = 7 * random_sign();
    patch.friction = random_share();
    patch.load = pow(10, 2 * random_sign());
    patch.size = scale * (0.1 + random_share());
    if (patch.kind == CPS_PATCH_WHEEL)
        patch.brake = patch.friction * patch.load * patch.size * fmax(1.5 * random_sign(), 0);
    if (patch.kind == CPS_PATCH_ROD) patch.tilt[0] = random_sign() / patch.size;
    if (patch.kind == CPS_PATCH_POLYGON) {
        for (int i = 0; i < CORNERS; i++) {
            const double a = 2 * PI * (i + 0.7 * random_share()) / CORNERS;
            corner[2 * i] = patch.size * cos(a);
            corner[2 * i + 1] = patch.size * sin(a);
        }
        for (int x = 0; x < 2; x++) patch.tilt[x] = 0.3 * random_sign() / patch.size;
        patch.corner_count = CORNERS;
        patch.corner = corner;
    }
    return patch;
}

static CpsPlanar *random_body(double scale, int kinds) {
    CpsPatch patch[MOST_PATCHES];
    double corner[MOST_PATCHES][2 * CORNERS];
    const int count = 1 + (int)(random_share() * MOST_PATCHES);
    for (int k = 0; k < count; k++) patch[k] = random_patch(scale, kinds, corner[k]);
    return body_of(count, patch);
}

/* Bounds are near each other, the motion agrees with the drive, forces balance, and no twist that
 * agrees with the drive dissipates less than the lower bound. */
static void random_drives(void **state) {
    (void)state;
    for (int i = 0; i < 5000; i++) {
        seed = 0x9e3779b97f4a7c15u + (uint64_t)i;
        for (int warm = 0; warm < 8; warm++) random_share();
        const double scale = pow(10, 3 * random_sign());
        CpsPlanar *body = random_body(scale, CPS_PATCH_POLYGON + 1);
        const int rows = 1 + (int)(random_share() * 3);
        double map[9], velocity[3];
        for (int k = 0; k < 9; k++) map[k] = k % 3 == 2 ? scale * random_sign() : random_sign();
        for (int k = 0; k < 3; k++) velocity[k] = random_sign();
        CpsPlanarMotion motion;
        CpsError err = {.message = ""};
        if (cps_planar_drive(body, rows, map, velocity, &motion, &err) != CPS_OK)
            fail_msg("case %d: %s", i, err.message);
        if (motion.outcome != CPS_SET_OUTCOME_ANSWERED)
            fail_msg("case %d: outcome %d", i, (int)motion.outcome);
        assert_true(motion.lower <= motion.upper);
        CHECK_LESS(motion.upper - motion.lower, 1e-10 * fmax(motion.upper, 1e-2 * motion.scale));

        double balance[3] = {motion.wrench[0], motion.wrench[1], motion.wrench[2]}, work = 0;
        for (int r = 0; r < rows; r++) {
            double got = -velocity[r], size = fabs(velocity[r]);
            for (int k = 0; k < 3; k++) {
                got += map[3 * r + k] * motion.twist[k];
                size += fabs(map[3 * r + k] * motion.twist[k]);
                balance[k] += map[3 * r + k] * motion.drive[r];
            }
            CHECK_LESS(fabs(got),
                       1e-12 * size); /* the rows' condition, at worst 1e3 here, times some ulp */
            work += motion.drive[r] * velocity[r];
        }
        CHECK_NEAR(work, motion.lower, 1e-12 * motion.scale + 1e-9 * motion.upper);
        const double force = hypot(hypot(motion.drive[0], motion.drive[1]), motion.drive[2]) * 3;
        CHECK_LESS(hypot(hypot(balance[0], balance[1]), balance[2] / scale),
                   1e-9 * force + 1e-12 * motion.scale);

        /* across all rows; where there is one, the second is a random direction in its place */
        if (rows < 3)
            for (int other = 0; other < 4; other++) {
                const double *a = map, *b = map + 3,
                             t = motion.scale > 0 ? random_sign() * pow(0.01, other) : 0;
                const double free[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                        a[0] * b[1] - a[1] * b[0]};
                double twist[3];
                CpsSetAnswer answer;
                for (int k = 0; k < 3; k++) twist[k] = motion.twist[k] + t / scale * free[k];
                assert_int_equal(cps_planar_dissipation(body, twist, NULL, NULL, &answer, NULL),
                                 CPS_OK);
                CHECK_GREATER(answer.value, motion.lower - 1e-12 * motion.scale);
            }
        cps_planar_destroy(body);
    }
}

/* Points and wheels: the conic solver of drive.h, which works on another formulation, finds the
 * same gamma. */
static void random_drives_against_systems(void **state) {
    (void)state;
    for (int i = 0; i < 200; i++) {
        seed = 0xd1b54a32d192ed03u + (uint64_t)i;
        for (int warm = 0; warm < 8; warm++) random_share();
        CpsPlanar *body = random_body(1, CPS_PATCH_WHEEL + 1);
        const int rows = 1 + (int)(random_share() * 2);
        double map[6], velocity[2];
        CpsEntry entry[6];
        for (int k = 0; k < 6; k++) {
            map[k] = random_sign();
            entry[k] = (CpsEntry){k / 3, k % 3, map[k]};
        }
        for (int k = 0; k < 2; k++) velocity[k] = random_sign();
        CpsPlanarMotion found;
        assert_int_equal(cps_planar_drive(body, rows, map, velocity, &found, NULL), CPS_OK);
        CpsSystem *system = NULL;
        CpsMotion *motion = NULL;
        assert_int_equal(cps_planar_system(body, CPS_PLANAR_INNER, 1, &system, NULL), CPS_OK);
        assert_int_equal(cps_system_set_drive(system, rows, 3 * rows, entry, NULL), CPS_OK);
        assert_int_equal(cps_system_solve(system, velocity, NULL, &motion, NULL), CPS_OK);
        const CpsMotionReport report = cps_motion_report(motion);
        assert_int_equal(report.outcome, CPS_MOTION_OUTCOME_SOLVED);
        assert_true(found.lower <= report.upper &&
                    report.lower <= found.upper); /* both enclose gamma */
        cps_motion_destroy(motion);
        cps_system_destroy(system);
        cps_planar_destroy(body);
    }
}

/* ---- outcomes and refusals ---- */

/* Each is told by a sentence that names what was found. */
static void bad_patches(void **state) {
    (void)state;
    static const double RIGHT_TURN[8] = {0, 0, 1, 0, 0.2, 0.2, 0, 1}, LINE[6] = {0, 0, 1, 0, 2, 0};
    static const double STAR[10] = {1,      0,     -0.809, 0.588,  0.309,
                                    -0.951, 0.309, 0.951,  -0.809, -0.588};
    static const double UNIT[6] = {0, 0, 1, 0, 0, 1};
    CpsLaw *line = NULL;
    CpsSet *interval = NULL;
    assert_int_equal(cps_set_interval(-1, 1, &interval, NULL), CPS_OK);
    assert_int_equal(cps_law_friction(interval, &line, NULL), CPS_OK);
    const struct {
        CpsPatch patch;
        const char *says;
    } BAD[] = {
        {{.kind = (CpsPatchKind)9}, "kind 9"},
        {{.kind = CPS_PATCH_POINT, .position = {0, NAN}, .load = 1}, "nan"},
        {{.kind = CPS_PATCH_POINT, .friction = -0.1, .load = 1}, "-0.1"},
        {{.kind = CPS_PATCH_POINT, .friction = 0.1, .load = NAN}, "load"},
        {{.kind = CPS_PATCH_DISC, .friction = 0.1, .load = 1}, "size"},
        {{.kind = CPS_PATCH_WHEEL, .friction = 0.1, .load = 1, .size = 1, .brake = -1}, "brake"},
        {{.kind = CPS_PATCH_ROD, .friction = 1, .load = 1, .size = 2, .tilt = {0.6}},
         "negative at an end"},
        {{.kind = CPS_PATCH_DISC, .friction = 1, .load = 1, .size = 2, .tilt = {0.4, 0.4}},
         "negative"},
        {{.kind = CPS_PATCH_ROD, .friction = 1, .load = 1, .size = 2, .tilt = {0, 0.1}}, "across"},
        {{.kind = CPS_PATCH_WHEEL, .friction = 1, .load = 1, .size = 2, .tilt = {0, 0.1}}, "wheel"},
        {{.kind = CPS_PATCH_POLYGON, .corner_count = 2, .corner = LINE}, "2 corners"},
        {{.kind = CPS_PATCH_POLYGON, .corner_count = 4, .corner = RIGHT_TURN},
         "turns right at corner 2"},
        {{.kind = CPS_PATCH_POLYGON, .corner_count = 3, .corner = LINE}, "round"},
        {{.kind = CPS_PATCH_POLYGON, .corner_count = 5, .corner = STAR}, "more than once"},
        {{.kind = CPS_PATCH_POLYGON, .corner_count = 3, .corner = UNIT, .tilt = {4, 0}},
         "negative at corner"},
        {{.kind = CPS_PATCH_POINT, .law = line}, "1 components"},
        {{.kind = CPS_PATCH_DISC, .size = 1, .law = line}, "only a point"},
        {{.kind = CPS_PATCH_POINT, .load = 1, .law = line}, "one or the other"},
    };
    for (size_t i = 0; i < sizeof BAD / sizeof BAD[0]; i++) {
        CpsPlanar *body = NULL;
        CpsError err = {.message = ""};
        CpsPatch bad = BAD[i].patch;
        bad.cookie = cps_patch_default().cookie;
        assert_int_equal(cps_patch_check(&bad, &err), CPS_ERR_ARGUMENT);
        assert_non_null(strstr(err.message, BAD[i].says));
        assert_int_equal(cps_planar_create(1, &bad, &body, &err), CPS_ERR_ARGUMENT);
        assert_null(body);
        if (!strstr(err.message, BAD[i].says))
            fail_msg("\"%s\" does not say \"%s\"", err.message, BAD[i].says);
    }
    cps_law_release(line);
    cps_set_release(interval);
}

static void bad_questions(void **state) {
    (void)state;
    CpsPlanar *body = body_of(1, &(CpsPatch){.cookie = cps_patch_default().cookie,
                                             .kind = CPS_PATCH_DISC,
                                             .friction = 1,
                                             .load = 1,
                                             .size = 1});
    const double twice[6] = {1, 0, 0, 2, 0, 0}, twist[3] = {0, NAN, 0}, one[3] = {1, 1, 1};
    CpsPlanarMotion motion;
    CpsPlanarBounds bounds;
    CpsSetAnswer answer;
    CpsTowStep step;
    CpsLaw *law = NULL;
    CpsError err;
    assert_int_equal(cps_planar_dissipation(body, twist, NULL, NULL, &answer, &err),
                     CPS_ERR_ARGUMENT);
    assert_int_equal(cps_planar_bounds(body, one, -1, &bounds, &err), CPS_ERR_ARGUMENT);
    assert_int_equal(cps_planar_drive(body, 2, twice, one, &motion, &err), CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "row 2"));
    assert_int_equal(cps_planar_drive(body, 4, twice, one, &motion, &err), CPS_ERR_ARGUMENT);
    assert_int_equal(cps_planar_law(body, CPS_PLANAR_INNER, 3, &law, &err),
                     CPS_ERR_ARGUMENT); /* a disc needs 4 cells */
    assert_int_equal(cps_planar_law(body, CPS_PLANAR_OUTER, 60000, &law, &err), CPS_ERR_LIMIT);
    assert_null(law);
    CpsTow tow = {.cookie = cps_tow_default().cookie, .rope = -1};
    assert_int_equal(cps_planar_tow(body, &tow, one, &step, &err), CPS_ERR_ARGUMENT);

    /* more accuracy than cells can give: said, and the bounds hold */
    assert_int_equal(cps_planar_bounds(body, one, 1e-9, &bounds, NULL), CPS_OK);
    assert_int_equal(bounds.outcome, CPS_SET_OUTCOME_INACCURATE);
    assert_int_equal(cps_planar_dissipation(body, one, NULL, NULL, &answer, NULL), CPS_OK);
    CHECK_BETWEEN(answer.value, bounds.lower, bounds.upper);

    /* numbers that overflow are no answer */
    assert_int_equal(cps_planar_dissipation(body, (double[3]){1.7e308, 1.7e308, 0}, NULL, NULL,
                                            &answer, NULL),
                     CPS_OK);
    assert_int_not_equal(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    cps_planar_destroy(body);
}

/* A one-sided law whose drag fades the faster the point moves along it: C touches 0, phi = |v| -
 * v_x, and driven across no speed along x is the best. */
static void minimum_not_attained(void **state) {
    (void)state;
    CpsSet *ball = NULL;
    CpsLaw *law = NULL;
    CpsPlanarMotion motion;
    assert_int_equal(cps_set_ball(2, (double[2]){1, 0}, 1, &ball, NULL), CPS_OK);
    assert_int_equal(cps_law_friction(ball, &law, NULL), CPS_OK);
    CpsPlanar *body = body_of(1, &(CpsPatch){.cookie = cps_patch_default().cookie,
                                             .kind = CPS_PATCH_POINT,
                                             .law = law});
    assert_int_equal(cps_planar_drive(body, 2, (double[6]){0, 1, 0, 0, 0, 1}, (double[2]){1, 0},
                                      &motion, NULL),
                     CPS_OK);
    assert_int_equal(motion.outcome, CPS_SET_OUTCOME_NOT_ATTAINED);
    cps_planar_destroy(body);
    cps_law_release(law);
    cps_set_release(ball);
}

/* One point contact: nothing resists turning about it, and any turning goes with a push. */
static void free_turning(void **state) {
    (void)state;
    CpsPlanar *body = body_of(1, &(CpsPatch){.cookie = cps_patch_default().cookie,
                                             .kind = CPS_PATCH_POINT,
                                             .friction = 1,
                                             .load = 2});
    double low[3], high[3];
    assert_int_equal(cps_planar_motions(body, 2, (double[6]){1, 0, 0, 0, 1, 0}, (double[2]){3, 4},
                                        0, low, high, NULL),
                     CPS_OK);
    CHECK_NEAR(low[0], 3, 1e-14);
    CHECK_NEAR(high[1], 4, 1e-14);
    assert_true(low[2] == -INFINITY && high[2] == INFINITY);
    cps_planar_destroy(body);

    /* only one component of that point driven: the other rests, and directions in which nothing
     * changes are oblique to all axes, where a slope is what rounding leaves of another */
    for (int i = 0; i < 200; i++) {
        const double x = 0.0122635 + 1e-9 * i, y = -0.337436;
        CpsPlanarMotion motion;
        body = body_of(1, &(CpsPatch){.cookie = cps_patch_default().cookie,
                                      .kind = CPS_PATCH_POINT,
                                      .position = {x, y},
                                      .friction = 1,
                                      .load = 2});
        assert_int_equal(cps_planar_drive(body, 1, (double[3]){1, 0, -y}, (double[1]){0.7}, &motion,
                                          NULL),
                         CPS_OK);
        assert_int_equal(motion.outcome, CPS_SET_OUTCOME_ANSWERED);
        CHECK_NEAR(motion.lower, 1.4, 1e-12); /* the promised rounding, of a power of order 1 */
        CHECK_NEAR(motion.upper, 1.4, 1e-12);
        cps_planar_destroy(body);
    }
}

/* A slack rope pulls nothing; a step that would spin the body is not made; both leave the pose. */
static void tow_leaves_the_body(void **state) {
    (void)state;
    CpsPlanar *body = body_of(1, &(CpsPatch){.cookie = cps_patch_default().cookie,
                                             .kind = CPS_PATCH_DISC,
                                             .friction = 1,
                                             .load = 1,
                                             .size = 1});
    CpsTow tow = {.cookie = cps_tow_default().cookie,
                  .pose = {1, 2, 0.5},
                  .hitch = {0, 1},
                  .rope = 3,
                  .end = {1, 2}};
    CpsTowStep step;
    assert_int_equal(cps_planar_tow(body, &tow, (double[2]){2, 4}, &step, NULL), CPS_OK);
    assert_true(step.outcome == CPS_SET_OUTCOME_ANSWERED && !step.pulled && step.converged);
    CHECK_NEAR(tow.pose[0], 1, 0);
    CHECK_NEAR(tow.pose[2], 0.5, 0);
    CHECK_NEAR(tow.end[1], 4, 0); /* the rope's end has moved all the same */

    /* pulled out of the slack, it ends just taut */
    assert_int_equal(cps_planar_tow(body, &tow, (double[2]){2, 5.6}, &step, NULL), CPS_OK);
    assert_true(step.outcome == CPS_SET_OUTCOME_ANSWERED && step.pulled && step.converged);
    const double x = tow.pose[0] - sin(tow.pose[2]), y = tow.pose[1] + cos(tow.pose[2]);
    CHECK_RELATIVE(hypot(2 - x, 5.6 - y), 3, 1e-12); /* passes settle to 1e-13 */

    tow = (CpsTow){.cookie = cps_tow_default().cookie, .hitch = {0, 1}};
    assert_int_equal(cps_planar_tow(body, &tow, (double[2]){50, 1}, &step, NULL), CPS_OK);
    assert_int_equal(step.outcome, CPS_SET_OUTCOME_INACCURATE);
    CHECK_NEAR(tow.pose[2], 0, 0);
    CHECK_NEAR(tow.work, 0, 0);
    cps_planar_destroy(body);
}

/* A screw motion through a quarter turn about (0, 1) carries the origin to (1, 1). */
static void move_along_a_screw(void **state) {
    (void)state;
    double pose[3] = {0, 0, 0};
    cps_planar_move(pose, (double[3]){0.5 * PI, 0, 0.5 * PI});
    CHECK_NEAR(pose[0], 1, 1e-15);
    CHECK_NEAR(pose[1], 1, 1e-15);
    CHECK_NEAR(pose[2], 0.5 * PI, 1e-15);
}

static void bad_planimeters(void **state) {
    (void)state;
    static const double NEAR[6] = {0, 1, 1, 0, 1, 1}, FAR[6] = {1, 0, 5, 0, 1, 1};
    CpsPlanimeter planimeter = {.cookie = cps_planimeter_default().cookie,
                                .pole_arm = 1,
                                .tracer_arm = 1.3,
                                .wheel = 0.4,
                                .friction = 0.3,
                                .load = 1};
    CpsPlanimeterReading reading;
    CpsError err;
    assert_int_equal(cps_planimeter_trace(&planimeter, 3, NEAR, 10, &reading, &err), CPS_OK);
    assert_int_equal(cps_planimeter_trace(&planimeter, 3, FAR, 10, &reading, &err),
                     CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "cannot reach"));
    assert_int_equal(cps_planimeter_trace(&planimeter, 2, NEAR, 10, &reading, &err),
                     CPS_ERR_ARGUMENT);
    assert_int_equal(cps_planimeter_trace(&planimeter, 3, NULL, 10, &reading, &err),
                     CPS_ERR_ARGUMENT);
    planimeter.load = 0;
    assert_int_equal(cps_planimeter_trace(&planimeter, 3, NEAR, 10, &reading, &err),
                     CPS_ERR_ARGUMENT);
    planimeter = (CpsPlanimeter){.cookie = cps_planimeter_default().cookie,
                                 .pole_arm = 1,
                                 .tracer_arm = NAN,
                                 .friction = 1,
                                 .load = 1};
    assert_int_equal(cps_planimeter_trace(&planimeter, 3, NEAR, 10, &reading, &err),
                     CPS_ERR_ARGUMENT);
}

static void bad_sweeps(void **state) {
    (void)state;
    CpsLaw *law = NULL;
    CpsSweepStep step;
    const double end[2] = {1, 0}, nowhere[2] = {INFINITY, 0};
    assert_int_equal(cps_law_coulomb(1, 1, &law, NULL), CPS_OK);
    CpsSweep sweep = {.cookie = cps_sweep_default().cookie, .stiffness = 0};
    assert_int_equal(cps_sweep_step(law, &sweep, end, &step, NULL), CPS_ERR_ARGUMENT);
    sweep.stiffness = 1;
    assert_int_equal(cps_sweep_step(law, &sweep, nowhere, &step, NULL), CPS_ERR_ARGUMENT);
    assert_int_equal(cps_sweep_step(law, NULL, end, &step, NULL), CPS_ERR_ARGUMENT);
    assert_int_equal(cps_sweep_step(law, &sweep, end, &step, NULL), CPS_OK);
    CHECK_NEAR(step.dissipated, 0, 0); /* the spring is just at the limit */
    cps_law_release(law);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elliptic_integrals),
        cmocka_unit_test(cells_keep_load_and_moment),
        cmocka_unit_test(wheel_slip_and_spin),
        cmocka_unit_test(random_drives),
        cmocka_unit_test(random_drives_against_systems),
        cmocka_unit_test(bad_patches),
        cmocka_unit_test(bad_questions),
        cmocka_unit_test(minimum_not_attained),
        cmocka_unit_test(free_turning),
        cmocka_unit_test(tow_leaves_the_body),
        cmocka_unit_test(move_along_a_screw),
        cmocka_unit_test(bad_planimeters),
        cmocka_unit_test(bad_sweeps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
